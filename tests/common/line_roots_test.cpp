// SPDX-License-Identifier: MIT
#include "common/line_roots.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <optional>
#include <random>

#include "common/components.hpp"
#include "common/line_net.hpp"
#include "common/random_polynomials.hpp"
#include "common/segments.hpp"
#include "common/substitute.hpp"
#include "counted_allocations.hpp"
#include "exact_bernstein.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

constexpr int kMaxNodes = 400;
const Box<2> kSquare{{-1, -1}, {1, 1}};

Line line(const Rational& a, const Rational& b, const Rational& c) {
  return Line::from_rationals({a, b, c});
}

const Line kXAxis = line(0, 1, 0);

/// The line through two points, rounded to doubles, with its parameters there.
struct Chord {
  Line line;
  double lo, hi;
};

Chord chord(const Point<2>& from, const Point<2>& to) {
  Chord result;
  result.line.normal = {from[1] - to[1], to[0] - from[0]};
  result.line.offset = -(result.line.normal[0] * from[0] + result.line.normal[1] * from[1]);
  const int axis = parameter_axis(result.line);
  result.lo = std::min(from[axis], to[axis]);
  result.hi = std::max(from[axis], to[axis]);
  return result;
}

/// A polynomial, its tiles and a kernel.
struct Curve {
  explicit Curve(Polynomial<2> exact, const Box<2>& box = kSquare, int start_bits = 53)
      : filtered(std::move(exact)), tiled(filtered, box, prepared(start_bits)) {}
  explicit Curve(const std::string& text, const Box<2>& box = kSquare, int start_bits = 53)
      : Curve(polynomial<2>(text), box, start_bits) {}

  std::optional<std::vector<LineRoot>> isolate(const Line& on, double lo, double hi) {
    std::vector<LineRoot> roots;
    if (!isolate_on_line(tiled, on, lo, hi, kMaxNodes, kernel, &roots)) return std::nullopt;
    return roots;
  }
  int exact_count(const Line& on, double lo, double hi) const {
    return count_real_roots(restrict_exactly(filtered.polynomial().exact(), on), Rational(lo),
                            Rational(hi));
  }

  Kernel& prepared(int start_bits) {
    kernel.start_bits = start_bits;
    return kernel;
  }

  Kernel kernel;
  FilteredFunction<2> filtered;
  TiledFunction tiled;
};

/// The intervals are in order, disjoint, within [lo, hi], and each has one root, none at its ends.
void expect_isolated(const std::vector<LineRoot>& roots, const Curve& f, const Line& on, double lo,
                     double hi) {
  const Polynomial<1> exact = restrict_exactly(f.filtered.polynomial().exact(), on);
  double last = lo;
  for (const LineRoot& root : roots) {
    EXPECT_LE(last, root.lo);
    EXPECT_LT(root.lo, root.hi);
    EXPECT_LE(root.lo, root.at);
    EXPECT_LE(root.at, root.hi);
    last = root.hi;
    EXPECT_EQ(count_real_roots(exact, Rational(root.lo), Rational(root.hi)), 1);
    EXPECT_NE(exact({Rational(root.lo)}), 0);
    EXPECT_NE(exact({Rational(root.hi)}), 0);
  }
  EXPECT_LE(last, hi);
}

void expect_all_roots(Curve& f, const Line& on, double lo, double hi) {
  const auto roots = f.isolate(on, lo, hi);
  ASSERT_TRUE(roots.has_value()) << "degree " << f.filtered.degree() << " from " << lo << " to "
                                 << hi;
  EXPECT_EQ(static_cast<int>(roots->size()), f.exact_count(on, lo, hi));
  expect_isolated(*roots, f, on, lo, hi);
}

std::vector<Polynomial<2>> random_curves_of(int degree, int count) {
  RandomOptions options;
  options.degree = degree;
  options.count = count;
  options.seed = static_cast<unsigned>(100 + degree);
  return random_polynomials<2>(options);
}

Chord random_chord(std::mt19937_64& generator, double length) {
  const Point<2> from{symmetric_random(generator), symmetric_random(generator)};
  Point<2> to;
  for (int i = 0; i < 2; ++i)
    to[i] = std::clamp(from[i] + length * symmetric_random(generator), -1.0, 1.0);
  return chord(from, to);
}

