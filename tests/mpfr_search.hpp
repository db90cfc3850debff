// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "common/expression_program.hpp"
#include "encase/crossing.hpp"
#include "encase/function.hpp"

/// The slow and obvious oracle for common zeros of two functions: subdivision in MPFR intervals of
/// 200 bits. It shares nothing with the search but the evaluation of expressions.
namespace encase::mpfr_search {

class System {
 public:
  System(const Function<2>& f, const Function<2>& g, int bits = 200)
      : bits_(bits), programs_{program(f), program(g)} {}

  /// Boxes that hold one common zero each, of all that there are in a box. Throws where one is not
  /// simple, or hard to tell from another.
  std::vector<RationalBox> common_zeros(const RationalBox& box) {
    std::vector<RationalBox> open = halved({box}, 22);
    std::vector<RationalBox> zeros;
    for (int round = 0; !open.empty(); ++round) {
      if (round > 12) throw std::runtime_error("a common zero is hard to tell");
      std::vector<RationalBox> rest;
      for (const std::vector<RationalBox>& cluster : clusters(open)) {
        RationalBox around = hull(cluster);
        for (int i = 0; i < 2; ++i) {
          const Rational margin = around.hi[i] - around.lo[i];
          around.lo[i] -= margin;
          around.hi[i] += margin;
        }
        if (holds_one_zero(around))
          zeros.push_back(around);
        else
          rest.insert(rest.end(), cluster.begin(), cluster.end());
      }
      open = halved(rest, 2);
    }
    return zeros;
  }

  /// Krawczyk's test: the image of the box lies in its interior, so the box has a zero; and all
  /// matrices of the preconditioned enclosure of the Jacobian are close to the identity, so it has
  /// only one.
  bool holds_one_zero(const RationalBox& box) {
    std::array<Jet, 2> on_box{jet(0, box), jet(1, box)};
    if (!on_box[0].smooth() || !on_box[1].smooth()) return false;
    RationalPoint<2> center;
    for (int i = 0; i < 2; ++i) center[i] = (box.lo[i] + box.hi[i]) / 2;
    const std::array<MpfrInterval, 2> value{jet(0, {center, center}).range(),
                                            jet(1, {center, center}).range()};
    std::array<std::array<double, 2>, 2> j;
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 2; ++i) {
        const MpfrInterval& d = on_box[k].jet.first(i);
        j[k][i] = 0.5 * (mpfr_get_d(d.lo(), MPFR_RNDN) + mpfr_get_d(d.hi(), MPFR_RNDN));
      }
    const double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    if (!(std::fabs(det) > 0)) return false;
    const double y[2][2] = {{j[1][1] / det, -j[0][1] / det}, {-j[1][0] / det, j[0][0] / det}};
    for (int k = 0; k < 2; ++k) {
      const MpfrInterval a(bits_, y[k][0]), b(bits_, y[k][1]);
      MpfrInterval image = -(a * value[0] + b * value[1]);
      Rational spread = 0;
      for (int i = 0; i < 2; ++i) {
        const MpfrInterval rest = MpfrInterval(bits_, i == k ? 1.0 : 0.0) -
                                  (a * on_box[0].jet.first(i) + b * on_box[1].jet.first(i));
        spread += largest(rest);
        image += rest * MpfrInterval(bits_, Rational(box.lo[i] - center[i]),
                                     Rational(box.hi[i] - center[i]));
      }
      if (!(spread < 1) || !(largest(image) < (box.hi[k] - box.lo[k]) / 2)) return false;
    }
    return true;
  }

 private:
  using Jet = JetOnBox<MpfrInterval, 2, 1>;

  static ExpressionProgram<2> program(const Function<2>& f) {
    return ExpressionProgram<2>(f.is_polynomial() ? Expression(f.polynomial()) : f.expression());
  }
  Jet jet(int which, const RationalBox& box) {
    const std::array<MpfrInterval, 2> at{MpfrInterval(bits_, box.lo[0], box.hi[0]),
                                         MpfrInterval(bits_, box.lo[1], box.hi[1])};
    return programs_[static_cast<std::size_t>(which)].value_and_gradient(at, workspace_);
  }
  static Rational exact(mpfr_srcptr value) {
    if (mpfr_number_p(value) == 0) return Rational(1e300);
    Rational q;
    mpfr_get_q(q.get_mpq_t(), value);
    return q;
  }
  static Rational largest(const MpfrInterval& x) {
    return std::max<Rational>(abs(exact(x.lo())), abs(exact(x.hi())));
  }
  static bool nonzero(const MpfrInterval& x) {
    return mpfr_sgn(x.lo()) > 0 || mpfr_sgn(x.hi()) < 0;
  }

  bool excluded(const RationalBox& box) {
    for (const int which : {0, 1}) {
      const Jet whole = jet(which, box);
      if (nonzero(whole.range())) return true;
      if (!whole.smooth()) continue;
      RationalPoint<2> center;
      for (int i = 0; i < 2; ++i) center[i] = (box.lo[i] + box.hi[i]) / 2;
      MpfrInterval sum = jet(which, {center, center}).range();
      for (int i = 0; i < 2; ++i)
        sum += whole.jet.first(i) * MpfrInterval(bits_, Rational(box.lo[i] - center[i]),
                                                 Rational(box.hi[i] - center[i]));
      if (nonzero(sum)) return true;
    }
    return false;
  }

  /// What is left of boxes that are halved so many times.
  std::vector<RationalBox> halved(std::vector<RationalBox> boxes, int times) {
    for (int k = 0; k < times; ++k) {
      std::vector<RationalBox> halves;
      for (const RationalBox& box : boxes) {
        const int axis = box.hi[0] - box.lo[0] >= box.hi[1] - box.lo[1] ? 0 : 1;
        for (const bool upper : {false, true}) {
          RationalBox half = box;
          (upper ? half.lo : half.hi)[axis] = (box.lo[axis] + box.hi[axis]) / 2;
          if (!excluded(half)) halves.push_back(std::move(half));
        }
      }
      boxes = std::move(halves);
    }
    return boxes;
  }

  static bool touch(const RationalBox& a, const RationalBox& b) {
    for (int i = 0; i < 2; ++i)
      if (a.hi[i] < b.lo[i] || b.hi[i] < a.lo[i]) return false;
    return true;
  }
  static RationalBox hull(const std::vector<RationalBox>& boxes) {
    RationalBox all = boxes.front();
    for (const RationalBox& box : boxes)
      for (int i = 0; i < 2; ++i) {
        all.lo[i] = std::min(all.lo[i], box.lo[i]);
        all.hi[i] = std::max(all.hi[i], box.hi[i]);
      }
    return all;
  }
  static std::vector<std::vector<RationalBox>> clusters(const std::vector<RationalBox>& boxes) {
    std::vector<std::vector<RationalBox>> result;
    std::vector<bool> used(boxes.size(), false);
    for (std::size_t first = 0; first < boxes.size(); ++first) {
      if (used[first]) continue;
      used[first] = true;
      std::vector<RationalBox> cluster{boxes[first]};
      for (std::size_t k = 0; k < cluster.size(); ++k)
        for (std::size_t other = 0; other < boxes.size(); ++other)
          if (!used[other] && touch(cluster[k], boxes[other])) {
            used[other] = true;
            cluster.push_back(boxes[other]);
          }
      result.push_back(std::move(cluster));
    }
    return result;
  }

  int bits_;
  std::array<ExpressionProgram<2>, 2> programs_;
  ExpressionProgram<2>::Workspace<MpfrInterval> workspace_;
};

}  // namespace encase::mpfr_search
