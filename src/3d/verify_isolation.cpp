// SPDX-License-Identifier: MIT
#include "3d/verify_isolation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "3d/solid_sides.hpp"
#include "common/interval.hpp"
#include "common/kernel.hpp"
#include "encase/cover.hpp"

namespace encase {
namespace {

/// Into how many parts a leaf may be cut to prove what does not show on the whole of it, and how
/// often the parts may be halved.
constexpr int kLeafParts = 2000, kLeafDepth = 40;

/// Halves a closed box at the double next to its middle: two closed boxes whose union it is. False
/// if there is no double in between.
bool halves(const Box<3>& box, int axis, Box<3>* lower, Box<3>* upper) {
  const double cut = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
  if (!(box.lo[axis] < cut && cut < box.hi[axis])) return false;
  *lower = *upper = box;
  lower->hi[axis] = upper->lo[axis] = cut;
  return true;
}

/// Whether `proves` holds on every part of some subdivision of a box. Uses up `parts`.
template <class Proves>
bool by_parts(const Box<3>& box, int depth, int* parts, const Proves& proves) {
  if (proves(box)) return true;
  if (--*parts < 0 || depth == kLeafDepth) return false;
  // Across the longest side, unless only another way gets somewhere.
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return box.width(a) > box.width(b); });
  Box<3> lower, upper;
  for (const int axis : axes)
    if (halves(box, axis, &lower, &upper) && (proves(lower) || proves(upper)))
      return by_parts(lower, depth + 1, parts, proves) && by_parts(upper, depth + 1, parts, proves);
  return halves(box, axes[0], &lower, &upper) && by_parts(lower, depth + 1, parts, proves) &&
         by_parts(upper, depth + 1, parts, proves);
}

bool well_formed(const Box<3>& box) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(box.lo[i]) || !std::isfinite(box.hi[i]) || !(box.lo[i] < box.hi[i]))
      return false;
  return true;
}

/// The values of a partial derivative, in the coordinates of the net.
Interval derivative_range(const Bernstein<3>& net, int axis) {
  Bernstein<3> derivative;
  differentiate(net, axis, &derivative);
  const auto [lo, hi] = std::minmax_element(derivative.b.begin(), derivative.b.end());
  return Interval(*lo, *hi) + Interval(-derivative.radius, derivative.radius);
}

/// About the inverse of the middles; zero where they are singular.
Matrix<3> middle_inverse(const std::array<std::array<Interval, 3>, 3>& j) {
  Matrix<3> y;
  const auto m = [&](int r, int c) { return j[r % 3][c % 3].mid(); };
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      y[r][c] = m(c + 1, r + 1) * m(c + 2, r + 2) - m(c + 1, r + 2) * m(c + 2, r + 1);
  double determinant = 0;
  for (int k = 0; k < 3; ++k) determinant += m(0, k) * y[k][0];
  for (auto& row : y)
    for (double& entry : row) entry /= determinant;
  return y;
}

class Checker {
 public:
  Checker(const System<3>& system, const Box<3>& box, const std::vector<HalfSpace>& half_spaces,
          const RootIsolation<3>& isolation, const VerifyOptions& options)
      : system_(system),
        box_(box),
        half_spaces_(half_spaces),
        isolation_(isolation),
        most_objections_(std::max(1, options.max_objections)) {
    kernel_.max_bits = options.max_bits;
  }

  Verification run() {
    if (!require(well_formed(isolation_.root_box) && isolation_.root_box.contains(box_),
                 "The subdivided box does not contain the region."))
      return report_;
    check_roots();
    replay();
    return report_;
  }

 private:
  bool full() const { return static_cast<int>(report_.objections.size()) >= most_objections_; }

  bool require(bool proved, const std::string& objection) {
    if (proved)
      ++report_.claims;
    else if (!full())
      report_.objections.push_back(objection);
    return proved;
  }

  void check_roots() {
    const auto& roots = isolation_.roots;
    require(isolation_.rounded.empty() || isolation_.rounded.size() == roots.size(),
            "There are not as many statements about rounding as roots.");
    for (std::size_t k = 0; k < roots.size() && !full(); ++k) {
      const std::string name = "The box of root " + std::to_string(k);
      if (!require(well_formed(roots[k]), name + " is none.")) continue;
      if (!require(exactly_one_zero<3>(system_, roots[k], kernel_),
                   name + " is not proved to hold exactly one common zero."))
        continue;
      for (std::size_t m = 0; m < k; ++m)
        require(!roots[k].meets(roots[m]), name + " meets that of root " + std::to_string(m) + ".");
      if (k < isolation_.rounded.size() && isolation_.rounded[k])
        require(rounding_is_proved(roots[k]),
                name + " has a centre that is not proved to be the correctly rounded zero.");
    }
  }

  void replay() {
    std::vector<Box<3>> stack{isolation_.root_box};
    for (std::size_t i = 0; i < isolation_.tokens.size() && !full(); ++i) {
      if (!require(!stack.empty(), "The subdivision has tokens left after its last leaf.")) return;
      const Box<3> box = stack.back();
      stack.pop_back();
      const int token = isolation_.tokens[i];
      if (token <= cover::kSplitX && token >= cover::kSplitZ) {
        Box<3> lower, upper;
        if (!require(halves(box, cover::kSplitX - token, &lower, &upper),
                     "The subdivision splits a box that doubles cannot split, at token " +
                         std::to_string(i) + "."))
          return;
        stack.push_back(upper);
        stack.push_back(lower);
        continue;
      }
      const char* objection = objection_to(token, box);
      require(!objection,
              "The leaf at token " + std::to_string(i) + " " + (objection ? objection : "") + ".");
    }
    if (!full()) require(stack.empty(), "The subdivision ends before its last leaf.");
  }