TEST(LineRoots, AreAsManyAsExactArithmeticFinds) {
  std::mt19937_64 generator(1);
  for (const int degree : {1, 2, 3, 4, 5, 7, 8, 9, 12, 15, 16, 17, 20, 30}) {
    for (const Polynomial<2>& exact : random_curves_of(degree, 2)) {
      Curve f(exact);
      for (const double length : {2.0, 0.5, 0.05, 1e-4, 1e-9})
        for (int i = 0; i < (degree > 20 ? 2 : 5); ++i) {
          const Chord c = random_chord(generator, length);
          if (c.lo < c.hi) expect_all_roots(f, c.line, c.lo, c.hi);
        }
      // Along and across the borders of tiles, through their corners, beside the box's corners.
      expect_all_roots(f, line(1, 0, 0), -1, 1);
      expect_all_roots(f, line(1, 0, Rational(-1, 2)), -1, 1);
      expect_all_roots(f, line(0, 1, 0x1p-40), -1, 1);
      expect_all_roots(f, line(1, 1, 0), -1, 1);
      expect_all_roots(f, line(1, -1, Rational(1, 3)), -0.9, 0.6);
      expect_all_roots(f, line(Rational(5, 3), Rational(1, 7), Rational(-1, 10)), -0.9, 0.9);
      expect_all_roots(f, line(1, 1, -1.999999), 0.999999, 1);
    }
  }
}

TEST(LineRoots, BeyondTheBoxAreFound) {
  for (const int degree : {3, 6, 16})
    for (const Polynomial<2>& exact : random_curves_of(degree, 1)) {
      Curve f(exact);
      expect_all_roots(f, line(0.3, -0.7, 0.11), -1.5, 3);
      expect_all_roots(f, kXAxis, 0.1, 7.3);
    }
}

TEST(LineRoots, AreNarrowAndTellAboutWhereTheRootIs) {
  std::mt19937_64 generator(2);
  for (const int degree : {2, 6, 12, 20})
    for (const Polynomial<2>& exact : random_curves_of(degree, 2)) {
      Curve f(exact);
      for (int i = 0; i < 10; ++i) {
        const Chord c = random_chord(generator, 1);
        const auto roots = f.isolate(c.line, c.lo, c.hi);
        ASSERT_TRUE(roots.has_value());
        for (LineRoot root : *roots) {
          EXPECT_LE(root.hi - root.lo, 0.0625 * (c.hi - c.lo));
          const double guess = root.at;
          while (root.hi - root.lo > 1e-10 * (c.hi - c.lo))
            ASSERT_TRUE(refine_on_line(f.tiled, c.line, &root, f.kernel));
          EXPECT_NEAR(guess, root.lo, 1e-4 * (c.hi - c.lo));
        }
      }
    }
}

TEST(LineRoots, CloseOnesAreTold) {
  for (const std::string gap : {"1e-4", "1e-6", "1e-8", "1e-10", "1e-12"}) {
    for (const std::string& text :
         {"(y - x^2 + 1/4) - " + gap + "^2/3", "(x - 1/3)^2 + y - " + gap + "^2"}) {
      Curve f(text);
      expect_all_roots(f, kXAxis, -1, 1);
      expect_all_roots(f, line(Rational(1, 1000000), 1, 0), -1, 1);
    }
  }
}

TEST(LineRoots, LinesThatNearlyTouchMeetTheCurveTwiceOrNot) {
  for (const double gap : {1e-4, 1e-8, 1e-12, 1e-14}) {
    Curve f("x^2 + y^2 - 1/2 - x^3 y/100");
    // The curve's lowest and highest x where its slope vanishes: from the exact discriminant's
    // side.
    for (const double sign : {-1.0, 1.0}) {
      const Line on = line(0.6, 0.8, -std::sqrt(0.5) + sign * gap);
      const auto roots = f.isolate(on, -1, 1);
      ASSERT_TRUE(roots.has_value()) << gap;
      EXPECT_EQ(static_cast<int>(roots->size()), f.exact_count(on, -1, 1));
    }
  }
  Curve circle("x^2 + y^2 - 1/4");
  for (const double gap : {1e-4, 1e-8, 1e-12, 0x1p-50}) {
    EXPECT_EQ(circle.isolate(line(0, 1, -0.5 + gap), -1, 1).value().size(), 2u) << gap;
    EXPECT_EQ(circle.isolate(line(0, 1, -0.5 - gap), -1, 1).value().size(), 0u) << gap;
  }
}

