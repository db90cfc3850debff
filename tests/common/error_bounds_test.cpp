// SPDX-License-Identifier: MIT
// |computed - exact| <= radius, coefficient by coefficient, against rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "common/box_tests.hpp"
#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "common/segments.hpp"

namespace encase {
namespace {

constexpr int kRungs[] = {53, 64, 106};

using Random = std::mt19937_64;

double uniform(Random& random, double lo, double hi) {
  return lo + (hi - lo) * std::ldexp(static_cast<double>(random() >> 11), -53);
}

Rational power_of_two(int e) {
  Rational r = 1;
  if (e >= 0)
    mpq_mul_2exp(r.get_mpq_t(), r.get_mpq_t(), static_cast<unsigned long>(e));
  else
    mpq_div_2exp(r.get_mpq_t(), r.get_mpq_t(), static_cast<unsigned long>(-e));
  return r;
}

/// What FilteredFunction scales by, found from a value that is far from zero.
template <int D>
Rational scale_of(const FilteredFunction<D>& f) {
  int e = std::numeric_limits<int>::min();
  for (const auto& term : f.polynomial().exact().terms())
    e = std::max(e, static_cast<int>(mpz_sizeinbase(term.coefficient.get_num_mpz_t(), 2)) -
                        static_cast<int>(mpz_sizeinbase(term.coefficient.get_den_mpz_t(), 2)));
  return power_of_two(-e);
}

Rational power(const Rational& x, int n) {
  Rational p = 1;
  for (int i = 0; i < n; ++i) p *= x;
  return p;
}

/// The Bernstein coefficients on [-1,1] of Taylor coefficients along one axis, exactly: those of
/// ((1 + s) - (1 - s))^k / 2^k ((1 + s) + (1 - s))^(m - k) / 2^(m - k).
std::vector<Rational> bernstein(const std::vector<Rational>& taylor, int m) {
  // On [0,1] with s = 2 u - 1: powers of u first, then b_j = sum over k of C(j,k) / C(m,k) a_k.
  const int n = static_cast<int>(taylor.size()) - 1;
  std::vector<Rational> in_u(static_cast<std::size_t>(n) + 1, Rational(0));
  for (int k = n; k >= 0; --k) {
    for (int i = n; i > 0; --i) in_u[i] = 2 * in_u[i - 1] - in_u[i];
    in_u[0] = taylor[k] - in_u[0];
  }
  std::vector<Rational> b(static_cast<std::size_t>(m) + 1, Rational(0));
  for (int j = 0; j <= m; ++j) {
    Rational ratio = 1;
    for (int k = 0; k <= std::min(n, j); ++k) {
      b[j] += ratio * in_u[k];
      ratio *= Rational(j - k, m - k > 0 ? m - k : 1);
      ratio.canonicalize();
    }
  }
  return b;
}

/// The polynomial of two variables as rows of coefficients of s_0^i s_1^j after x = o + h s.
std::vector<std::vector<Rational>> local(const Polynomial<2>& f, const RationalPoint<2>& o,
                                         const RationalPoint<2>& h) {
  const int n = f.degree();
  std::vector<std::vector<Rational>> c(n + 1, std::vector<Rational>(n + 1, Rational(0)));
  for (const auto& t : f.terms()) c[t.exponent[0]][t.exponent[1]] = t.coefficient;
  for (int i = 0; i < n; ++i)
    for (int k = n - 1; k >= i; --k)
      for (int j = 0; j <= n; ++j) c[k][j] += o[0] * c[k + 1][j];
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = n - 1; k >= j; --k) c[i][k] += o[1] * c[i][k + 1];
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) c[i][j] *= power(h[0], i) * power(h[1], j);
  return c;
}

