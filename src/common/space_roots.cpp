// SPDX-License-Identifier: MIT
#include "common/space_roots.hpp"

#include <algorithm>
#include <cmath>

#include "common/interval.hpp"

namespace encase {
namespace {

constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies

double ulp(double x) {
  x = std::fabs(x);
  return std::nextafter(x, HUGE_VAL) - x;
}

/// The unevaluated sum of two doubles, `low` within half an ulp of `high`.
struct Pair {
  double high = 0, low = 0;
};

/// a + b, exactly (Knuth).
Pair exact_sum(double a, double b) {
  const double sum = a + b, second = sum - a;
  return {sum, (a - (sum - second)) + (b - second)};
}

/// A factor, split into two halves with 26 digits each (Veltkamp).
struct Factor {
  explicit Factor(double x) : whole(x) {
    const double c = 0x1p27 * x + x;
    upper = c - (c - x);
    lower = x - upper;
  }
  double whole, upper, lower;
};

/// a * x + c, with an error below 2^-103 (|a x| + |c|).
Pair multiply_add(const Pair& a, const Factor& x, const Pair& c) {
  // The product of the high parts exactly (Dekker).
  const Factor f(a.high);
  const double product = a.high * x.whole;
  const double lost =
      ((f.upper * x.upper - product) + f.upper * x.lower + f.lower * x.upper) + f.lower * x.lower;
  const Pair scaled = exact_sum(product, lost + a.low * x.whole);
  const Pair sum = exact_sum(scaled.high, c.high);
  return exact_sum(sum.high, sum.low + (scaled.low + c.low));
}

/// J^-1, approximately; false where J is singular.
bool invert(const Matrix<3>& m, Matrix<3>* inverse) {
  Matrix<3>& a = *inverse;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      a[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
    }
  const double d = 1 / (m[0][0] * a[0][0] + m[0][1] * a[1][0] + m[0][2] * a[2][0]);
  bool finite = d != 0;
  for (auto& row : a)
    for (double& entry : row) {
      entry *= d;
      finite = finite && std::isfinite(entry);
    }
  return finite;
}

Point<3> times(const Matrix<3>& m, const Point<3>& v) {
  Point<3> result;
  for (int i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

/// Whether no side is more than 64 ulps long.
bool narrow(const Box<3>& box) {
  for (int k = 0; k < 3; ++k)
    if (box.width(k) > 64 * ulp(box.hi[k])) return false;
  return true;
}

/// A box around x, with ends that are multiples of some ulps from it so that x is its centre, at
/// least `wanted` to either side; false if it is not inside `around`.
bool round_box(const Point<3>& x, const Point<3>& wanted, const Box<3>& around, Box<3>* box) {
  for (int k = 0; k < 3; ++k) {
    const double unit = 4 * ulp(std::fabs(x[k]) + wanted[k]);
    const double r = std::ceil(wanted[k] / unit) * unit;
    box->lo[k] = x[k] - r;
    box->hi[k] = x[k] + r;
    if (!(around.lo[k] < box->lo[k] && box->hi[k] < around.hi[k])) return false;
  }
  return true;
}

}  // namespace

PreciseSpacePolynomial::PreciseSpacePolynomial(const FilteredPolynomial<3>& f)
    : degree_(f.degree()) {
  const int n = degree_ + 1;
  const std::vector<double>& low = f.low_coefficients();
  for (int i = degree_; i >= 0; --i)
    for (int j = degree_ - i; j >= 0; --j)
      for (int k = degree_ - i - j; k >= 0; --k) {
        const std::size_t at = static_cast<std::size_t>((i * n + j) * n + k);
        coefficients_.push_back(f.coefficients()[at]);
        if (!f.exact_coefficients()) low_.push_back(low[at]);
      }
}

FilteredPolynomial<3>::Value PreciseSpacePolynomial::value(const Point<3>& point,
                                                           double absolute) const {
  const Factor x(point[0]), y(point[1]), z(point[2]);
  Pair of_x;
  std::size_t at = 0;
  for (int i = degree_; i >= 0; --i) {
    Pair of_y;
    for (int j = degree_ - i; j >= 0; --j) {
      Pair of_z;
      for (int k = degree_ - i - j; k >= 0; --k, ++at)
        of_z = multiply_add(of_z, z, {coefficients_[at], low_.empty() ? 0.0 : low_[at]});
      of_y = multiply_add(of_y, y, of_z);
    }
    of_x = multiply_add(of_x, x, of_y);
  }
  // Far from where something might overflow, or what underflows might be amplified too much.
  double reach = 1;
  for (double c : point) reach += std::fabs(c);
  if (!(absolute < 0x1p500) || !(degree_ * std::log2(reach) < 500)) return {0.0, HUGE_VAL};
  const double value = of_x.high + of_x.low;
  return {value,
          ((2 * degree_ + 5) * 0x1p-102 * absolute + 0x1p-53 * std::fabs(value)) * kUp + 0x1p-400};
}

/// A point, and the approximate Jacobian at one nearby.
struct SpaceRoots::Approximation {
  Point<3> x;
  Point<3> before;
  Matrix<3> jacobian;
  bool converged = false;
};

SpaceRoots::SpaceRoots(const System<3>& system, const Box<3>& root, Kernel& kernel)
    : system_(system), kernel_(kernel) {
  int degree = 0;
  bool polynomials = true;
  for (const auto* f : system) {
    degree = std::max(degree, f->degree());
    polynomials = polynomials && f->is_polynomial();
  }
  for (int k = 0; k < 3; ++k) margin_[k] = root.width(k) / (4 * (degree + 1));
  if (polynomials)
    for (const auto* f : system) precise_.emplace_back(f->polynomial());
}

/// Newton's iteration; nothing if it leaves `reach`.
std::optional<SpaceRoots::Approximation> SpaceRoots::iterate(const Point<3>& start, double reach,
                                                             bool precise) const {
  Approximation a;
  a.x = start;
  double last = HUGE_VAL;
  for (int round = 0; round < 12; ++round) {
    Point<3> value;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = system_[i]->value_and_gradient(a.x);
      value[i] = precise ? precise_[i].value(a.x, 0).value : v.value;
      a.jacobian[i] = v.gradient;
    }
    Matrix<3> y;
    if (!invert(a.jacobian, &y)) return std::nullopt;
    const Point<3> d = times(y, value);
    a.before = a.x;
    double size = 0;
    for (int k = 0; k < 3; ++k) {
      a.x[k] -= d[k];
      size = std::max(size, std::fabs(d[k]));
      if (!(std::fabs(a.x[k] - start[k]) <= reach)) return std::nullopt;
    }
    // Quadratic convergence: what remains is the business of more precise values.
    a.converged = size <= 1e-7 * reach;
    if (a.converged || (round > 2 && size >= 0.5 * last)) break;
    last = size;
  }
  return a;
}

/// With values in doubles, and where these are too coarse with precise ones.
std::optional<SpaceRoots::Approximation> SpaceRoots::newton(const Point<3>& start,
                                                            double reach) const {
  const auto a = iterate(start, reach, false);
  if ((a && a->converged) || precise_.empty()) return a;
  const auto b = iterate(start, reach, true);
  return b ? b : a;
}

/// A box some units in the last place wide around the zero near a.x, from one precise value there:
/// with Y about the inverse of the Jacobian at a point nearby, and its change bounded on X = a.x +-
/// reach, every zero z in X has |z - (a.x - Y F(a.x))| <= E reach, E >= |I - Y J|; if that is
/// inside X, there is one.
std::optional<SpaceRoots::Enclosure> SpaceRoots::tight_box_at(const Box<3>& around,
                                                              const Approximation& a,
                                                              Point<3>* step) const {
  Matrix<3> y;
  if (!invert(a.jacobian, &y)) return std::nullopt;
  Point<3> magnitude;
  for (int k = 0; k < 3; ++k)
    magnitude[k] = std::max(std::fabs(a.x[k]), std::fabs(a.before[k])) + margin_[k];
  Point<3> absolute, error{0x1p-400, 0x1p-400, 0x1p-400}, &d = *step;
  d = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    absolute[i] = system_[i]->polynomial().absolute(magnitude);
    const auto v = precise_[static_cast<std::size_t>(i)].value(a.x, absolute[i]);
    for (int k = 0; k < 3; ++k) {
      d[k] += y[k][i] * v.value;
      error[k] += std::fabs(y[k][i]) * v.error + 0x1p-50 * std::fabs(y[k][i] * v.value);
    }
  }
  Point<3> reach;
  double far = 0;  // in units of the margins
  for (int k = 0; k < 3; ++k) {
    error[k] *= kUp;
    reach[k] = 2 * std::fabs(d[k]) + 4 * error[k] + 8 * ulp(a.x[k]);
    const double part = (std::fabs(a.x[k] - a.before[k]) + reach[k]) / margin_[k];
    if (!(part < 0.5)) return std::nullopt;
    far += part;
  }
  Point<3> image = error;
  for (int k = 0; k < 3; ++k) {
    for (int m = 0; m < 3; ++m) {
      double product = 0, sum = 0, change = 0;
      for (int i = 0; i < 3; ++i) {
        product += y[k][i] * a.jacobian[i][m];
        sum += std::fabs(y[k][i] * a.jacobian[i][m]);
        // Of the derivative, by the second ones, and what it was rounded by.
        const double slope = 2 * absolute[i] / margin_[m];
        change +=
            std::fabs(y[k][i]) * slope * (4 * far + (3 * system_[i]->degree() + 12) * 0x1.1p-53);
      }
      const double e = (std::fabs((k == m ? 1.0 : 0.0) - product) + 0x1p-50 * (sum + 1) + change);
      image[k] += e * reach[m] * kUp;
    }
    if (!((std::fabs(d[k]) + image[k]) * kUp < reach[k])) return std::nullopt;
  }
  // Around a double, with room for a checker.
  Enclosure result;
  result.rounded = true;
  Point<3> center, wanted;
  for (int k = 0; k < 3; ++k) {
    const double x = a.x[k] - d[k];
    center[k] = x;
    // What the difference lost (Knuth), and how far the zero may be from the exact one: less than
    // half the distance to the next double?
    const double back = x - a.x[k];
    const double lost = (a.x[k] - (x - back)) + (-d[k] - back);
    const double gap = std::fabs(x) - std::nextafter(std::fabs(x), 0.0);
    result.rounded = result.rounded && (std::fabs(lost) + image[k]) * kUp < 0.5 * gap;
    wanted[k] =
        16 * std::max(image[k] + ulp(x), ulp(std::max(std::fabs(x), 0x1p-20 * around.width(k))));
  }
  if (!round_box(center, wanted, around, &result.box)) return std::nullopt;
  // The ends round where x lies next to a power of two.
  result.rounded = result.rounded && result.box.center() == center;
  return result;
}

/// The same, with the Jacobian from closer by where that makes the box narrower.
std::optional<SpaceRoots::Enclosure> SpaceRoots::tight_box(const Box<3>& around,
                                                           Approximation a) const {
  for (int round = 0;; ++round) {
    Point<3> d;
    const auto enclosure = tight_box_at(around, a, &d);
    if (round == 2 || (enclosure && enclosure->rounded && narrow(enclosure->box))) return enclosure;
    for (int i = 0; i < 3; ++i) a.jacobian[i] = system_[i]->gradient(a.x);
    a.before = a.x;
    for (int k = 0; k < 3; ++k) a.x[k] -= d[k];
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(a.x[k])) return enclosure;
  }
}

