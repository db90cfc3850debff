// SPDX-License-Identifier: MIT
#include "common/filtered_polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "common/random_polynomials.hpp"
#include "common/segments.hpp"
#include "common/substitute.hpp"
#include "exact_bernstein.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

const int kAllBits[] = {53, 64, 106, 212};

Rational power_of_two(int exponent) {
  Rational result = 1;
  if (exponent >= 0)
    mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<unsigned>(exponent));
  else
    mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<unsigned>(-exponent));
  return result;
}

template <int D>
std::vector<Polynomial<D>> random_list(int degree, int count, std::uint64_t seed) {
  RandomOptions options;
  options.kind = RandomOptions::Kind::Dense;
  options.degree = degree;
  options.count = count;
  options.seed = seed;
  options.bits = 70;  // no doubles
  return random_polynomials<D>(options);
}

/// f divided by the power of two by which a filtered polynomial scales it.
template <int D>
Polynomial<D> scaled(const FilteredPolynomial<D>& f) {
  Point<D> point;
  RationalPoint<D> exact;
  for (int i = 0; i < D; ++i) exact[i] = point[i] = 3 + i;
  const Rational ratio = f.exact()(exact) / Rational(f.evaluate(point, 53).value);
  const double log = std::log2(ratio.get_d());
  EXPECT_LT(std::fabs(log - std::round(log)), 1e-9);
  return Polynomial<D>::constant(power_of_two(-static_cast<int>(std::round(log)))) * f.exact();
}

/// The number of decisions by (double, MPFR, exact).
using Counts = std::array<std::int64_t, 3>;