std::vector<Rational> exact_net(const Polynomial<2>& f, const Box<2>& box, int m) {
  RationalPoint<2> o, h;
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    o[i] = chart.center;
    h[i] = chart.half;
  }
  std::vector<std::vector<Rational>> rows;
  for (const auto& row : local(f, o, h)) rows.push_back(bernstein(row, m));
  std::vector<Rational> net(static_cast<std::size_t>(m + 1) * (m + 1));
  for (int j = 0; j <= m; ++j) {
    std::vector<Rational> column;
    for (const auto& row : rows) column.push_back(row[j]);
    const std::vector<Rational> b = bernstein(column, m);
    for (int i = 0; i <= m; ++i) net[static_cast<std::size_t>(i) * (m + 1) + j] = b[i];
  }
  return net;
}

std::vector<Rational> exact_restriction(const Polynomial<2>& f, const RationalPoint<2>& o,
                                        const RationalPoint<2>& d) {
  const int n = f.degree();
  // Powers of both coordinates, polynomials in s.
  const auto times = [n](const std::vector<Rational>& a, const Rational& p, const Rational& q) {
    std::vector<Rational> r(static_cast<std::size_t>(n) + 1, Rational(0));
    for (int k = 0; k <= n; ++k) r[k] = p * a[k] + (k > 0 ? Rational(q * a[k - 1]) : Rational(0));
    return r;
  };
  std::vector<std::vector<Rational>> x(1, std::vector<Rational>(n + 1, Rational(0))), sums;
  x[0][0] = 1;
  for (int i = 0; i < n; ++i) x.push_back(times(x.back(), o[0], d[0]));
  std::vector<Rational> total(static_cast<std::size_t>(n) + 1, Rational(0));
  for (int j = n; j >= 0; --j) {
    total = times(total, o[1], d[1]);
    for (const auto& t : f.terms())
      if (t.exponent[1] == j)
        for (int k = 0; k <= n; ++k) total[k] += t.coefficient * x[t.exponent[0]][k];
  }
  return bernstein(total, n);
}

/// The largest error of a coefficient as a part of the radius.
template <int K>
double worst(const Bernstein<K>& net, const std::vector<Rational>& exact, const Rational& scale,
             const std::string& what) {
  EXPECT_EQ(net.b.size(), exact.size());
  if (!std::isfinite(net.radius)) return 0;
  Rational most = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Rational error = abs(Rational(exact[i] * scale - Rational(net.b[i])));
    if (error > most) most = error;
  }
  EXPECT_LE(most, Rational(net.radius)) << what;
  return Rational(most / Rational(net.radius)).get_d();
}

Polynomial<2> random_polynomial(Random& random, int degree, int kind) {
  std::vector<Polynomial<2>::Term> terms;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) {
      Rational c;
      switch (kind) {
        case 0:  // doubles
          c = uniform(random, -1, 1);
          break;
        case 1:  // no doubles
          c = Rational(static_cast<long>(random() % 2000001) - 1000000, 3000017);
          break;
        case 2:  // far apart
          c = Rational(static_cast<long>(random() % 2001) - 1000, 7) *
              power_of_two(static_cast<int>(random() % 1200) - 600);
          break;
        default:  // all of one sign, truncated by conversion
          c = Rational(1 + static_cast<long>(random() % 1000), 3);
      }
      c.canonicalize();
      terms.push_back({{i, j}, c});
    }
  return Polynomial<2>::from_terms(std::move(terms));
}

/// Polynomials whose values cancel: products and powers, expanded.
std::vector<Polynomial<2>> nasty_polynomials() {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto c = [](long p, long q) { return Polynomial<2>::constant(Rational(p, q)); };
  return {(x - c(1, 3)).power(8) + y.power(8), (x - y).power(9),
          (x + y - c(1, 1)).power(6) * (x - c(2, 3)).power(3),
          (x * x + y * y - c(1, 1)).power(4) - c(4, 1) * x.power(2) * y.power(2)};
}