/// The box around one zero near a.x, by Krawczyk's test within `around`, whose contraction is
/// known.
///
/// With R = radius in local coordinates, |Y F(x)| + E R < R in every coordinate proves a zero in
/// x +- R, if x +- R lies in `around`: the Krawczyk operator maps that box into its interior.
std::optional<SpaceRoots::Enclosure> SpaceRoots::enclose(const Box<3>& around,
                                                         const Contraction<3>& c,
                                                         const Approximation& a) const {
  Point<3> x = a.x;
  std::optional<Enclosure> best;
  double best_width = HUGE_VAL;
  // The half widths of the net that the contraction comes from, or a little more.
  Point<3> half;
  for (int k = 0; k < 3; ++k) half[k] = centered(around.lo[k], around.hi[k]).half;
  for (int bits = kernel_.start_bits; bits > 0; bits = kernel_.next(bits)) {
    for (int step = 0; step < 6; ++step) {
      Point<3> correction{}, residual{}, value{};
      for (int i = 0; i < 3; ++i) {
        const auto v = system_[i]->evaluate(x, bits);
        value[i] = v.value;
        for (int k = 0; k < 3; ++k) {
          const double y = c.preconditioner[k][i];
          correction[k] += y * v.value;
          residual[k] += std::fabs(y) * v.error + 0x1p-50 * std::fabs(y * v.value);
        }
      }
      for (int k = 0; k < 3; ++k) residual[k] = (residual[k] + std::fabs(correction[k])) * kUp;
      // The smallest multiple t of the weights v that makes a Krawczyk radius (as E v < v), 16
      // times enlarged to leave a checker room, and no less than 16 ulps in any coordinate.
      double t = 0;
      for (int k = 0; k < 3; ++k) {
        const double inside = times(c.bound, c.weights)[k];
        t = std::max(t, 16 * residual[k] / (c.weights[k] - inside * kUp));
        const double size = std::max(std::fabs(x[k]), 0x1p-20 * half[k]);
        t = std::max(t, 16 * ulp(size) / (c.weights[k] * half[k]));
      }
      Point<3> wanted, radius;
      for (int k = 0; k < 3; ++k) wanted[k] = t * c.weights[k] * half[k] * kUp;
      Box<3> box;
      if (std::isfinite(t) && round_box(x, wanted, around, &box)) {
        double width = 0;
        for (int k = 0; k < 3; ++k) {
          // What is proved holds for a box inside the rounded one.
          radius[k] = (0.5 * box.width(k) - 2 * ulp(x[k])) / half[k] * (1 - 0x1p-40);
          width = std::max(width, box.width(k) / half[k]);
        }
        const Point<3> moved = times(c.bound, radius);
        bool proved = width < best_width;
        for (int k = 0; k < 3; ++k) proved = proved && (residual[k] + moved[k]) * kUp < radius[k];
        if (proved) {
          best = Enclosure{box, false};
          best_width = width;
        }
      }
      // A Newton step, as long as it moves the point.
      Matrix<3> jacobian, inverse;
      for (int i = 0; i < 3; ++i) jacobian[i] = system_[i]->gradient(x);
      if (!invert(jacobian, &inverse)) break;
      const Point<3> d = times(inverse, value);
      bool moved = false, within = true;
      for (int k = 0; k < 3; ++k) {
        moved = moved || std::fabs(d[k]) > 2 * ulp(x[k]);
        x[k] -= d[k];
        within = within && around.lo[k] < x[k] && x[k] < around.hi[k];
      }
      if (!within) return best;
      if (!moved || bits <= Kernel::kDoubleBits) break;
    }
    if ((best && narrow(best->box)) || bits >= 4 * Kernel::kDoubleBits) break;
  }
  return best;
}