  /// What is wrong with a leaf, or nothing.
  const char* objection_to(int token, const Box<3>& box) {
    int parts = kLeafParts;
    if (token == cover::kExcluded) {
      const auto proves = [&](const Box<3>& part) {
        return no_common_zero<3>(system_, part, kernel_);
      };
      return by_parts(box, 0, &parts, proves) ? nullptr : "is not proved to have no common zero";
    }
    if (token == cover::kOutside)
      return std::any_of(half_spaces_.begin(), half_spaces_.end(),
                         [&](const auto& h) { return side_of(h, box) == Sign::Positive; })
                 ? nullptr
                 : "is not outside";
    if (token == cover::kUnresolved)
      return std::any_of(isolation_.unresolved.begin(), isolation_.unresolved.end(),
                         [&](const Box<3>& u) { return u.contains(box); })
                 ? nullptr
                 : "is not in an unresolved box";
    if (token < 0 || token >= static_cast<int>(isolation_.roots.size()))
      return "has a token without a meaning";
    const Box<3>& root = isolation_.roots[static_cast<std::size_t>(token)];
    const auto proves = [&](const Box<3>& part) {
      return at_most_one_zero<3>(system_, hull<3>(part, root), kernel_) ||
             no_common_zero<3>(system_, part, kernel_);
    };
    return by_parts(box, 0, &parts, proves)
               ? nullptr
               : "is not proved to have at most the zero that it names";
  }

  /// Whether the centre p of a box with one zero z is z, correctly rounded. With J the matrix whose
  /// rows are gradients at points between p and z, 0 = F(p) + J (z - p), and so z - p = -Y F(p) +
  /// (I - Y J) (z - p) for any Y.
  bool rounding_is_proved(const Box<3>& root) {
    const Point<3> p = root.center();
    for (const auto& [shift, bits] : {std::pair(26, Kernel::kDoubleBits), std::pair(40, 212)}) {
      const std::array<Interval, 3> offset = offset_from(p, root, shift, bits);
      bool proved = true;
      for (int k = 0; k < 3; ++k) {
        const double above = 0.5 * (std::nextafter(p[k], HUGE_VAL) - p[k]);
        const double below = 0.5 * (p[k] - std::nextafter(p[k], -HUGE_VAL));
        proved = proved && -below < offset[k].lo && offset[k].hi < above;
      }
      if (proved) return true;
    }
    return false;
  }

  /// Encloses z - p; gradients from nets, made with `bits`, on a box around that of the root, at
  /// least 2^-shift of p to either side.
  std::array<Interval, 3> offset_from(const Point<3>& p, const Box<3>& root, int shift, int bits) {
    Box<3> box;
    std::array<Interval, 3> far, half;
    for (int k = 0; k < 3; ++k) {
      const double to_end = std::max(root.hi[k] - p[k], p[k] - root.lo[k]);
      const double reach = std::max(std::ldexp(std::fabs(p[k]), -shift), 2 * to_end);
      far[k] = Interval(-round_up(to_end), round_up(to_end));
      box.lo[k] = p[k] - reach;
      box.hi[k] = p[k] + reach;
      half[k] = centered(box.lo[k], box.hi[k]).half;
    }
    std::array<std::array<Interval, 3>, 3> j;
    std::array<Interval, 3> value, result;
    for (int i = 0; i < 3; ++i) {
      Bernstein<3> net;
      system_[i]->expand(box, system_[i]->degree(), bits, kernel_, &net);
      for (int k = 0; k < 3; ++k) j[i][k] = derivative_range(net, k) / half[k];
      // At a zero nothing but the rounding error is left of a value in doubles.
      const auto v = system_[i]->evaluate(p, 4 * Kernel::kDoubleBits);
      value[i] = Interval(v.value) + Interval(-v.error, v.error);
    }
    const Matrix<3> y = middle_inverse(j);
    for (int k = 0; k < 3; ++k) {
      Interval sum;
      for (int i = 0; i < 3; ++i) sum = sum - Interval(y[k][i]) * value[i];
      for (int m = 0; m < 3; ++m) {
        Interval entry(k == m ? 1.0 : 0.0);
        for (int i = 0; i < 3; ++i) entry = entry - Interval(y[k][i]) * j[i][m];
        sum = sum + entry * far[m];
      }
      result[k] = sum;
    }
    return result;
  }

  const System<3>& system_;
  const Box<3>& box_;
  const std::vector<HalfSpace>& half_spaces_;
  const RootIsolation<3>& isolation_;
  int most_objections_;
  Kernel kernel_;
  Verification report_;
};

}  // namespace

Verification verify_isolation(const System<3>& system, const Box<3>& box,
                              const std::vector<HalfSpace>& half_spaces,
                              const RootIsolation<3>& isolation, const VerifyOptions& options) {
  return Checker(system, box, half_spaces, isolation, options).run();
}

}  // namespace encase