Box<2> random_box(Random& random, int kind) {
  Box<2> box;
  for (int i = 0; i < 2; ++i) {
    switch (kind) {
      case 0:
        box.lo[i] = uniform(random, -1, 1);
        box.hi[i] = box.lo[i] + uniform(random, 0, 1);
        break;
      case 1:  // an ulp or some
        box.lo[i] = uniform(random, 0.3, 0.7);
        box.hi[i] = box.lo[i] + 0x1p-53 * static_cast<double>(1 + random() % 7);
        break;
      case 2:
        box.lo[i] = uniform(random, 100, 1000);
        box.hi[i] = box.lo[i] + uniform(random, 0, 1e-6);
        break;
      case 3:
        box.lo[i] = -(1 - static_cast<double>(random() % 16) * 0x1p-53);
        box.hi[i] = 1 + static_cast<double>(random() % 16) * 0x1p-52;
        break;
      default:
        box.lo[i] = uniform(random, -1, 1) * 0x1p-300;
        box.hi[i] = box.lo[i] + 0x1p-301;
    }
  }
  return box;
}

TEST(ErrorBounds, NetsOnBoxesHoldTheExactCoefficients) {
  Random random(1);
  double most[3] = {};
  for (int round = 0; round < 40; ++round) {
    const int degree = 1 + round % 9;
    const auto nasty = nasty_polynomials();
    const Polynomial<2> p = round % 5 == 4 ? nasty[round / 5 % nasty.size()]
                                           : random_polynomial(random, degree, round % 5);
    const FilteredFunction<2> f(p);
    const Box<2> box = random_box(random, round / 5 % 5);
    const int m = f.degree() + round % 2;
    const std::vector<Rational> exact = exact_net(p, box, m);
    for (int k = 0; k < 3; ++k) {
      Kernel kernel;
      Bernstein<2> net;
      f.expand(box, m, kRungs[k], kernel, &net);
      most[k] = std::max(
          most[k], worst(net, exact, scale_of(f),
                         "round " + std::to_string(round) + ", bits " + std::to_string(kRungs[k])));
    }
  }
  // The bounds are no more than some hundred times too large: a thousandth of them would fail.
  for (int k = 0; k < 3; ++k) EXPECT_GT(most[k], 1e-3) << kRungs[k];
}

TEST(ErrorBounds, RestrictionsToLinesHoldTheExactCoefficients) {
  Random random(2);
  double most[3] = {};
  for (int round = 0; round < 60; ++round) {
    const int degree = 1 + round % 9;
    const auto nasty = nasty_polynomials();
    const Polynomial<2> p = round % 5 == 4 ? nasty[round / 5 % nasty.size()]
                                           : random_polynomial(random, degree, round % 5);
    const FilteredFunction<2> f(p);
    std::array<Rational, 3> c;
    for (auto& x : c)
      x = round % 2 ? Rational(uniform(random, -1, 1))
                    : Rational(static_cast<long>(random() % 2001) - 1000, 1001);
    for (auto& x : c) x.canonicalize();
    // Normals near the ends of what doubles hold.
    if (round % 6 == 5)
      for (auto& x : c) x *= power_of_two(round % 4 == 1 ? -890 : 900);
    if (round % 10 == 7) c[2] = 0;
    if (round % 10 == 9) c[1] = c[0] * power_of_two(-400);
    const Line line = Line::from_rationals(c);
    const Box<2> box = random_box(random, round / 5 % 5);
    const Centered chart = centered(box.lo[0], box.hi[0]);
    const int a = parameter_axis(line), b = 1 - a;
    RationalPoint<2> o, d;
    o[a] = chart.center;
    d[a] = chart.half;
    o[b] = -(c[a] * o[a] + c[2]) / c[b];
    d[b] = -c[a] * d[a] / c[b];
    const std::vector<Rational> exact = exact_restriction(p, o, d);
    for (int k = 0; k < 3; ++k) {
      Kernel kernel;
      Bernstein<1> net;
      f.restrict_to(SegmentChart::of_line(line, box.lo[0], box.hi[0]), kRungs[k], kernel, &net);
      most[k] = std::max(
          most[k], worst(net, exact, scale_of(f),
                         "round " + std::to_string(round) + ", bits " + std::to_string(kRungs[k])));
    }
  }
  for (int k = 0; k < 3; ++k) EXPECT_GT(most[k], 1e-3) << kRungs[k];
}

