// SPDX-License-Identifier: MIT
#include "2d/caps_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace encase {
namespace {

constexpr std::int64_t kMostNodes = 1'000'000'000;  // that can be numbered, with what they hold
constexpr int kDeepest = 1000;  // levels; doubles have fewer between any two of them

/// A box that is to be classified, with the curves that may pass.
struct Open {
  int node = 0;
  Box<2> box;
  std::size_t first = 0;  ///< of its curves in the list of the level
  std::size_t count = 0;
};

class Subdivider {
 public:
  Subdivider(std::vector<CurveBounds>& curves, const Box<2>& box, const CapsOptions& options,
             const std::function<bool()>& stop)
      : curves_(curves),
        options_(options),
        stop_(stop),
        rough_size_(std::sqrt(options.epsilon * box.largest_width())) {
    tree_.box = box;
    tree_.curve_sets.emplace_back();
    set_numbers_[{}] = 0;
  }

  CapsTree run() {
    level_.push_back({0, tree_.box, 0, curves_.size()});
    for (std::size_t c = 0; c < curves_.size(); ++c) alive_.push_back(static_cast<int>(c));
    tree_.nodes.push_back(0);
    for (int depth = 0; !level_.empty(); ++depth) {
      next_.clear();
      next_alive_.clear();
      for (const Open& open : level_) classify(open, depth);
      std::swap(level_, next_);
      std::swap(alive_, next_alive_);
    }
    return std::move(tree_);
  }

 private:
  void classify(const Open& open, int depth);
  CapsLabel settle(const Box<2>& box, int curve, const CurveBounds::Look& look);
  bool can_divide(const Box<2>& box);
  void divide(const Open& open);
  void end(const Open& open, int depth, CapsLabel label, int axis);

  std::vector<CurveBounds>& curves_;
  const CapsOptions& options_;
  const std::function<bool()>& stop_;
  /// Where the only curve may have a pole or a corner, boxes are not divided below this for the
  /// sake of self-crossings: along a pole this takes 1 / sqrt(epsilon) boxes in place of
  /// 1 / epsilon.
  const double rough_size_;
  CapsTree tree_;
  std::map<std::vector<int>, int> set_numbers_;
  std::vector<Open> level_, next_;
  std::vector<int> alive_, next_alive_;  ///< the curves of the boxes of a level
  std::vector<int> here_;                ///< those that may pass the box at hand
  std::int64_t visited_ = 0;
};

/// The paper's function of that name.
void Subdivider::classify(const Open& open, int depth) {
  if (++visited_ % 256 == 0 && !tree_.cut_short) tree_.cut_short = stop_ && stop_();
  here_.clear();
  CurveBounds::Look look;
  for (std::size_t k = open.first; k < open.first + open.count; ++k) {
    const int curve = alive_[k];
    const CurveBounds::Look seen = curves_[static_cast<std::size_t>(curve)].look(open.box);
    if (seen.absent) continue;
    look = seen;
    here_.push_back(curve);
  }
  if (here_.empty()) return end(open, depth, CapsLabel::Empty, -1);
  if (here_.size() > 1) {
    const bool terminal = open.box.largest_width() <= options_.epsilon;
    if (!terminal && depth < kDeepest && can_divide(open.box)) return divide(open);
    return end(open, depth, terminal ? CapsLabel::Several : CapsLabel::Indeterminate, -1);
  }
  const int curve = here_[0];
  const int axis = graph_axis(look.slopes);
  const double least = look.slopes.smooth ? options_.epsilon : rough_size_;
  if (options_.self_crossings && axis < 0 && open.box.largest_width() > least &&
      can_divide(open.box))
    return divide(open);
  const CapsLabel label = settle(open.box, curve, look);
  if (label == CapsLabel::Empty) here_.clear();
  end(open, depth, label, label == CapsLabel::Empty ? -1 : axis);
}

/// What a box is in which only one curve may pass.
CapsLabel Subdivider::settle(const Box<2>& box, int curve, const CurveBounds::Look& look) {
  const auto there =
      has_point(curves_[static_cast<std::size_t>(curve)], box, look, options_.epsilon);
  if (!there) return CapsLabel::Indeterminate;
  return *there ? CapsLabel::OneCurve : CapsLabel::Empty;
}

/// Whether there are doubles between the sides of a box, and the budget allows it.
bool Subdivider::can_divide(const Box<2>& box) {
  const Point<2> cut = caps_quarters(box)[0].hi;
  const bool possible =
      box.lo[0] < cut[0] && cut[0] < box.hi[0] && box.lo[1] < cut[1] && cut[1] < box.hi[1];
  const std::int64_t most = std::min(options_.max_boxes, kMostNodes);
  if (static_cast<std::int64_t>(tree_.nodes.size()) + 4 > most) tree_.cut_short = true;
  return possible && !tree_.cut_short;
}

void Subdivider::divide(const Open& open) {
  const int first = static_cast<int>(tree_.nodes.size());
  tree_.nodes[static_cast<std::size_t>(open.node)] = first;
  tree_.nodes.resize(tree_.nodes.size() + 4);
  const std::size_t start = next_alive_.size();
  next_alive_.insert(next_alive_.end(), here_.begin(), here_.end());
  const std::array<Box<2>, 4> parts = caps_quarters(open.box);
  for (int k = 0; k < 4; ++k) next_.push_back({first + k, parts[k], start, here_.size()});
}

/// Makes the box a leaf with the curves at hand.
void Subdivider::end(const Open& open, int depth, CapsLabel label, int axis) {
  auto found = set_numbers_.find(here_);
  if (found == set_numbers_.end()) {
    found = set_numbers_.emplace(here_, static_cast<int>(tree_.curve_sets.size())).first;
    tree_.curve_sets.push_back(here_);
  }
  tree_.nodes[static_cast<std::size_t>(open.node)] = ~static_cast<int>(tree_.leaves.size());
  tree_.leaves.push_back({open.box, depth, label, found->second, -1, axis});
}

}  // namespace

std::vector<int> CapsTree::tokens() const {
  std::vector<int> result, stack{0};
  result.reserve(nodes.size());
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    const int content = nodes[static_cast<std::size_t>(node)];
    result.push_back(content < 0 ? ~content : CapsResult::kDivided);
    if (content >= 0)
      for (int k = 3; k >= 0; --k) stack.push_back(content + k);
  }
  return result;
}

CapsTree subdivide(std::vector<CurveBounds>& curves, const Box<2>& box, const CapsOptions& options,
                   const std::function<bool()>& stop) {
  return Subdivider(curves, box, options, stop).run();
}

}  // namespace encase
