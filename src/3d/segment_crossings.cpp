// SPDX-License-Identifier: MIT
#include "3d/segment_crossings.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/components.hpp"
#include "common/substitute.hpp"

namespace encase {
namespace {

/// A closed interval with one root of a function's restriction, and none at its ends.
struct Root {
  Rational lo, hi;
  int function;
};

class SegmentRoots {
 public:
  /// False if one of the functions is zero at an end or no polynomial.
  bool find(const std::vector<const Function<3>*>& functions, const RationalPoint<3>& from,
            const RationalPoint<3>& to) {
    std::array<Polynomial<1>, 3> way;
    for (std::size_t i = 0; i < 3; ++i)
      way[i] = Polynomial<1>::constant(from[i]) +
               Polynomial<1>::constant(to[i] - from[i]) * Polynomial<1>::variable(0);
    for (std::size_t k = 0; k < functions.size(); ++k) {
      if (!functions[k]->is_polynomial()) return false;
      functions_.push_back(substitute<1, 3>(functions[k]->polynomial(), way));
      const int f = static_cast<int>(k);
      if (sign(f, 0) == 0 || sign(f, 1) == 0) return false;
      isolate(f, 0, 1);
    }
    return true;
  }

  /// Puts the roots of different functions in a proved order; false if that does not end.
  bool order() {
    constexpr int kMostRounds = 64;
    for (int round = 0; round < kMostRounds; ++round) {
      std::sort(roots_.begin(), roots_.end(),
                [](const Root& a, const Root& b) { return a.lo < b.lo; });
      bool apart = true;
      for (std::size_t k = 0; k + 1 < roots_.size(); ++k) {
        Root &a = roots_[k], &b = roots_[k + 1];
        if (a.function == b.function || a.hi < b.lo) continue;
        apart = false;
        halve(&a);
        halve(&b);
      }
      if (apart) return true;
    }
    return false;
  }

  std::vector<int> changes() const {
    std::vector<int> result;
    for (const Root& root : roots_)
      if (sign(root.function, root.lo) != sign(root.function, root.hi))
        result.push_back(root.function);
    return result;
  }

 private:
  int sign(int f, const Rational& t) const {
    return sgn(functions_[static_cast<std::size_t>(f)](RationalPoint<1>{t}));
  }
  int count(int f, const Rational& lo, const Rational& hi) const {
    return count_real_roots(functions_[static_cast<std::size_t>(f)], lo, hi);
  }
  /// A point between two where the function is not zero.
  Rational between(int f, const Rational& lo, const Rational& hi) const {
    Rational at = (lo + hi) / 2;
    while (sign(f, at) == 0) at = (lo + at) / 2;
    return at;
  }

  void isolate(int f, const Rational& lo, const Rational& hi) {
    const int roots = count(f, lo, hi);
    if (roots == 1) roots_.push_back({lo, hi, f});
    if (roots < 2) return;
    const Rational middle = between(f, lo, hi);
    isolate(f, lo, middle);
    isolate(f, middle, hi);
  }

  void halve(Root* root) const {
    const Rational middle = between(root->function, root->lo, root->hi);
    (count(root->function, root->lo, middle) == 1 ? root->hi : root->lo) = middle;
  }

  std::vector<Polynomial<1>> functions_;
  std::vector<Root> roots_;
};

}  // namespace

std::optional<std::vector<int>> sign_changes(const std::vector<const Function<3>*>& functions,
                                             const RationalPoint<3>& from,
                                             const RationalPoint<3>& to) {
  SegmentRoots roots;
  if (!roots.find(functions, from, to) || !roots.order()) return std::nullopt;
  return roots.changes();
}

}  // namespace encase