TEST(LineRoots, OnBordersOfTilesAndCutsAreFound) {
  Curve f("(x + 1/2) x (x - 1/2) (x - 3/4) + y");
  expect_all_roots(f, kXAxis, -1, 1);
  Curve high("(x + 1/2) x (x - 1/2) (x - 3/4) (x^16 + 1) (1 + y^20) + y");
  expect_all_roots(high, kXAxis, -1, 1);
  expect_all_roots(high, kXAxis, -0.6, 0.6);
}

TEST(LineRoots, MultipleOnesAreNotSettled) {
  EXPECT_FALSE(Curve("y - x^2").isolate(kXAxis, -1, 1));
  EXPECT_FALSE(Curve("y - (x - 1/3)^2").isolate(kXAxis, -1, 1));
  EXPECT_FALSE(Curve("y - (x - 1/3)^3").isolate(kXAxis, -1, 1));
  EXPECT_FALSE(Curve("x^2 + y^2 - 1").isolate(line(1, 0, -1), -1, 1));
  EXPECT_FALSE(Curve("(x^2 + y^2 - 1) (x^18 + 2)").isolate(line(1, 0, -1), -1, 1));
  // Away from the multiple root there is nothing to object to.
  const auto roots = Curve("y - (x - 1/3)^2 (x - 3/4)").isolate(kXAxis, 0.5, 1);
  ASSERT_TRUE(roots.has_value());
  EXPECT_EQ(roots->size(), 1u);
}

TEST(LineRoots, AtAnEndAreNotSettled) {
  Curve f("x^2 - y - 1");
  EXPECT_FALSE(f.isolate(kXAxis, -1, 0.5));
  EXPECT_FALSE(f.isolate(kXAxis, 0, 1));
  const auto inside = f.isolate(kXAxis, 0, std::nextafter(1, 2));
  ASSERT_TRUE(inside.has_value());
  EXPECT_EQ(inside->size(), 1u);
  const auto outside = f.isolate(kXAxis, 0, std::nextafter(1, 0));
  ASSERT_TRUE(outside.has_value());
  EXPECT_TRUE(outside->empty());
}

TEST(LineRoots, CurveThatContainsTheLineIsNotSettled) {
  EXPECT_FALSE(Curve("y (x^2 + y - 1/2)").isolate(kXAxis, -1, 1));
  EXPECT_FALSE(Curve("(x/3 + y/7 - 1/10) x")
                   .isolate(line(Rational(1, 3), Rational(1, 7), Rational(-1, 10)), -1, 1));
}

TEST(LineRoots, FailureAppendsNothing) {
  Curve f("(y - x^2) (x - 3/4)");
  std::vector<LineRoot> roots(1);
  EXPECT_FALSE(isolate_on_line(f.tiled, kXAxis, -0.5, 1, kMaxNodes, f.kernel, &roots));
  EXPECT_EQ(roots.size(), 1u);
  EXPECT_TRUE(isolate_on_line(f.tiled, kXAxis, 0.5, 1, kMaxNodes, f.kernel, &roots));
  EXPECT_EQ(roots.size(), 2u);
  for (const auto& [lo, hi] : {std::pair{1.0, -1.0}, {1.0, 1.0}, {-HUGE_VAL, 1.0}, {NAN, 1.0}})
    EXPECT_FALSE(isolate_on_line(f.tiled, kXAxis, lo, hi, kMaxNodes, f.kernel, &roots));
  EXPECT_EQ(roots.size(), 2u);
}

