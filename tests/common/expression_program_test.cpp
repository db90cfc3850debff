// SPDX-License-Identifier: MIT
#include "common/expression_program.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "counted_allocations.hpp"
#include "mpfr_reference.hpp"
#include "random_expressions.hpp"

namespace encase {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool holds(const Interval& range, const Mpfr& value) {
  return mpfr_cmp_d(value.get(), range.lo) >= 0 && mpfr_cmp_d(value.get(), range.hi) <= 0;
}
bool holds(const MpfrInterval& range, const Mpfr& value) {
  return mpfr_cmp(value.get(), range.lo()) >= 0 && mpfr_cmp(value.get(), range.hi()) <= 0;
}
bool holds(const Interval& outer, const MpfrInterval& inner) {
  return mpfr_cmp_d(inner.lo(), outer.lo) >= 0 && mpfr_cmp_d(inner.hi(), outer.hi) <= 0;
}
bool is_valid(const Interval& range) {
  return range.lo <= range.hi && range.lo < kInfinity && range.hi > -kInfinity;
}
bool is_valid(const MpfrInterval& range) {
  return mpfr_lessequal_p(range.lo(), range.hi()) &&
         !(mpfr_inf_p(range.lo()) && mpfr_sgn(range.lo()) > 0) &&
         !(mpfr_inf_p(range.hi()) && mpfr_sgn(range.hi()) < 0);
}

std::string to_string(const Interval& range) {
  return "[" + std::to_string(range.lo) + ", " + std::to_string(range.hi) + "]";
}

/// The kinds of boxes that matter: ordinary, small, of zero width, huge, denormal, at integers.
Interval random_side(std::mt19937_64& generator) {
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  const double center = 8 * uniform() - 4;
  const auto ordered = [](double a, double b) { return a < b ? Interval(a, b) : Interval(b, a); };
  switch (generator() % 10) {
    case 0:
      return center;
    case 1:
      return ordered(std::floor(center), std::floor(center) + static_cast<double>(generator() % 3));
    case 2: {
      const double scale = std::ldexp(1.0, static_cast<int>(generator() % 600));
      return ordered(center * scale, (8 * uniform() - 4) * scale);
    }
    case 3: {
      const double scale = std::ldexp(1.0, -static_cast<int>(generator() % 1080));
      return ordered(center * scale, (8 * uniform() - 4) * scale);
    }
    case 4:
    case 5:
      return ordered(center, center + std::ldexp(uniform(), -static_cast<int>(generator() % 50)));
    default:
      return ordered(center, 8 * uniform() - 4);
  }
}

double random_point(const Interval& side, std::mt19937_64& generator) {
  switch (generator() % 5) {
    case 0:
      return side.lo;
    case 1:
      return side.hi;
    default: {
      const double t = static_cast<double>(generator() >> 11) * 0x1p-53;
      return std::clamp(side.lo + t * (side.hi - side.lo), side.lo, side.hi);
    }
  }
}

TEST(ExpressionProgram, EnclosuresHoldWhatMpfrFindsAtPoints) {
  std::mt19937_64 generator(5);
  ExpressionProgram<2>::Workspace<Interval> workspace;
  ExpressionProgram<2>::Workspace<MpfrInterval> mpfr_workspace;
  int values = 0, slopes = 0, undefined = 0, smooth = 0;
  for (int round = 0; round < 2500; ++round) {
    const Expression f =
        random_expressions::tree(1 + static_cast<int>(generator() % 14), 2, generator);
    const auto steps = f.steps();
    const ExpressionProgram<2> program(f);
    for (int trial = 0; trial < 4; ++trial) {
      const std::array<Interval, 2> box{random_side(generator), random_side(generator)};
      const auto found = program.value_and_gradient(box, workspace);
      const Interval value = program.value(box, workspace).range();
      ASSERT_EQ(value.lo, found.range().lo);
      ASSERT_EQ(value.hi, found.range().hi);
      std::array<MpfrInterval, 2> mpfr_box;
      for (std::size_t i = 0; i < 2; ++i) mpfr_box[i] = MpfrInterval(100, box[i].lo, box[i].hi);
      const auto precise = program.value_and_gradient(mpfr_box, mpfr_workspace);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_TRUE(is_valid(found.jet.part[k])) << f.to_string();
        ASSERT_TRUE(is_valid(precise.jet.part[k])) << f.to_string();
      }
      smooth += found.smooth();
      for (int sample = 0; sample < 4; ++sample) {
        const Point<2> point{random_point(box[0], generator), random_point(box[1], generator)};
        for (int axis = 0; axis < 2; ++axis) {
          const auto reference = mpfr_reference::evaluate(steps, point, axis);
          if (!reference) continue;
          const auto& exact = *reference;
          const auto what = [&] {
            return f.to_string() + " on " + to_string(box[0]) + " x " + to_string(box[1]) + " at " +
                   std::to_string(point[0]) + ", " + std::to_string(point[1]) + ": " +
                   to_string(found.range()) + ", derivative " + to_string(found.jet.first(axis));
          };
          if (mpfr_nan_p(exact.value.get())) {
            ++undefined;
            ASSERT_FALSE(found.continuous()) << what();
            ASSERT_FALSE(precise.continuous()) << what();
            continue;
          }
          ++values;
          ASSERT_FALSE(found.nowhere() || precise.nowhere()) << what();
          ASSERT_TRUE(holds(found.range(), exact.value)) << what();
          ASSERT_TRUE(holds(precise.range(), exact.value)) << what();
          if (!mpfr_number_p(exact.slope.get())) {
            ASSERT_FALSE(found.smooth() || precise.smooth()) << what();
            continue;
          }
          ++slopes;
          ASSERT_TRUE(holds(found.jet.first(axis), exact.slope)) << what();
          ASSERT_TRUE(holds(precise.jet.first(axis), exact.slope)) << what();
        }
      }
    }
  }
  EXPECT_GT(values, 25000);
  EXPECT_GT(slopes, 25000);
  EXPECT_GT(undefined, 1000);
  EXPECT_GT(smooth, 2000);
}