TEST(ErrorBounds, RestrictionsToSegmentsHoldTheExactCoefficients) {
  Random random(3);
  for (int round = 0; round < 40; ++round) {
    const Polynomial<2> p = random_polynomial(random, 1 + round % 8, round % 4);
    const FilteredFunction<2> f(p);
    const Box<2> box = random_box(random, round / 4 % 5);
    const double lo = uniform(random, -1, 0), hi = uniform(random, 0, 1);
    const Centered chart = centered(lo, hi);
    RationalPoint<2> o, d;
    for (int i = 0; i < 2; ++i) {
      const Rational from = box.lo[i], to = box.hi[i];
      o[i] = (from + to) / 2 + (to - from) / 2 * Rational(chart.center);
      d[i] = (to - from) / 2 * Rational(chart.half);
    }
    const std::vector<Rational> exact = exact_restriction(p, o, d);
    for (const int bits : kRungs) {
      Kernel kernel;
      Bernstein<1> net;
      f.restrict_to(SegmentChart::between(box.lo, box.hi).part(lo, hi), bits, kernel, &net);
      worst(net, exact, scale_of(f), "round " + std::to_string(round));
    }
  }
}

TEST(ErrorBounds, HalvesAndDerivativesHoldTheExactCoefficients) {
  Random random(4);
  double most = 0;
  for (int round = 0; round < 12; ++round) {
    const Polynomial<2> p = random_polynomial(random, 2 + round % 7, round % 4);
    const FilteredFunction<2> f(p);
    Box<2> box{{-1, -0.75}, {1, 0.5}};
    Kernel kernel;
    Bernstein<2> net, lower, upper, derivative, elevated, sum;
    f.expand(box, f.degree(), 106, kernel, &net);
    for (int depth = 0; depth < 6; ++depth) {
      const int axis = depth % 2;
      halve(net, axis, &lower, &upper);
      const bool up = random() % 2;
      net = up ? upper : lower;
      (up ? box.lo : box.hi)[axis] = box.lo[axis] + 0.5 * box.width(axis);
    }
    const Rational scale = scale_of(f);
    most = std::max(most, worst(net, exact_net(p, box, f.degree()), scale, "halves"));
    differentiate(net, 0, &derivative);
    elevate(derivative, 0, &elevated);
    const Polynomial<2> slope = p.derivative(0);
    if (slope.degree() == f.degree() - 1) {
      const Rational half = centered(box.lo[0], box.hi[0]).half;
      worst(elevated, exact_net(slope, box, f.degree()), Rational(scale * half), "derivative");
    }
    combine(0.7, net, -1.3, elevated, &sum);
    std::vector<Rational> exact = exact_net(p, box, f.degree()), d = exact;
    if (slope.degree() == f.degree() - 1) {
      d = exact_net(slope, box, f.degree());
      const Rational half = centered(box.lo[0], box.hi[0]).half;
      for (std::size_t i = 0; i < exact.size(); ++i)
        exact[i] = Rational(0.7) * exact[i] + Rational(-1.3) * half * d[i];
      worst(sum, exact, scale, "sum");
    }
  }
  EXPECT_GT(most, 1e-3);
}