TEST(LineRoots, NodesAreLimited) {
  Curve f("(x + 3/4) (x + 1/3) x (x - 1/5) (x - 4/5) + y");
  std::vector<LineRoot> roots;
  EXPECT_TRUE(isolate_on_line(f.tiled, kXAxis, -1, 1, 400, f.kernel, &roots));
  EXPECT_FALSE(isolate_on_line(f.tiled, kXAxis, -1, 1, 3, f.kernel, &roots));
}

TEST(LineRoots, AreTheSameFromMorePrecision) {
  std::mt19937_64 generator(3);
  for (const int degree : {2, 6, 16})
    for (const Polynomial<2>& exact : random_curves_of(degree, 1)) {
      Curve quick(exact), precise(exact, kSquare, 128);
      for (int i = 0; i < 5; ++i) {
        const Chord c = random_chord(generator, 1.5);
        const auto a = quick.isolate(c.line, c.lo, c.hi), b = precise.isolate(c.line, c.lo, c.hi);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->size(), b->size());
        expect_isolated(*b, precise, c.line, c.lo, c.hi);
      }
      EXPECT_EQ(precise.kernel.decisions.by_double, 0);
      EXPECT_GT(precise.kernel.decisions.by_mpfr, 0);
      EXPECT_GT(precise.kernel.mpfr_expansions, 0);
      EXPECT_EQ(quick.kernel.decisions.by_mpfr, 0);
    }
}