// The doubles must hold what interval arithmetic without rounding finds on any part.
TEST(ExpressionProgram, EnclosuresInMpfrOfPartsLieInThoseOfTheWholeInDoubles) {
  std::mt19937_64 generator(6);
  ExpressionProgram<3>::Workspace<Interval> workspace;
  ExpressionProgram<3>::Workspace<MpfrInterval> mpfr_workspace;
  for (int round = 0; round < 2500; ++round) {
    const Expression f =
        random_expressions::tree(1 + static_cast<int>(generator() % 14), 3, generator);
    const ExpressionProgram<3> program(f);
    std::array<Interval, 3> box;
    std::array<MpfrInterval, 3> part;
    for (std::size_t i = 0; i < 3; ++i) {
      box[i] = random_side(generator);
      const double p = random_point(box[i], generator), q = random_point(box[i], generator);
      part[i] = MpfrInterval(200, std::min(p, q), std::max(p, q));
    }
    const auto whole = program.evaluate<2>(box, workspace);
    const auto inner = program.evaluate<2>(part, mpfr_workspace);
    if (inner.nowhere()) continue;
    ASSERT_FALSE(whole.nowhere()) << f.to_string();
    ASSERT_LE(whole.regularity, inner.regularity) << f.to_string();
    for (std::size_t k = 0; k < 10; ++k)
      ASSERT_TRUE(holds(whole.jet.part[k], inner.jet.part[k]))
          << f.to_string() << ", part " << k << ": "
          << to_string(elementary::rounded_outward(inner.jet.part[k])) << " is not in "
          << to_string(whole.jet.part[k]);
  }
}

