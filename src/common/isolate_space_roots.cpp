// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "common/isolate_roots.hpp"
#include "common/space_net.hpp"
#include "common/space_roots.hpp"

namespace encase {
namespace {

/// The planes that cut a box, one bit each; those from kMost on always count as cutting.
class CuttingPlanes {
 public:
  static constexpr std::size_t kMost = 64;
  explicit CuttingPlanes(const std::vector<Hyperplane<3>>& planes) : planes_(planes) {}

  using Set = std::uint64_t;
  static constexpr Set kAll = ~Set{0};

  /// Whether the box lies on the positive side of one of the planes. Takes those out of the set on
  /// the negative side of which it lies.
  bool outside(const Box<3>& box, Set* cutting) const {
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const Set bit = k < kMost ? Set{1} << k : 0;
      if (bit != 0 && (*cutting & bit) == 0) continue;
      const Hyperplane<3>& plane = planes_[k];
      double lo = plane.offset, hi = lo, sum = std::fabs(lo), reach = 1;
      for (int i = 0; i < 3; ++i) {
        const double n = plane.normal[i],
                     far = std::max(std::fabs(box.lo[i]), std::fabs(box.hi[i]));
        lo += n * (n < 0 ? box.hi[i] : box.lo[i]);
        hi += n * (n < 0 ? box.lo[i] : box.hi[i]);
        sum += std::fabs(n) * far;
        reach += far;
      }
      // Roundings, of rational coefficients too, and what underflows.
      const double slack = 0x1p-49 * sum + 0x1p-1000 * reach;
      if (lo > slack) return true;
      if (hi < -slack) *cutting &= ~bit;
    }
    return false;
  }

 private:
  const std::vector<Hyperplane<3>>& planes_;
};

/// A box to be searched.
struct Part {
  int node = 0;
  Box<3> box;
  Box<3> zeros{{-1, -1, -1}, {1, 1, 1}};  ///< in the box's coordinates, where all zeros are
  CuttingPlanes::Set cutting = CuttingPlanes::kAll;
  /// Along each axis, about: how much the Jacobian varies, or how wide the box is.
  Point<3> bend{1, 1, 1};
  std::array<int, 3> bits{};  ///< in which the nets were made
};

/// The search on small nets: depth first, so that what is at hand stays in the cache, but in bands
/// of some halvings, so that no place can use up what others need.
class SpaceSearch {
 public:
  SpaceSearch(const System<3>& system, const Box<3>& root,
              const std::vector<Hyperplane<3>>& half_spaces, const SubdivisionLimits& limits,
              Kernel& kernel)
      : system_(system),
        planes_(half_spaces),
        limits_(limits),
        kernel_(kernel),
        tree_(root),
        roots_(system, root, kernel) {
    std::size_t size = 0;
    for (const auto* f : system) size += static_cast<std::size_t>(SpaceNet::size(degree(*f) + 1));
    memory_.reset(static_cast<double*>(
        ::operator new[](frames_.size() * size * sizeof(double), std::align_val_t(64))));
    double* rows = memory_.get();
    for (SpaceSystem& frame : frames_)
      for (int i = 0; i < 3; ++i) {
        frame.nets[i].rows = rows;
        rows += SpaceNet::size(degree(*system[i]) + 1);
      }
  }

  static bool suits(const System<3>& system) {
    return std::all_of(system.begin(), system.end(),
                       [](const auto* f) { return degree(*f) < SpaceNet::kMaxCount; });
  }

  RootIsolation<3> run() {
    Part root;
    root.box = tree_.root();
    root.bits.fill(kernel_.start_bits);
    if (planes_.outside(root.box, &root.cutting))
      settle(root, cover::kOutside);
    else
      waiting_.push_back(root);
    while (!waiting_.empty()) {
      std::vector<Part> band = std::exchange(waiting_, {});
      for (Part& part : band) {
        // Fresh nets have the coordinates of a larger box where the centre is not a double.
        for (int i = 0; i < 3; ++i)
          if (!centered(part.box.lo[i], part.box.hi[i]).exact) {
            part.zeros.lo[i] = -1;
            part.zeros.hi[i] = 1;
          }
        frames_[0].order = {0, 1, 2};
        for (int i = 0; i < 3; ++i) expand(i, part.box, part.bits[i], &frames_[0]);
        visit(part, 0, 0);
      }
    }
    RootIsolation<3> result;
    result.root_box = tree_.root();
    result.tokens = tree_.tokens();
    result.boxes = tree_.size();
    result.unresolved = leaves(result.root_box, result.tokens, cover::kUnresolved);
    result.roots = std::move(roots_.boxes);
    result.rounded = std::move(roots_.rounded);
    return result;
  }

 private:
  static constexpr int kBand = 30;

  /// Of its net.
  static int degree(const FilteredFunction<3>& f) { return std::max(1, f.degree()); }

  void expand(int i, const Box<3>& box, int bits, SpaceSystem* frame) {
    system_[i]->expand(box, degree(*system_[i]), bits, kernel_, &net_);
    copy(net_, frame->order, &frame->nets[i]);
  }