TEST(LineRoots, AreTheSameForEveryInstructionSet) {
  const auto answers = [] {
    std::vector<double> all;
    std::mt19937_64 generator(4);
    for (const int degree : {3, 7, 8, 14, 20})
      for (const Polynomial<2>& exact : random_curves_of(degree, 2)) {
        Curve f(exact);
        for (int i = 0; i < 10; ++i) {
          const Chord c = random_chord(generator, 2);
          const std::vector<LineRoot> roots = f.isolate(c.line, c.lo, c.hi).value();
          for (const LineRoot& root : roots) all.insert(all.end(), {root.lo, root.hi, root.at});
        }
      }
    return all;
  };
  const std::vector<double> expected = answers();
  EXPECT_GT(expected.size(), 500u);
  const std::int64_t supported = hwy::SupportedTargets();
  for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_EQ(answers(), expected) << hwy::TargetName(rest & -rest);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(LineRoots, NothingIsAllocatedForThem) {
  std::mt19937_64 generator(5);
  for (const int degree : {4, 10, 20}) {
    Curve f(random_curves_of(degree, 1).front());
    std::vector<Chord> chords;
    for (int i = 0; i < 20; ++i) chords.push_back(random_chord(generator, 1));
    std::vector<LineRoot> roots;
    roots.reserve(1000);
    const auto run = [&] {
      for (const Chord& c : chords) {
        const std::size_t first = roots.size();
        ASSERT_TRUE(isolate_on_line(f.tiled, c.line, c.lo, c.hi, kMaxNodes, f.kernel, &roots));
        for (std::size_t i = first; i < roots.size(); ++i)
          ASSERT_TRUE(refine_on_line(f.tiled, c.line, &roots[i], f.kernel));
      }
    };
    run();  // makes the tiles
    roots.clear();
    const long before = counted_allocations();
    run();
    EXPECT_EQ(counted_allocations() - before, 0) << degree;
  }
}

/// The exact Bernstein coefficients of a tile's polynomial on a segment in the tile.
std::vector<Rational> exact_net(const Tile& tile, const Point<2>& origin,
                                const Point<2>& direction) {
  std::vector<Polynomial<2>::Term> terms;
  for (int i = 0; i <= tile.degree; ++i)
    for (int j = 0; i + j <= tile.degree; ++j)
      if (tile.a[i][j] != 0) terms.push_back({{i, j}, Rational(tile.a[i][j])});
  std::array<Polynomial<1>, 2> at;
  for (int i = 0; i < 2; ++i)
    at[i] = Polynomial<1>::constant(Rational(origin[i])) +
            Polynomial<1>::constant(Rational(direction[i])) * Polynomial<1>::variable(0);
  return exact_bernstein::coefficients<1>(
      substitute<1, 2>(Polynomial<2>::from_terms(std::move(terms)), at), {tile.degree});
}

Rational largest_error(const LineNet& net, const std::vector<Rational>& exact) {
  Rational largest = 0;
  for (std::size_t j = 0; j < exact.size(); ++j)
    largest = std::max<Rational>(largest, abs(Rational(Rational(net.b[j]) - exact[j])));
  return largest;
}

TEST(LineNet, ErrorsAreWithinTheirBounds) {
  std::mt19937_64 generator(6);
  const double u = 0x1p-53;
  for (const int degree : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 15}) {
    Curve f(random_curves_of(degree, 1).front());
    const BernsteinTables& tables = bernstein_tables(degree);
    for (int i = 0; i < 3; ++i) {
      Tile tile;
      const double x = 0.5 * symmetric_random(generator), y = 0.5 * symmetric_random(generator);
      f.tiled.expand({{x - 0.4, y - 0.3}, {x + 0.4, y + 0.3}}, 53, &tile);
      Point<2> origin, direction;
      for (int k = 0; k < 2; ++k) {
        origin[k] = 0.5 * symmetric_random(generator);
        direction[k] = 0.5 * symmetric_random(generator);
      }
      const std::vector<Rational> exact = exact_net(tile, origin, direction);
      LineNet net, precise;
      interpolate(tile, origin, direction, tables, 0, &net);
      const double bound = tables.values_norm *
                           (interpolation_roundings(degree) * u * tile.sum + 3 * u * tile.slope);
      EXPECT_LE(largest_error(net, exact), Rational(bound));
      EXPECT_GT(largest_error(net, exact), Rational(1e-8 * bound));
      substitute(tile, origin, direction, tables, &precise);
      EXPECT_LE(largest_error(precise, exact),
                Rational(substitution_roundings(degree) * u * tile.sum));
      // Cutting: the parts' exact nets are those of shorter segments.
      double largest = 0;
      for (const double b : precise.b) largest = std::max(largest, std::fabs(b));
      const Rational cut_bound =
          largest_error(precise, exact) + Rational(cutting_roundings(degree) * u * largest);
      for (const double fraction : {0.5, 0.375}) {
        LineNet lower, upper;
        if (fraction == 0.5)
          halve(precise, tables, 0, &lower, &upper);
        else
          cut(precise, tables, fraction, 0, &lower, &upper);
        // The segments' ends have to be doubles for `exact_net`: take multiples of 2^-20.
        Point<2> o, d, low_o, low_d, up_o, up_d;
        for (int k = 0; k < 2; ++k) {
          o[k] = std::nearbyint(origin[k] * 0x1p20) * 0x1p-20;
          d[k] = std::nearbyint(direction[k] * 0x1p20) * 0x1p-20;
          low_d[k] = fraction * d[k];
          up_d[k] = (1 - fraction) * d[k];
          low_o[k] = o[k] - d[k] + low_d[k];
          up_o[k] = o[k] + d[k] - up_d[k];
        }
        substitute(tile, o, d, tables, &precise);
        if (fraction == 0.5)
          halve(precise, tables, 0, &lower, &upper);
        else
          cut(precise, tables, fraction, 0, &lower, &upper);
        const Rational own = Rational(substitution_roundings(degree) * u * tile.sum) + cut_bound;
        EXPECT_LE(largest_error(lower, exact_net(tile, low_o, low_d)), own);
        EXPECT_LE(largest_error(upper, exact_net(tile, up_o, up_d)), own);
      }
      Rational value = 0;
      for (int k = 0; k <= degree; ++k)
        for (int l = 0; k + l <= degree; ++l) {
          Rational term(tile.a[k][l]);
          for (int m = 0; m < k; ++m) term *= Rational(origin[0]);
          for (int m = 0; m < l; ++m) term *= Rational(origin[1]);
          value += term;
        }
      EXPECT_LE(abs(Rational(Rational(value_at(tile, origin)) - value)),
                Rational(value_roundings(degree) * u * tile.sum));
    }
  }
}