struct Decision {
  Sign sign;
  Counts counts;
  bool operator==(const Decision&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Decision& d) {
  return out << static_cast<int>(d.sign) << " by " << d.counts[0] << " " << d.counts[1] << " "
             << d.counts[2];
}

template <int D>
Decision decide(const Polynomial<D>& f, const RationalPoint<D>& point, int start_bits = 53,
                int max_bits = 848) {
  Kernel kernel;
  kernel.start_bits = start_bits;
  kernel.max_bits = max_bits;
  const Sign sign = FilteredPolynomial<D>(f).sign_at(point, kernel);
  EXPECT_EQ(kernel.decisions.undecided, 0);
  return {sign, {kernel.decisions.by_double, kernel.decisions.by_mpfr, kernel.decisions.by_exact}};
}

constexpr Counts kDouble{1, 0, 0}, kMpfr{0, 1, 0}, kExact{0, 0, 1};

Polynomial<2> diagonal() { return polynomial<2>("x - y"); }

/// A point at this vertical distance below the diagonal.
RationalPoint<2> below_diagonal(int exponent) {
  return {Rational(1, 3), Rational(Rational(1, 3) - power_of_two(exponent))};
}

TEST(SignAt, DoublesDecideWhereTheValueIsLarge) {
  const auto circle = polynomial<2>("x^2 + y^2 - 1");
  EXPECT_EQ(decide(circle, {Rational(1, 2), Rational(1, 3)}), (Decision{Sign::Negative, kDouble}));
  EXPECT_EQ(decide(circle, {Rational(4, 5), Rational(2, 3)}), (Decision{Sign::Positive, kDouble}));
  EXPECT_EQ(decide<2>(diagonal(), below_diagonal(-40)), (Decision{Sign::Positive, kDouble}));
  EXPECT_EQ(decide(polynomial<1>("x - 1"), {Rational(2, 3)}), (Decision{Sign::Negative, kDouble}));
  EXPECT_EQ(decide(polynomial<3>("x y z - 1"), {1, 2, Rational(1, 3)}),
            (Decision{Sign::Negative, kDouble}));
}

TEST(SignAt, ExtendedFormatDecidesWhatDoublesCannot) {
  if (!Kernel::kHasExtended) GTEST_SKIP() << "long double is not the 64-bit format here";
  const auto point = below_diagonal(-54);
  EXPECT_EQ(decide<2>(diagonal(), point), (Decision{Sign::Positive, kDouble}));
  EXPECT_EQ(decide<2>(diagonal(), point, 53, 64), (Decision{Sign::Positive, kDouble}));
  // With doubles alone only exact arithmetic is left.
  EXPECT_EQ(decide<2>(diagonal(), point, 53, 53), (Decision{Sign::Positive, kExact}));
}

TEST(SignAt, EveryPrecisionDecidesWhatTheOneBeforeCannot) {
  for (const int bits : {106, 212, 424, 848}) {
    const auto point = below_diagonal(-(3 * bits) / 4);
    EXPECT_EQ(decide<2>(diagonal(), point), (Decision{Sign::Positive, kMpfr})) << bits;
    EXPECT_EQ(decide<2>(diagonal(), point, 53, bits), (Decision{Sign::Positive, kMpfr})) << bits;
    EXPECT_EQ(decide<2>(diagonal(), point, 53, bits / 2), (Decision{Sign::Positive, kExact}))
        << bits;
  }
}

TEST(SignAt, ExactArithmeticDecidesBeyondTheCap) {
  EXPECT_EQ(decide<2>(diagonal(), below_diagonal(-900)), (Decision{Sign::Positive, kExact}));
}

TEST(SignAt, ExactArithmeticAloneProvesZero) {
  const auto circle = polynomial<2>("x^2 + y^2 - 1");
  EXPECT_EQ(decide(circle, {Rational(3, 5), Rational(4, 5)}), (Decision{Sign::Zero, kExact}));
  // Also where every operation on doubles is exact.
  EXPECT_EQ(decide(circle, {1, 0}), (Decision{Sign::Zero, kExact}));
  EXPECT_EQ(decide(polynomial<2>("x"), {0, 5}), (Decision{Sign::Zero, kExact}));
  EXPECT_EQ(decide(polynomial<1>("x^2 - 4"), {-2}), (Decision{Sign::Zero, kExact}));
  EXPECT_EQ(decide(polynomial<3>("x^2 + y^2 + z^2 - 1"),
                   {Rational(2, 7), Rational(3, 7), Rational(6, 7)}),
            (Decision{Sign::Zero, kExact}));
  EXPECT_EQ(decide(Polynomial<2>(), {1, 1}), (Decision{Sign::Zero, kExact}));
}

TEST(SignAt, StartBitsForceMpfr) {
  const auto circle = polynomial<2>("x^2 + y^2 - 1");
  EXPECT_EQ(decide(circle, {Rational(1, 2), Rational(1, 3)}, 106),
            (Decision{Sign::Negative, kMpfr}));
  EXPECT_EQ(decide(circle, {Rational(3, 5), Rational(4, 5)}, 106), (Decision{Sign::Zero, kExact}));
}

TEST(SignAt, CoefficientsBeyondTheRangeOfDoublesAreDecided) {
  EXPECT_EQ(decide(polynomial<2>("1e400 x + y"), {Rational(-1, 3), 1}).sign, Sign::Negative);
  EXPECT_EQ(decide(polynomial<2>("1e-400 x + 1e-401 y"), {-1, 1}).sign, Sign::Negative);
  // Below what doubles tell from zero: MPFR as long as its result is a double, then exact.
  EXPECT_EQ(decide(polynomial<2>("x + 1e-310"), {0, 7}), (Decision{Sign::Positive, kMpfr}));
  EXPECT_EQ(decide(polynomial<2>("x - 1e-400"), {0, 7}), (Decision{Sign::Negative, kExact}));
  EXPECT_EQ(decide(polynomial<2>("x^9 - y"), {Rational("1/" + std::string(90, '7')), 0}).sign,
            Sign::Positive);
  EXPECT_EQ(decide(polynomial<2>("x - y^2"), {Rational("-1" + std::string(400, '0')), 1}).sign,
            Sign::Negative);
}

template <int D>
void expect_exact_signs_near(const Polynomial<D>& f, std::uint64_t seed) {
  // Points of a grid, and points near zeros of f at ever smaller distances.
  std::mt19937_64 generator(seed);
  const FilteredPolynomial<D> filtered(f);
  Kernel kernel;
  for (int round = 0; round < 40; ++round) {
    RationalPoint<D> a, b;
    for (int i = 0; i < D; ++i) {
      a[i] = Rational(static_cast<int>(generator() % 2001) - 1000, 700);
      b[i] = Rational(static_cast<int>(generator() % 2001) - 1000, 700);
      a[i].canonicalize();
      b[i].canonicalize();
    }
    const int at_a = sgn(f(a));
    for (int step = 0; step < 70; ++step) {
      RationalPoint<D> middle;
      for (int i = 0; i < D; ++i) middle[i] = (a[i] + b[i]) / 2;
      const int exact = sgn(f(middle));
      ASSERT_EQ(filtered.sign_at(middle, kernel), sign_of(exact));
      (exact == at_a ? a : b) = middle;
    }
  }
  EXPECT_GT(kernel.decisions.by_double, 100);
  EXPECT_GT(kernel.decisions.by_mpfr, 10);
  EXPECT_EQ(kernel.decisions.undecided, 0);
}

TEST(SignAt, AgreesWithExactArithmeticNearZeros) {
  expect_exact_signs_near(random_list<1>(9, 1, 1)[0], 1);
  expect_exact_signs_near(random_list<2>(5, 1, 2)[0], 2);
  expect_exact_signs_near(random_list<3>(3, 1, 3)[0], 3);
}

TEST(SignAt, QueriesRunInParallel) {
  const FilteredPolynomial<2> f(random_list<2>(8, 1, 4)[0]);
  const RationalPoint<2> point{Rational(1, 3), Rational(-2, 7)};
  std::vector<Sign> signs(16, Sign::Zero);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int k = 0; k < 4; ++k) {
        Kernel kernel;
        kernel.start_bits = 106 << k;
        signs[static_cast<std::size_t>(4 * t + k)] = f.sign_at(point, kernel);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const Sign sign : signs) EXPECT_EQ(sign, sign_of(sgn(f.exact()(point))));
}