// By the mean value theorem the difference quotient of a first derivative is a value of the second.
TEST(ExpressionProgram, SecondDerivativesHoldDifferenceQuotientsOfFirstOnes) {
  std::mt19937_64 generator(7);
  ExpressionProgram<2>::Workspace<Interval> workspace;
  ExpressionProgram<2>::Workspace<MpfrInterval> mpfr_workspace;
  const Interval slack(1 - 0x1p-40, 1 + 0x1p-40);
  using mpfr_reference::operator-, mpfr_reference::operator/;
  int compared = 0;
  for (int round = 0; round < 10000; ++round) {
    const Expression f =
        random_expressions::tree(1 + static_cast<int>(generator() % 10), 2, generator);
    const ExpressionProgram<2> program(f);
    // Neither tiny nor huge, so that 300 bits suffice for the quotients.
    std::array<Interval, 2> box;
    for (Interval& side : box) {
      const double lo = static_cast<double>(generator() >> 11) * 0x1p-50 - 4;
      side = {lo, lo + std::ldexp(1.0, -static_cast<int>(generator() % 20))};
    }
    const auto found = program.evaluate<2>(box, workspace);
    const auto precise = program.evaluate<2>(std::array{MpfrInterval(200, box[0].lo, box[0].hi),
                                                        MpfrInterval(200, box[1].lo, box[1].hi)},
                                             mpfr_workspace);
    if (!found.smooth()) continue;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        Point<2> from{random_point(box[0], generator), random_point(box[1], generator)}, to = from;
        to[j] = random_point(box[static_cast<std::size_t>(j)], generator);
        if (std::fabs(from[j] - to[j]) < 0x1p-30) continue;
        const auto p = mpfr_reference::evaluate(f.steps(), from, i),
                   q = mpfr_reference::evaluate(f.steps(), to, i);
        if (!p || !q) continue;
        const Mpfr difference = q->slope - p->slope;
        const Mpfr quotient =
            difference / (mpfr_reference::number(to[j]) - mpfr_reference::number(from[j]));
        if (!mpfr_number_p(quotient.get())) continue;
        ++compared;
        // The quotient itself is rounded.
        const Interval range = elementary::multiply(found.jet.second(i, j), slack);
        ASSERT_TRUE(holds(range, quotient)) << f.to_string() << ", " << i << j;
        ASSERT_TRUE(holds(
            elementary::multiply(elementary::rounded_outward(precise.jet.second(i, j)), slack),
            quotient))
            << f.to_string() << ", " << i << j;
      }
  }
  EXPECT_GT(compared, 5000);
}

const Expression kX = Expression::variable(0), kY = Expression::variable(1);
Expression number(long value) { return Expression(Rational(value)); }
Expression call(Operation operation, const Expression& operand) {
  return Expression::apply(operation, operand);
}

TEST(ExpressionProgram, IsNeverRegularWhereThereIsAPoleOrAnEdge) {
  const Expression third(Rational(1, 3));
  const Expression distance = kX - third;
  const Expression functions[] = {
      distance.power(-1),
      kY / distance,
      distance.power(-2),
      call(Operation::Log, distance),
      call(Operation::Sqrt, distance - Expression(Rational(1, 1 << 20))),
      call(Operation::Asin, distance + Expression(Rational(1))),
      call(Operation::Acos, distance - Expression(Rational(1))),
      call(Operation::Tan, distance + Expression::pi() / number(2))};
  std::mt19937_64 generator(8);
  ExpressionProgram<2>::Workspace<Interval> workspace;
  for (const Expression& f : functions) {
    const ExpressionProgram<2> program(f);
    for (int round = 0; round < 1000; ++round) {
      const double radius = std::ldexp(1.0, -static_cast<int>(generator() % 20));
      const std::array<Interval, 2> box{Interval(1 / 3.0 - radius, 1 / 3.0 + radius), {1, 2}};
      const auto found = program.value_and_gradient(box, workspace);
      ASSERT_FALSE(found.continuous()) << f.to_string();
      ASSERT_FALSE(found.nowhere()) << f.to_string();
      const std::array<Interval, 2> right{Interval(1 / 3.0 + 1e-5, 1 / 3.0 + 2e-5), {1, 2}},
          left{Interval(1 / 3.0 - 2e-5, 1 / 3.0 - 1e-5), {1, 2}};
      ASSERT_TRUE(program.value(right, workspace).smooth() ||
                  program.value(left, workspace).smooth())
          << f.to_string();
    }
  }
  // Continuous, and not smooth.
  for (const Expression& f :
       {call(Operation::Abs, kX - kY), Expression::apply(Operation::Max, kX, kY),
        call(Operation::Sqrt, kX * kX), call(Operation::Asin, kX)}) {
    const auto found = ExpressionProgram<2>(f).value_and_gradient(
        std::array{Interval(0, 1), Interval(0, 1)}, workspace);
    EXPECT_TRUE(found.continuous()) << f.to_string();
    EXPECT_FALSE(found.smooth()) << f.to_string();
  }
}