TEST(LineNet, SignsAreThoseBeyondTheThreshold) {
  LineNet net{};
  const double values[] = {1, -1, 0.1, -0.1, 0, 3, -3, 0.5, 2, -2};
  for (int j = 0; j < 10; ++j) net.b[j] = values[j];
  const SignBits at_half = signs(net, 9, 0.5);
  EXPECT_EQ(at_half.positive, 0b0100100001u);
  EXPECT_EQ(at_half.negative, 0b1001000010u);
  const SignBits up = rises(net, 9, 1.5);
  EXPECT_EQ(up.positive, 0b001010000u);
  EXPECT_EQ(up.negative, 0b100100001u);
  EXPECT_EQ(signs(net, 9, NAN).positive, 0u);
}

TEST(LineNet, SignChangeIsBetweenItsBounds) {
  std::mt19937_64 generator(7);
  int found = 0, at_end = 0;
  for (int i = 0; i < 3000; ++i) {
    const int degree = 2 + i % 14, positives = 1 + i % degree;
    const bool rises = i % 3 == 0;
    LineNet net;
    Bernstein<1> exact;
    exact.degree = {degree};
    for (int j = 0; j <= degree; ++j) {
      const double size = std::exp2(12 * symmetric_random(generator));
      net.b[j] = (j < positives) != rises ? size : -size;
      exact.b.push_back(net.b[j]);
    }
    const SignChange change =
        find_sign_change(net, bernstein_tables(degree), rises, largest_coefficient(net), {0, 0, 0});
    if (change.verdict != SignChange::Verdict::Found) continue;
    ++found;
    EXPECT_LE(change.lo, change.at);
    EXPECT_LE(change.at, change.hi);
    const Polynomial<1> polynomial = exact_bernstein::polynomial<1>(exact);  // on [-1, 1]
    const auto sign_at = [&](double v) { return sgn(polynomial({2 * Rational(v) - 1})); };
    EXPECT_EQ(sign_at(change.lo), rises ? -1 : 1);
    EXPECT_EQ(sign_at(change.hi), rises ? 1 : -1);
    if (change.lo == 0 || change.hi == 1) ++at_end;
  }
  EXPECT_GT(found, 2000);
  EXPECT_GT(at_end, 50);
}

TEST(NoLineRoot, OnLinesAndSegmentsIncludesTheEnds) {
  Curve f("x^2 + y^2 - 1", {{-2, -2}, {2, 2}});
  const auto none = [&](const Line& on, double lo, double hi) {
    return no_root_on_line(f.tiled, on, lo, hi, f.kernel);
  };
  EXPECT_TRUE(none(kXAxis, -0.9999999, 0.9999999));
  EXPECT_FALSE(none(kXAxis, -0.5, 1));
  EXPECT_FALSE(none(kXAxis, -2, 0));
  EXPECT_FALSE(none(kXAxis, -2, 2));  // two roots: equal signs at the ends
  EXPECT_TRUE(none(kXAxis, 1.0000001, 5));
  EXPECT_TRUE(none(kXAxis, 0.5, 0.5));
  EXPECT_FALSE(none(kXAxis, 1, 1));
  EXPECT_TRUE(none(line(0, 1, -1.0000001), -1, 1));
  EXPECT_FALSE(none(line(0, 1, -1), -1, 1));  // touches

  const auto clear = [&](const Point<2>& from, const Point<2>& to) {
    return no_root_on_segment(f.tiled, from, to, f.kernel);
  };
  EXPECT_TRUE(clear({-0.7, 0.7}, {0.7, -0.7}));
  EXPECT_FALSE(clear({0, 0}, {0.8, 0.8}));
  EXPECT_FALSE(clear({0, 0}, {1, 0}));
  EXPECT_FALSE(clear({-2, 0.1}, {2, 0.1}));
  EXPECT_TRUE(clear({0, 2}, {2, 0}));
  EXPECT_FALSE(clear({0, HUGE_VAL}, {2, 0}));
}

TEST(NoLineRoot, ZeroJustBeyondTheEndDoesNotDisturb) {
  Curve f("x - 1/3 + y");
  const double below = std::nextafter(1.0 / 3, 0);
  EXPECT_TRUE(no_root_on_line(f.tiled, kXAxis, -1, below, f.kernel));
  EXPECT_FALSE(no_root_on_line(f.tiled, kXAxis, -1, std::nextafter(1.0 / 3, 1), f.kernel));
}