TEST(ErrorBounds, ValuesHoldTheExactValue) {
  Random random(5);
  double most[3] = {};
  for (int round = 0; round < 300; ++round) {
    const auto nasty = nasty_polynomials();
    const Polynomial<2> p = round % 5 == 4 ? nasty[round / 5 % nasty.size()]
                                           : random_polynomial(random, 1 + round % 9, round % 5);
    const FilteredFunction<2> f(p);
    const Box<2> box = random_box(random, round / 5 % 5);
    const Point<2>& at = box.lo;
    const Rational exact = p({Rational(at[0]), Rational(at[1])}) * scale_of(f);
    for (int k = 0; k < 3; ++k) {
      const auto v = f.evaluate(at, kRungs[k]);
      if (!std::isfinite(v.error)) continue;
      const Rational error = abs(Rational(exact - Rational(v.value)));
      EXPECT_LE(error, Rational(v.error)) << "round " << round << ", bits " << kRungs[k];
      most[k] = std::max(most[k], Rational(error / Rational(v.error)).get_d());
    }
  }
  for (int k = 0; k < 3; ++k) EXPECT_GT(most[k], 1e-2) << kRungs[k];
}

TEST(ErrorBounds, SignsAtRationalPointsAreExactOnEveryRung) {
  Random random(6);
  for (int round = 0; round < 60; ++round) {
    // A line through a point: the sign is that of a tiny offset, or zero.
    const Rational x(static_cast<long>(random() % 1000), 997), y(1, 3);
    const Rational offset =
        round % 4 == 0 ? Rational(0) : Rational((round % 4 - 2) * power_of_two(-round * 10));
    const auto f = (Polynomial<2>::variable(0) - Polynomial<2>::constant(x)) +
                   (Polynomial<2>::variable(1) - Polynomial<2>::constant(y)).power(3) +
                   Polynomial<2>::constant(offset);
    Kernel kernel;
    EXPECT_EQ(FilteredFunction<2>(f).sign_at({x, y}, kernel), sign_of(sgn(offset)));
  }
}

// The terms cancel and underflow in doubles, also in the sum of their absolute values.
TEST(ErrorBounds, AreKeptWhereDoublesUnderflow) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const Rational root = power_of_two(-300) / 3;
  const Polynomial<2> p = x.power(3) * (x - Polynomial<2>::constant(root)).power(2) * y.power(20);
  const FilteredFunction<2> f(p);
  for (const double u : {1.0, 1.1, 1.7}) {
    const Point<2> at{root.get_d(), 0x1p30 * u};
    for (const int bits : kRungs) {
      const auto v = f.evaluate(at, bits);
      ASSERT_TRUE(std::isfinite(v.error));
      const Rational error =
          abs(Rational(p({Rational(at[0]), Rational(at[1])}) * scale_of(f) - Rational(v.value)));
      EXPECT_LE(error, Rational(v.error)) << bits;
    }
  }
}

// 2^-bits is no double here.
TEST(ErrorBounds, DoNotVanishAtTheHighestPrecisions) {
  const Polynomial<2> p =
      (Polynomial<2>::variable(0) - Polynomial<2>::constant(Rational(1000, 3))).power(34) *
      Polynomial<2>::variable(1).power(20);
  const FilteredFunction<2> f(p);
  const Point<2> at{1000.0 / 3, 0x1.f8p31};
  const Rational exact = p({Rational(at[0]), Rational(at[1])}) * scale_of(f);
  for (const int bits : {848, 1696, 3392}) {
    const auto v = f.evaluate(at, bits);
    ASSERT_TRUE(std::isfinite(v.error));
    EXPECT_LE(abs(Rational(exact - Rational(v.value))), Rational(v.error)) << bits;
  }
}

// The product of a line's coefficient and the parameter loses most of its bits.
TEST(ErrorBounds, AreKeptWhereALineUnderflows) {
  Line line;
  line.normal = {0x1.6666666666666p-891, 0x1p-890};
  const auto f =
      Polynomial<2>::variable(1) +
      Polynomial<2>::constant(Rational(line.normal[0] * 0x1p890) * Rational(1 + 0x1p-30)) *
          Polynomial<2>::variable(0);
  const FilteredFunction<2> filtered(f);
  for (int k = 1; k < 30; ++k) {
    const double t = 0x1p-175 * (1 + 0.03 * k);
    Kernel kernel;
    EXPECT_EQ(sign_on_line(filtered, line, t, kernel), Sign::Positive);
    EXPECT_TRUE(no_root_on_line(filtered, line, t, 1.01 * t, kernel));
    Bernstein<1> net;
    filtered.restrict_to(SegmentChart::of_line(line, t, 1.01 * t), 53, kernel, &net);
    EXPECT_NE(sign_on_cube(net), Sign::Negative);
  }
}