template <int D>
void expect_proved_values(int degree, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  for (const auto& exact : random_list<D>(degree, 3, seed)) {
    const FilteredPolynomial<D> f(exact);
    const Polynomial<D> g = scaled(f);
    for (int round = 0; round < 10; ++round) {
      Point<D> point, magnitude;
      RationalPoint<D> rational;
      for (int i = 0; i < D; ++i) {
        rational[i] = point[i] = 2 * symmetric_random(generator);
        magnitude[i] = std::fabs(point[i]);
      }
      const Rational value = g(rational);
      double last_error = HUGE_VAL;
      for (const int bits : kAllBits) {
        if (bits == 64 && !Kernel::kHasExtended) continue;
        const auto v = f.evaluate(point, bits);
        EXPECT_LE(abs(Rational(Rational(v.value) - value)), Rational(v.error));
        EXPECT_LE(v.error, last_error);
        last_error = v.error;
      }
      EXPECT_LT(f.evaluate(point, 53).error, 1e-12 * f.absolute(magnitude));
      EXPECT_NEAR(f.approximate(point), value.get_d(), 1e-12 * f.absolute(magnitude));
      const Point<D> gradient = f.gradient(point);
      Rational sum = 0;
      for (const auto& term : g.terms()) {
        Rational product = abs(term.coefficient);
        for (int i = 0; i < D; ++i)
          for (int k = 0; k < term.exponent[i]; ++k) product *= abs(rational[i]);
        sum += product;
      }
      EXPECT_GE(Rational(f.absolute(magnitude)), sum);
      EXPECT_LE(f.absolute(magnitude), 1.0001 * sum.get_d());
      for (int i = 0; i < D; ++i)
        EXPECT_NEAR(gradient[i], g.derivative(i)(rational).get_d(), 1e-9 * f.absolute(magnitude));
    }
  }
}

TEST(Evaluate, ValuesAreWithinTheirErrors) {
  expect_proved_values<1>(8, 5);
  expect_proved_values<2>(6, 6);
  expect_proved_values<3>(4, 7);
}