TEST(RefineLineRoot, ShrinksToNeighbouringDoublesAndKeepsTheRoot) {
  for (const std::string text : {"x^3 - y/3 + x - 1/3", "x^2 - 1/2 + y", "10^6 (x - 1/7) + x y"}) {
    Curve f(text);
    const Line on = line(Rational(1, 50), 1, Rational(-1, 100));
    const Polynomial<1> exact = restrict_exactly(f.filtered.polynomial().exact(), on);
    const auto roots = f.isolate(on, 0.0625, 1);
    ASSERT_TRUE(roots.has_value());
    ASSERT_EQ(roots->size(), 1u);
    LineRoot root = roots->front();
    int steps = 0;
    for (LineRoot before = root; refine_on_line(f.tiled, on, &root, f.kernel); before = root) {
      ASSERT_LE(before.lo, root.lo);
      ASSERT_LE(root.hi, before.hi);
      if (before.hi - before.lo > 1e-14) {
        ASSERT_LE(root.hi - root.lo, 0.57 * (before.hi - before.lo));
      }
      ASSERT_EQ(count_real_roots(exact, Rational(root.lo), Rational(root.hi)), 1);
      ASSERT_LT(++steps, 60);
    }
    EXPECT_LE(root.hi, std::nextafter(std::nextafter(root.lo, 2), 2));
  }
}

TEST(RefineLineRoot, RootAtADoubleIsKeptInside) {
  Curve f("x - 1/2 + y");
  LineRoot root{0, 1, 0.5};
  for (int i = 0; i < 40 && refine_on_line(f.tiled, kXAxis, &root, f.kernel); ++i) {
    EXPECT_LT(root.lo, 0.5);
    EXPECT_GT(root.hi, 0.5);
  }
  EXPECT_LT(root.hi - root.lo, 1e-9);
}

TEST(NarrowLineRoot, CutsAtAParameterUnlessTheRootIsThere) {
  Curve f("x - 1/2 + y");
  LineRoot root{0, 1, 0.5};
  EXPECT_TRUE(narrow_on_line(f.tiled, kXAxis, 0.25, &root, f.kernel));
  EXPECT_EQ(root.lo, 0.25);
  EXPECT_TRUE(narrow_on_line(f.tiled, kXAxis, std::nextafter(0.5, 1), &root, f.kernel));
  EXPECT_EQ(root.hi, std::nextafter(0.5, 1));
  EXPECT_TRUE(narrow_on_line(f.tiled, kXAxis, 0.125, &root, f.kernel));
  EXPECT_EQ(root.lo, 0.25);
  EXPECT_FALSE(narrow_on_line(f.tiled, kXAxis, 0.5, &root, f.kernel));
}

TEST(SignOnLineFromTiles, IsExactAtEveryParameter) {
  Curve f("x^2 + y^2 - 1");
  EXPECT_EQ(sign_on_line(f.tiled, kXAxis, 1, f.kernel), Sign::Zero);
  EXPECT_EQ(f.kernel.decisions.by_exact, 1);
  EXPECT_EQ(sign_on_line(f.tiled, kXAxis, std::nextafter(1, 2), f.kernel), Sign::Positive);
  EXPECT_EQ(sign_on_line(f.tiled, kXAxis, std::nextafter(1, 0), f.kernel), Sign::Negative);
  // On y = 1/3 x the other coordinate is no double.
  std::mt19937_64 generator(3);
  const Line third = line(Rational(-1, 3), 1, 0);
  const Polynomial<1> exact = restrict_exactly(f.filtered.polynomial().exact(), third);
  for (int i = 0; i < 100; ++i) {
    const double at = std::sqrt(0.9) + std::ldexp(symmetric_random(generator), -(i % 53));
    EXPECT_EQ(sign_on_line(f.tiled, third, at, f.kernel), sign_of(sgn(exact({Rational(at)}))));
  }
}

}  // namespace
}  // namespace encase