TEST(ErrorBounds, NothingIsClaimedWhereDoublesOverflow) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const FilteredFunction<2> f(x.power(5) - y.power(5) + x);
  for (const double far : {0x1p180, 0x1p204, 0x1p206, 0x1p500, 0x1p1023})
    for (const int bits : kRungs) {
      Kernel kernel;
      Bernstein<2> net;
      f.expand({{far, far}, {1.5 * far, 1.5 * far}}, 5, bits, kernel, &net);
      for (const double b : net.b) EXPECT_TRUE(std::isfinite(b));
      EXPECT_FALSE(sign_on_cube(net));
      const auto v = f.evaluate({far, far}, bits);
      EXPECT_TRUE(std::isfinite(v.value));
      EXPECT_FALSE(std::isnan(v.error));
    }
}

// Twice the centre is not lo + hi, but adding the rounded differences gives both ends again.
TEST(ErrorBounds, AnInexactCentreIsNotTakenForExact) {
  const double lo = -(1 - 3.5 * 0x1p-52), hi = 1 + 8 * 0x1p-52;
  const double center = lo + 0.5 * (hi - lo), below = center - lo, above = hi - center;
  ASSERT_TRUE(below == above && center - below == lo && center + above == hi);
  ASSERT_NE(Rational(Rational(center) + Rational(above)), Rational(hi));
  const Centered chart = centered(lo, hi);
  EXPECT_FALSE(chart.exact);
  EXPECT_GE(Rational(Rational(chart.center) + Rational(chart.half)), Rational(hi));

  Random random(7);
  int exact = 0;
  for (int round = 0; round < 20000; ++round) {
    const double a = uniform(random, -1, 1) * std::ldexp(1.0, -static_cast<int>(random() % 60));
    double b = uniform(random, -1, 1);
    if (round % 2) b = -a + std::ldexp(static_cast<double>(random() % 9), -53);
    if (!(a < b)) continue;
    const Centered c = centered(a, b);
    const Rational left = Rational(c.center) - Rational(c.half),
                   right = Rational(c.center) + Rational(c.half);
    EXPECT_EQ(c.exact, left == Rational(a) && right == Rational(b));
    EXPECT_LE(left, Rational(a));
    EXPECT_GE(right, Rational(b));
    exact += c.exact;
  }
  EXPECT_GT(exact, 100);
}

TEST(ErrorBounds, IntervalsHoldExactResultsUpToTheEndsOfDoubles) {
  Random random(8);
  for (int round = 0; round < 4000; ++round) {
    const auto number = [&] {
      return uniform(random, -1, 1) * std::ldexp(1.0, static_cast<int>(random() % 2090) - 1070);
    };
    const double a = number(), b = number();
    const Interval sum = Interval(a) + Interval(b), product = Interval(a) * Interval(b);
    const auto holds = [](const Interval& x, const Rational& exact) {
      return !(x.lo > std::numeric_limits<double>::max()) &&
             (!std::isfinite(x.lo) || Rational(x.lo) <= exact) &&
             (!std::isfinite(x.hi) || Rational(x.hi) >= exact) &&
             !(x.hi < std::numeric_limits<double>::lowest());
    };
    EXPECT_TRUE(holds(sum, Rational(a) + Rational(b)));
    EXPECT_TRUE(holds(product, Rational(a) * Rational(b)));
    if (b == 0) continue;
    EXPECT_TRUE(holds(Interval(a) / Interval(b), Rational(a) / Rational(b)));
  }
}

}  // namespace
}  // namespace encase