std::optional<int> SpaceRoots::root_near(const Box<3>& leaf, const Contraction<3>& c,
                                         const Point<3>& guess, const Contract& contract) {
  // One that is known?
  for (std::size_t k = 0; k < boxes.size(); ++k)
    if (leaf.contains(boxes[k]) || alone_[k].contains(leaf)) return static_cast<int>(k);
  const auto a = newton(guess, 2 * leaf.largest_width());
  if (!a) return std::nullopt;
  double offset = 0;
  const Point<3> center = leaf.center();
  for (int i = 0; i < 3; ++i)
    offset = std::max(offset, std::fabs(a->x[i] - center[i]) / (0.5 * leaf.width(i)));
  // Beyond the border it is another leaf's.
  if (!(offset < 1.001)) return std::nullopt;
  Box<3> around = leaf;
  std::optional<Contraction<3>> centered_there;
  if (offset > 0.999) {
    // At the border: argue on a box that has it in the middle.
    for (std::size_t k = 0; k < boxes.size(); ++k)
      if (alone_[k].contains(a->x)) return std::nullopt;
    for (int i = 0; i < 3; ++i) {
      around.lo[i] = a->x[i] - 0.5 * leaf.width(i);
      around.hi[i] = a->x[i] + 0.5 * leaf.width(i);
    }
    centered_there = contract(around);
    if (!centered_there) return std::nullopt;
  }
  std::optional<Enclosure> root;
  if (!precise_.empty() && kernel_.start_bits == Kernel::kDoubleBits) root = tight_box(around, *a);
  if (!root) root = enclose(around, centered_there ? *centered_there : c, *a);
  if (!root) return std::nullopt;
  for (const Box<3>& box : boxes)
    if (box.meets(root->box)) return std::nullopt;
  boxes.push_back(root->box);
  rounded.push_back(root->rounded);
  alone_.push_back(around);
  if (!around.contains(leaf)) return std::nullopt;
  return static_cast<int>(boxes.size()) - 1;
}

}  // namespace encase
