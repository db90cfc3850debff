// SPDX-License-Identifier: MIT
//
// Regions that became too many cells are split again.
#include <string>
#include <vector>

#include "2d/least_cells.hpp"
#include "common/random_polynomials.hpp"
#include "encased.hpp"

namespace encase {
namespace {

struct Pair {
  int degree;
  std::uint64_t seed;
};
/// Pairs that become more than twice as many cells as need be when they are first split.
constexpr Pair kPairs[] = {{3, 33}, {4, 21}, {5, 1},  {5, 18}, {5, 27},
                           {6, 10}, {7, 8},  {7, 10}, {7, 15}};

std::vector<NamedCurve> random(const Pair& pair) {
  RandomOptions options;
  options.degree = pair.degree;
  options.seed = pair.seed;
  return random_curves(options);
}

std::string name(const Pair& pair) {
  return "degree " + std::to_string(pair.degree) + ", seed " + std::to_string(pair.seed);
}

int cells_of(const Encasement& encasement) { return static_cast<int>(encasement.cells.size()); }

TEST(LeastCells, CountsCrossingsAndWhatHasNone) {
  const auto least = [](const std::vector<std::string>& texts) {
    return least_cells(encased::run(texts));
  };
  EXPECT_EQ(least({"x - y/3 - 2"}), 0);
  EXPECT_EQ(least({"x - y/3"}), 1);
  EXPECT_EQ(least({"x - y/3", "y + x/5 - 1/7"}), 1);
  EXPECT_EQ(least({"x^2 + y^2 - 1/3"}), 2);
  // An oval with two crossings, a branch without.
  EXPECT_EQ(least({"x^2 + y^2 - 1/3", "(x - y/7 - 1/11) (x - y/8 - 7/9)"}), 3);
}

TEST(SecondThoughts, SaveCellsWhereTheyAreTooMany) {
  for (const Pair& pair : kPairs) {
    SCOPED_TRACE(name(pair));
    const Encasement e = encased::run_curves(random(pair));
    encased::expect_certified(e);
    EXPECT_LE(cells_of(e), 2 * least_cells(e));
    EXPECT_EQ(e.statistics.splits, cells_of(e) - 1);
    EXPECT_EQ(e.history.size() + 1, e.cells.size());
    EXPECT_EQ(e.lines.size(), e.history.size() + 4);
  }
}

TEST(SecondThoughts, AreNotTakenWhenFast) {
  EncaseOptions fast;
  fast.fast = true;
  int above = 0;
  for (const Pair& pair : kPairs) {
    const Encasement e = encased::run_curves(random(pair), encased::square(), fast);
    above += cells_of(e) > 2 * least_cells(e);
  }
  EXPECT_GT(above, 4);
}

TEST(SecondThoughts, ChangeNothingWithinALimitOnCells) {
  const auto curves = random({5, 27});
  const Encasement e = encased::run_curves(curves);
  int same = 0;
  for (int most = cells_of(e); most < 2 * cells_of(e); ++most) {
    EncaseOptions options;
    options.max_cells = most;
    const Encasement limited = encased::run_curves(curves, encased::square(), options);
    if (limited.outcome == Outcome::Undecided) {
      EXPECT_EQ(same, 0) << most;
      continue;
    }
    ++same;
    EXPECT_EQ(cells_of(limited), cells_of(e)) << most;
  }
  EXPECT_GT(same, 0);
}

TEST(SecondThoughts, LeaveTheFirstResultWhenCancelled) {
  // (The first split ends before it is told that all is done.)
  const auto curves = random({7, 8});
  EncaseOptions options;
  bool cancelled = false;
  options.progress = [&](const std::string& stage, double done) {
    cancelled = cancelled || (stage == "splitting cells" && done == 1);
    return !cancelled;
  };
  const Encasement e = encased::run_curves(curves, encased::square(), options);
  EXPECT_TRUE(cancelled);
  encased::expect_certified(e);
  EXPECT_GT(cells_of(e), cells_of(encased::run_curves(curves)));
}

}  // namespace
}  // namespace encase