TEST(ExpressionProgram, ValuesThatAreNowhereAreSaidToBe) {
  ExpressionProgram<2>::Workspace<Interval> workspace;
  const Interval line(-kInfinity, kInfinity);
  for (const Expression& f :
       {call(Operation::Log, -number(1) - kX * kX), call(Operation::Sqrt, number(-1)) + kX,
        number(1) / number(0), kX * call(Operation::Asin, number(2) + kY * kY),
        Expression::apply(Operation::Min, kX, call(Operation::Log, -kY.power(2)))}) {
    const auto found =
        ExpressionProgram<2>(f).value_and_gradient(std::array{line, line}, workspace);
    EXPECT_TRUE(found.nowhere()) << f.to_string();
    EXPECT_EQ(found.range().lo, -kInfinity);
    EXPECT_EQ(found.jet.first(1).hi, kInfinity);
  }
}

TEST(ExpressionProgram, SignsAtPointsAreDecidedOrCalledUnknown) {
  const auto sine = call(Operation::Sin, kX);
  const Rational third(1, 3);
  const RationalPoint<2> origin{0, 0}, at_third{third, third};
  Kernel kernel;
  const auto count = [&] {
    return std::array{kernel.decisions.by_double, kernel.decisions.by_mpfr,
                      kernel.decisions.by_exact, kernel.decisions.undecided};
  };
  enum { kDouble, kMpfr, kExact, kNone };
  const Rational near_sine(
      "8414709848078965066525023216302989996225630607983710656727/"
      "10000000000000000000000000000000000000000000000000000000000");
  const std::tuple<Expression, RationalPoint<2>, PointSign, int> cases[] = {
      {kY - sine, {1, 1}, PointSign::Positive, kDouble},
      {kY - sine, {1, 0}, PointSign::Negative, kDouble},
      {kY - sine, origin, PointSign::Zero, kDouble},
      {kY - sine, {1, near_sine}, PointSign::Negative, kMpfr},
      {kX - kY, at_third, PointSign::Zero, kExact},
      {call(Operation::Abs, kX.power(-3) - number(27)), at_third, PointSign::Zero, kExact},
      {call(Operation::Sqrt, kX * kY) - kX, at_third, PointSign::Zero, kExact},
      {number(1) / (kX - kY) + sine, at_third, PointSign::NoValue, kExact},
      {number(1) / (kX - kY) + sine, origin, PointSign::NoValue, kDouble},
      {call(Operation::Log, kX - Expression(third)), at_third, PointSign::NoValue, kExact},
      {call(Operation::Sqrt, kX - number(1)), at_third, PointSign::NoValue, kDouble},
      {call(Operation::Exp, call(Operation::Log, kX)) - kX, at_third, PointSign::Unknown, kNone},
      {call(Operation::Log, sine.power(2) + call(Operation::Cos, kX).power(2) - number(1)),
       at_third, PointSign::Unknown, kNone}};
  for (const auto& [f, point, sign, settled] : cases) {
    const auto before = count();
    EXPECT_EQ(ExpressionProgram<2>(f).sign_at(point, kernel), sign) << f.to_string();
    const auto after = count();
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(after[k] - before[k], static_cast<int>(k) == settled) << f.to_string();
  }
}

TEST(ExpressionProgram, EvaluatesWithoutAllocation) {
  std::mt19937_64 generator(9);
  ExpressionProgram<2>::Workspace<Interval> workspace;
  const ExpressionProgram<2> program(kY - call(Operation::Sin, number(3) * kX) /
                                              call(Operation::Exp, kX * kY));
  std::array<Interval, 2> box{Interval(0.1, 0.2), Interval(0.5, 0.6)};
  program.evaluate<2>(box, workspace);
  program.value(box, workspace);
  const long before = counted_allocations();
  for (int k = 0; k < 100; ++k) {
    box[0].lo -= 0.01;
    ASSERT_TRUE(program.evaluate<2>(box, workspace).smooth());
    ASSERT_TRUE(program.value(box, workspace).smooth());
  }
  EXPECT_EQ(counted_allocations() - before, 0);
}

}  // namespace
}  // namespace encase
