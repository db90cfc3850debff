// SPDX-License-Identifier: MIT
#include "common/expression_program.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
bool holds(const Interval& outer, const Interval& inner) {
  return outer.lo <= inner.lo && inner.hi <= outer.hi;
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
  for (int round = 0; round < 4000; ++round) {
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
  EXPECT_GT(values, 40000);
  EXPECT_GT(slopes, 40000);
  EXPECT_GT(undefined, 1000);
  EXPECT_GT(smooth, 3000);
}

TEST(ExpressionProgram, EnclosuresOfPartsLieInThoseOfTheWhole) {
  std::mt19937_64 generator(6);
  ExpressionProgram<3>::Workspace<Interval> workspace;
  for (int round = 0; round < 4000; ++round) {
    const Expression f =
        random_expressions::tree(1 + static_cast<int>(generator() % 14), 3, generator);
    const ExpressionProgram<3> program(f);
    std::array<Interval, 3> box, part;
    for (std::size_t i = 0; i < 3; ++i) {
      box[i] = random_side(generator);
      const double p = random_point(box[i], generator), q = random_point(box[i], generator);
      part[i] = {std::min(p, q), std::max(p, q)};
    }
    const auto whole = program.evaluate<2>(box, workspace);
    const auto inner = program.evaluate<2>(part, workspace);
    if (inner.nowhere()) continue;
    ASSERT_FALSE(whole.nowhere()) << f.to_string();
    ASSERT_LE(whole.regularity, inner.regularity) << f.to_string();
    for (std::size_t k = 0; k < 10; ++k)
      ASSERT_TRUE(holds(whole.jet.part[k], inner.jet.part[k]))
          << f.to_string() << ", part " << k << ": " << to_string(inner.jet.part[k])
          << " is not in " << to_string(whole.jet.part[k]);
  }
}

}  // namespace
}  // namespace encase