/// The polynomial on a box, the corners of which go to those of the cube.
template <int D>
Polynomial<D> on_box(const Polynomial<D>& f, const Box<D>& box) {
  RationalPoint<D> offset, scale;
  for (int i = 0; i < D; ++i) {
    offset[i] = (Rational(box.lo[i]) + Rational(box.hi[i])) / 2;
    scale[i] = (Rational(box.hi[i]) - Rational(box.lo[i])) / 2;
  }
  return exact_bernstein::compose<D>(f, offset, scale);
}

template <int D>
void expect_proved_expansions(int degree, std::uint64_t seed) {
  Box<D> wide, small;
  for (int i = 0; i < D; ++i) {
    wide.lo[i] = -1 - 0.25 * i;
    wide.hi[i] = 2 + 0.5 * i;
    small.lo[i] = 0.375 - 0.125 * i;
    small.hi[i] = small.lo[i] + std::ldexp(1, -20 - i);
  }
  for (const auto& exact : random_list<D>(degree, 2, seed)) {
    const FilteredPolynomial<D> f(exact);
    const Polynomial<D> g = scaled(f);
    for (const Box<D>& box : {wide, small}) {
      const Polynomial<D> local = on_box<D>(g, box);
      double first_radius = 0;
      for (const int bits : kAllBits)
        for (const int net_degree : {f.degree(), f.degree() + 2}) {
          if (bits == 64 && !Kernel::kHasExtended) continue;
          Kernel kernel;
          Bernstein<D> net;
          f.expand(box, net_degree, bits, kernel, &net);
          std::array<int, D> degrees;
          degrees.fill(net_degree);
          EXPECT_EQ(net.degree, degrees);
          EXPECT_TRUE(exact_bernstein::encloses<D>(net, local)) << bits << " bits";
          EXPECT_EQ(kernel.expansions, 1);
          EXPECT_EQ(kernel.mpfr_expansions, Kernel::is_mpfr(bits));
          if (bits == 53) first_radius = std::max(first_radius, net.radius);
          EXPECT_LE(net.radius, first_radius);
          EXPECT_LT(net.radius, 1e-11 * std::pow(6.0, degree));
        }
    }
  }
}

TEST(Expand, CoefficientsAreWithinTheRadius) {
  expect_proved_expansions<1>(7, 8);
  expect_proved_expansions<2>(4, 9);
  expect_proved_expansions<3>(2, 10);
}

TEST(Expand, PrecisionShrinksTheRadiusOfASmallBox) {
  // (x - y)^2 near the diagonal: the value is 2^-60, hidden by rounding in doubles.
  const FilteredPolynomial<2> f(polynomial<2>("(x - y)^2"));
  const Box<2> box{{0.75, 0.75 + 0x1p-30}, {0.75 + 0x1p-40, 0.75 + 0x1p-30 + 0x1p-40}};
  Kernel kernel;
  Bernstein<2> net;
  f.expand(box, 2, 53, kernel, &net);
  EXPECT_EQ(sign_on_cube(net), std::nullopt);
  EXPECT_TRUE(drowned(net));
  f.expand(box, 2, 106, kernel, &net);
  EXPECT_EQ(sign_on_cube(net), Sign::Positive);
}

TEST(Expand, BoxesWithoutADoubleCentreAreCovered) {
  // The middle of [1, 1 + 3 ulp] is not a double.
  const double e = 0x1p-52;
  const Box<2> box{{1, 1}, {1 + 3 * e, 1 + e}};
  const FilteredPolynomial<2> f(polynomial<2>("1000 x - 1000 - y/1000 + 1/1000"));
  const Polynomial<2> g = scaled(f);
  Kernel kernel;
  for (const int bits : {106, 212}) {
    Bernstein<2> net;
    f.expand(box, 1, bits, kernel, &net);
    Rational lo = net.b[0], hi = net.b[0];
    for (const double b : net.b) {
      if (Rational(b) < lo) lo = b;
      if (Rational(b) > hi) hi = b;
    }
    lo -= net.radius;
    hi += net.radius;
    for (const double x : {box.lo[0], box.hi[0]})
      for (const double y : {box.lo[1], box.hi[1]}) {
        const Rational value = g({Rational(x), Rational(y)});
        EXPECT_LE(lo, value);
        EXPECT_GE(hi, value);
      }
  }
}