  void settle(const Part& part, int token) {
    tree_.settle(part.node, token);
    if (token == cover::kUnresolved)
      ++kernel_.decisions.undecided;
    else
      kernel_.count(*std::max_element(part.bits.begin(), part.bits.end()));
  }

  /// Makes nets anew the radius of which is a noticeable part of them. All nets of a box share
  /// their coordinates, and a fresh one has those of a slightly larger box if the centre is not a
  /// double. (Such a box is hardly halved any more.)
  void sharpen(Part* part, SpaceSystem* frame) {
    const Box<3>& root = tree_.root();
    bool small = false;
    for (int i = 0; i < 3; ++i)
      small = small || part->box.width(i) < limits_.sharp_below * root.width(i);
    const double tolerated = small ? 0x1p-40 : 0x1p-10;
    for (int i = 0; i < 3; ++i) {
      SpaceNet& net = frame->nets[i];
      const auto coarse = [&] { return !(net.radius < tolerated * net.magnitude()); };
      if (!coarse()) continue;
      for (int k = 0; k < 3; ++k)
        if (!centered(part->box.lo[k], part->box.hi[k]).exact) return;
      for (int bits = part->bits[i]; bits > 0 && coarse(); bits = kernel_.next(bits)) {
        const double before = net.radius;
        expand(i, part->box, bits, frame);
        const bool gained = net.radius < 0.5 * before;
        if (bits > Kernel::kDoubleBits && bits > part->bits[i] && !gained) break;
        part->bits[i] = bits;
      }
    }
  }

  /// Settles the box whose nets are in a frame, `level` halvings below the band's beginning.
  void visit(Part part, std::size_t frame_number, std::size_t level) {
    SpaceSystem& frame = frames_[frame_number];
    if (++visited_ % 64 == 0 && !stopped_) stopped_ = limits_.stop && limits_.stop();
    if (stopped_) return settle(part, cover::kUnresolved);
    if (const int axis = free_axis(part); axis >= 0) return split(part, axis, frame, level);
    sharpen(&part, &frame);
    SpaceVerdict verdict;
    test_system(frame, SpaceRoots::kQuality, &verdict);
    if (verdict.excluded || !narrow(verdict.zeros, &part.zeros))
      return settle(part, cover::kExcluded);
    if (verdict.contracts)
      if (const auto k = root_in(part, verdict.contraction)) return settle(part, *k);
    part.bend = verdict.bend;
    if (part.bend == Point<3>{})
      for (int i = 0; i < 3; ++i) part.bend[i] = part.box.width(i) / tree_.root().width(i);
    int axis = free_axis(part);
    if (axis < 0)
      axis = static_cast<int>(std::max_element(part.bend.begin(), part.bend.end()) -
                              part.bend.begin());
    split(part, axis, frame, level);
  }

  /// An axis across which one of the halves is known to have no zeros and a halving helps, or -1.
  static int free_axis(const Part& part) {
    const double most = *std::max_element(part.bend.begin(), part.bend.end());
    int axis = -1;
    double least = 2;
    for (int i = 0; i < 3; ++i) {
      const double width = part.zeros.hi[i] - part.zeros.lo[i];
      if ((part.zeros.hi[i] < 0 || part.zeros.lo[i] > 0) && part.bend[i] >= most / 8 &&
          width < least) {
        least = width;
        axis = i;
      }
    }
    return axis;
  }

  /// Both hold all zeros. False if they have nothing in common.
  static bool narrow(const Box<3>& zeros, Box<3>* known) {
    for (int i = 0; i < 3; ++i) {
      known->lo[i] = std::max(known->lo[i], zeros.lo[i]);
      known->hi[i] = std::min(known->hi[i], zeros.hi[i]);
      if (known->lo[i] > known->hi[i]) return false;
    }
    return true;
  }

  std::optional<int> root_in(const Part& part, const Contraction<3>& c) {
    Point<3> guess;
    for (int i = 0; i < 3; ++i) {
      const Centered chart = centered(part.box.lo[i], part.box.hi[i]);
      guess[i] = chart.center + chart.half * 0.5 * (part.zeros.lo[i] + part.zeros.hi[i]);
    }
    const auto contract = [&](const Box<3>& box) -> std::optional<Contraction<3>> {
      SpaceSystem& spare = frames_.back();
      spare.order = {0, 1, 2};
      for (int i = 0; i < 3; ++i) expand(i, box, kernel_.start_bits, &spare);
      SpaceVerdict verdict;
      test_system(spare, SpaceRoots::kQuality, &verdict);
      if (verdict.excluded || !verdict.contracts) return std::nullopt;
      return verdict.contraction;
    };
    return roots_.root_near(part.box, c, guess, contract);
  }

  /// Halves the box, and the halves in which something may be found in turn.
  void split(const Part& part, int axis, const SpaceSystem& frame, std::size_t level) {
    std::array<Part, 2> half{part, part};
    if (!(tree_.size() + 2 <= limits_.max_boxes) ||
        !(part.box.width(axis) > limits_.smallest * tree_.root().width(axis)) ||
        !halve_box(part.box, axis, &half[0].box, &half[1].box))
      return settle(part, cover::kUnresolved);
    const int first = tree_.split(part.node, axis);
    std::array<bool, 2> open;
    for (int k = 0; k < 2; ++k) {
      Part& h = half[k];
      h.node = first + k;
      h.bend[axis] *= 0.5;
      // From the halved coordinate s to 2 s + 1 or 2 s - 1, rounded outward.
      const double shift = k == 0 ? 1 : -1;
      h.zeros.lo[axis] = std::max(-1.0, 2 * part.zeros.lo[axis] + shift - 0x1p-48);
      h.zeros.hi[axis] = std::min(1.0, 2 * part.zeros.hi[axis] + shift + 0x1p-48);
      const bool outside = h.cutting != 0 && planes_.outside(h.box, &h.cutting);
      open[k] = !outside && h.zeros.lo[axis] <= h.zeros.hi[axis];
      if (!open[k]) settle(h, outside ? cover::kOutside : cover::kExcluded);
    }
    const std::size_t frame_of_halves = 2 * level + 1;
    SpaceSystem &lower = frames_[frame_of_halves], &upper = frames_[frame_of_halves + 1];
    int position = 0;
    while (frame.order[position] != axis) ++position;
    lower.order = upper.order = order_of_halves(frame.order, position);
    // The polynomial that had a sign last comes first.
    for (int step = 0; step < 3 && (open[0] || open[1]); ++step) {
      const int i = (first_ + step) % 3;
      halve(frame.nets[i], position, &lower.nets[i], &upper.nets[i]);
      for (int k = 0; k < 2; ++k)
        if (open[k] && (k == 0 ? lower : upper).nets[i].sign()) {
          settle(half[k], cover::kExcluded);
          open[k] = false;
        }
      if (!open[0] && !open[1]) first_ = i;
    }
    for (int k = 0; k < 2; ++k) {
      if (!open[k]) continue;
      if (level + 1 < kBand)
        visit(half[k], frame_of_halves + k, level + 1);
      else
        waiting_.push_back(half[k]);
    }
  }

  struct Free {
    void operator()(double* memory) const { ::operator delete[](memory, std::align_val_t(64)); }
  };

  const System<3>& system_;
  const CuttingPlanes planes_;
  const SubdivisionLimits& limits_;
  Kernel& kernel_;
  Subdivision<3> tree_;
  SpaceRoots roots_;
  /// That of the band's box, two for every level below, and a spare one.
  std::array<SpaceSystem, 2 * kBand + 2> frames_;
  std::unique_ptr<double[], Free> memory_;
  std::vector<Part> waiting_;
  Bernstein<3> net_;  ///< an expansion before it is copied
  int first_ = 0;
  std::int64_t visited_ = 0;
  bool stopped_ = false;
};

/// The search on nets of any degree.
RootIsolation<3> search_large_nets(const System<3>& system, const Box<3>& root,
                                   const std::vector<Hyperplane<3>>& half_spaces,
                                   const SubdivisionLimits& limits, Kernel& kernel) {
  int degree = 0;
  for (const auto* f : system) degree = std::max(degree, f->degree());
  SpaceRoots roots(system, root, kernel);
  const auto contract = [&](const Box<3>& box) {
    SystemNets<3> nets;
    for (int i = 0; i < 3; ++i) system[i]->expand(box, degree, kernel.start_bits, kernel, &nets[i]);
    return contraction<3>(nets, SpaceRoots::kQuality);
  };
  const auto visit = [&](const SystemNets<3>& nets, const Box<3>& leaf) {
    if (excluded<3>(nets)) return cover::kExcluded;
    if (const auto c = contraction<3>(nets, SpaceRoots::kQuality))
      if (const auto k = roots.root_near(leaf, *c, leaf.center(), contract)) return *k;
    int axis = 0;
    double most = -1;
    for (int i = 0; i < 3; ++i) {
      double change = 0;
      for (const auto& net : nets)
        change += variation(net, i) / (largest_coefficient(net) + 1e-300);
      if (change > most) {
        most = change;
        axis = i;
      }
    }
    return cover::kSplitX - axis;
  };
  const Subdivision<3> tree = subdivide<3, 3>(system, root, half_spaces, limits, kernel, visit);
  RootIsolation<3> result;
  result.root_box = root;
  result.boxes = tree.size();
  result.tokens = tree.tokens();
  result.unresolved = leaves(root, result.tokens, cover::kUnresolved);
  result.roots = std::move(roots.boxes);
  result.rounded = std::move(roots.rounded);
  return result;
}

}  // namespace

template <>
RootIsolation<3> isolate_roots<3>(const System<3>& system, const Box<3>& box,
                                  const std::vector<Hyperplane<3>>& half_spaces,
                                  const SubdivisionLimits& limits, Kernel& kernel) {
  const Box<3> root = subdivision_root(box);
  if (SpaceSearch::suits(system))
    return SpaceSearch(system, root, half_spaces, limits, kernel).run();
  return search_large_nets(system, root, half_spaces, limits, kernel);
}

}  // namespace encase