TEST(Expand, HugeBoxesClaimNothing) {
  const FilteredPolynomial<2> f(polynomial<2>("x^40 + y^40 + 1"));
  Kernel kernel;
  Bernstein<2> net;
  f.expand({{-1e300, -1e300}, {1e300, 1e300}}, 40, 53, kernel, &net);
  EXPECT_EQ(sign_on_cube(net), std::nullopt);
}

/// The polynomial on the segment origin + direction s.
Polynomial<1> on_segment(const Polynomial<2>& f, const RationalPoint<2>& origin,
                         const RationalPoint<2>& direction) {
  std::array<Polynomial<1>, 2> at;
  for (int i = 0; i < 2; ++i)
    at[i] = Polynomial<1>::constant(origin[i]) +
            Polynomial<1>::constant(direction[i]) * Polynomial<1>::variable(0);
  return substitute<1, 2>(f, at);
}

TEST(RestrictTo, LinesCoefficientsAreWithinTheRadius) {
  const Line lines[] = {Line::from_rationals({1, 0, -1}),
                        Line::from_rationals({Rational(1, 3), Rational(1, 7), Rational(-1, 10)}),
                        Line::from_rationals({Rational(1, 7), Rational(-1, 3), Rational(1, 10)}),
                        Line::from_rationals({0.1, -0.7, 0.3}),
                        Line::from_rationals({0.7, 0.1, 1e-3})};
  for (const auto& exact : random_list<2>(6, 2, 11)) {
    const FilteredPolynomial<2> f(exact);
    const Polynomial<2> g = scaled(f);
    for (const Line& line : lines)
      for (const auto& [lo, hi] : {std::pair{-1.0, 1.0}, {0.25, 0.25 + 0x1p-20}, {-3.0, 0.5}}) {
        const Rational middle = (Rational(lo) + Rational(hi)) / 2;
        const RationalPoint<2> from = point_on_line(line, Rational(lo)),
                               origin = point_on_line(line, middle);
        const RationalPoint<2> direction{Rational(origin[0] - from[0]),
                                         Rational(origin[1] - from[1])};
        const Polynomial<1> local = on_segment(g, origin, direction);
        for (const int bits : kAllBits) {
          if (bits == 64 && !Kernel::kHasExtended) continue;
          Kernel kernel;
          Bernstein<1> net;
          f.restrict_to(SegmentChart::of_line(line, lo, hi), bits, kernel, &net);
          EXPECT_TRUE(exact_bernstein::encloses<1>(net, local)) << bits << " bits";
          EXPECT_LT(net.radius, bits == 53 ? 1e-8 : 1e-9);
          EXPECT_EQ(kernel.restrictions, 1);
          EXPECT_EQ(kernel.mpfr_expansions, Kernel::is_mpfr(bits));
        }
      }
  }
}

TEST(RestrictTo, SegmentsAndTheirPartsAreEnclosed) {
  const Point<2> from{0.1, -0.7}, to{0.9, 1.3};
  for (const auto& exact : random_list<2>(5, 2, 12)) {
    const FilteredPolynomial<2> f(exact);
    const Polynomial<2> g = scaled(f);
    for (const auto& [lo, hi] : {std::pair{-1.0, 1.0}, {0.25, 0.5}, {-1.0, -1 + 0x1p-20}}) {
      RationalPoint<2> origin, direction;
      const Rational m = (Rational(lo) + Rational(hi)) / 2, h = (Rational(hi) - Rational(lo)) / 2;
      for (int i = 0; i < 2; ++i) {
        const Rational half = (Rational(to[i]) - Rational(from[i])) / 2;
        origin[i] = (Rational(to[i]) + Rational(from[i])) / 2 + half * m;
        direction[i] = half * h;
      }
      const Polynomial<1> local = on_segment(g, origin, direction);
      for (const int bits : kAllBits) {
        if (bits == 64 && !Kernel::kHasExtended) continue;
        Kernel kernel;
        Bernstein<1> net;
        f.restrict_to(SegmentChart::between(from, to).part(lo, hi), bits, kernel, &net);
        EXPECT_TRUE(exact_bernstein::encloses<1>(net, local)) << bits << " bits";
      }
    }
  }
}

TEST(Coefficients, AreExactWhereTheyAreDoubles) {
  const auto f = polynomial<2>("1 + 3*x - 7/1024*y^2 + 9007199254740991*x*y + 1/2^60*x^2");
  const FilteredPolynomial<2> g(f);
  EXPECT_TRUE(g.exact_coefficients());
  for (const auto& term : f.terms())
    EXPECT_EQ(Rational(Rational(g.scale()) *
                       Rational(g.coefficients()[term.exponent[0] * 3 + term.exponent[1]])),
              term.coefficient);
  for (const double low : g.low_coefficients()) EXPECT_EQ(low, 0.0);
}

TEST(Coefficients, AreNotExactWhereOneIsNoDouble) {
  for (const char* text : {"x + 1/3*y", "x + 9007199254740993*y", "2^70*x + (2^70 + 1)*y",
                           "x + 18446744073709551615*y"})
    EXPECT_FALSE(FilteredPolynomial<2>(polynomial<2>(text)).exact_coefficients()) << text;
}

TEST(Coefficients, AreExactAtTheEndsOfTheRange) {
  Rational tiny(5), large(5);
  mpq_div_2exp(tiny.get_mpq_t(), tiny.get_mpq_t(), 1000);
  mpq_mul_2exp(large.get_mpq_t(), large.get_mpq_t(), 3000);
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const FilteredPolynomial<2> f(x + Polynomial<2>::constant(tiny) * y);
  EXPECT_TRUE(f.exact_coefficients());
  EXPECT_EQ(f.coefficients()[1], std::ldexp(5.0, -1000) / f.scale());
  EXPECT_TRUE(FilteredPolynomial<2>(Polynomial<2>::constant(large) * x).exact_coefficients());
  // Far below what a double holds beside the other coefficient.
  EXPECT_FALSE(FilteredPolynomial<2>(Polynomial<2>::constant(large) * x + y).exact_coefficients());
}

TEST(Coefficients, PairsOfDoublesHoldRationals) {
  for (const auto& exact : random_list<2>(7, 3, 11)) {
    const auto f = Polynomial<2>::constant(Rational(1, 3)) * exact;
    const FilteredPolynomial<2> g(f);
    EXPECT_FALSE(g.exact_coefficients());
    const auto reference = scaled(g);
    for (const auto& term : reference.terms()) {
      const std::size_t k = static_cast<std::size_t>(term.exponent[0] * 8 + term.exponent[1]);
      const Rational high(g.coefficients()[k]), low(g.low_coefficients()[k]);
      EXPECT_LE(abs(Rational(high - term.coefficient)), Rational(0x1p-52) * abs(term.coefficient));
      EXPECT_LE(abs(Rational(high + low - term.coefficient)),
                Rational(0x1p-104) * abs(term.coefficient));
    }
  }
}

TEST(Coefficients, CanBeAskedForInParallel) {
  const FilteredPolynomial<2> f(Polynomial<2>::constant(Rational(1, 3)) *
                                random_list<2>(9, 1, 12).front());
  std::vector<std::thread> threads;
  std::vector<const std::vector<double>*> lows(4);
  for (auto& low : lows)
    threads.emplace_back([&f, &low] {
      low = &f.low_coefficients();
      f.evaluate({0.5, 0.25}, Kernel::kExtendedBits);
    });
  for (auto& thread : threads) thread.join();
  for (const auto* low : lows) EXPECT_EQ(low, lows[0]);
}

}  // namespace
}  // namespace encase
