// SPDX-License-Identifier: MIT
//
// Input that is refused, options, and budgets that run out.
#include <cmath>
#include <limits>

#include "common/random_polynomials.hpp"
#include "encase/encasement.hpp"
#include "encase/result_json.hpp"
#include "encased.hpp"

namespace encase {
namespace {

using encased::count;
using encased::expect_certified;
using encased::inside;
using encased::square;

std::vector<NamedCurve> random_pair(int degree, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.seed = seed;
  return random_curves(options);
}

std::string complaint(const std::vector<NamedCurve>& curves, const EncaseOptions& options = {},
                      const Region& region = square()) {
  const auto result = encase(curves, region, options);
  if (result.ok()) return "";
  EXPECT_EQ(result.error().code, Error::Code::BadInput);
  return result.error().message;
}

TEST(EncaseInput, ZeroConstantAndTooHighDegreesAreRefusedByName) {
  const Polynomial<2> x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  EXPECT_NE(complaint({{"fine", x}, {"nil", Polynomial<2>()}}).find("'nil'"), std::string::npos);
  EXPECT_NE(complaint({{"three", Polynomial<2>::constant(3)}}).find("'three'"), std::string::npos);
  const std::string high = complaint({{"high", x.power(60) * y + x}});
  EXPECT_NE(high.find("'high'"), std::string::npos);
  EXPECT_NE(high.find("61"), std::string::npos);
}

TEST(EncaseInput, DegreeSixtyIsTaken) {
  const Polynomial<2> x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  expect_certified(encased::run_curves({{"high", x.power(60) - y}}));
}

TEST(EncaseInput, RegionsWithoutCornersAndBadPerturbationsAreRefused) {
  const auto curves = encased::curves({"x - y/3"});
  EXPECT_FALSE(complaint(curves, {}, Region()).empty());
  for (const double delta : {-1e-8, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EncaseOptions options;
    options.perturbation = delta;
    EXPECT_FALSE(complaint(curves, options).empty()) << delta;
  }
}

TEST(EncaseOptions, ForcedMpfrGivesTheSameEncasement) {
  EncaseOptions options;
  options.start_bits = 106;
  for (const auto& curves :
       {encased::curves({"x^2 + y^2 - 1/2", "y - x/5 - 1/20"}), random_pair(4, 1)}) {
    const Encasement plain = encased::run_curves(curves);
    const Encasement forced = encased::run_curves(curves, square(), options);
    expect_certified(forced);
    EXPECT_EQ(forced.crossings.size(), plain.crossings.size());
    EXPECT_EQ(forced.cells.size(), plain.cells.size());
    EXPECT_GT(forced.statistics.mpfr_expansions, 0);
    EXPECT_GT(forced.statistics.decisions.by_mpfr, 0);
  }
}

/// Undecided by a budget: flagged, and what is there is verified.
void expect_out_of_budget(const Encasement& e, const std::string& reason) {
  EXPECT_EQ(e.outcome, Outcome::Undecided);
  EXPECT_GT(count(e, CellState::Undecided), 0);
  ASSERT_FALSE(e.undecided.empty());
  bool found = false;
  for (const Unresolved& entry : e.undecided) {
    EXPECT_EQ(entry.kind, Unresolved::Kind::Budget);
    found = found || entry.reason.find(reason) != std::string::npos;
  }
  EXPECT_TRUE(found) << e.undecided.front().reason;
}

TEST(EncaseBudget, LimitOnCellsLeavesUndecidedCells) {
  EncaseOptions options;
  options.max_cells = 5;
  const Encasement e = encased::run_curves(random_pair(8, 1), square(), options);
  expect_out_of_budget(e, "5 cells");
  EXPECT_GT(e.cells.size(), 5u);
  // The crossings are complete nevertheless.
  EXPECT_EQ(e.crossings.size(), encased::run_curves(random_pair(8, 1)).crossings.size());
}

TEST(EncaseBudget, NoTimeLeavesOneUndecidedCell) {
  EncaseOptions options;
  options.max_seconds = 0;
  const Encasement e = encased::run_curves(random_pair(5, 1), square(), options);
  expect_out_of_budget(e, "seconds");
  EXPECT_EQ(e.cells.size(), 1u);
}

TEST(EncaseBudget, CancellationLeavesUndecidedCells) {
  EncaseOptions options;
  int calls = 0;
  options.progress = [&](const char* stage, double done) {
    EXPECT_NE(stage, nullptr);
    EXPECT_TRUE(done == -1 || (0 <= done && done <= 1));
    return ++calls < 2;
  };
  const auto curves = random_pair(14, 1);
  const Encasement e = encased::run_curves(curves, square(), options);
  expect_out_of_budget(e, "cancelled");
  EXPECT_GE(calls, 2);
  // Without the cancellation the same input is certified.
  options.progress = [](const char*, double) { return true; };
  expect_certified(encased::run_curves(curves, square(), options));
}

TEST(EncaseOptions, RelaxedAcceptsBranchesSideBySide) {
  const std::vector<std::string> texts{"y - x^2 + 1/3", "y - x^2 + 1/3 - 1/1000"};
  const Encasement strict = encased::run(texts);
  expect_certified(strict);
  EncaseOptions options;
  options.relaxed = true;
  const Encasement relaxed = encased::run(texts, square(), options);
  expect_certified(relaxed);
  EXPECT_GT(count(relaxed, CellState::Relaxed), 0);
  EXPECT_LT(relaxed.cells.size(), strict.cells.size());
  for (const Cell& cell : relaxed.cells) {
    if (cell.state == CellState::Relaxed) {
      EXPECT_EQ(cell.branches.size(), 2u);
      EXPECT_EQ(cell.crossing, -1);
    }
  }
}

TEST(EncaseOptions, StrictRunRelaxesAfterTheStatedSplits) {
  EncaseOptions options;
  options.relax_after_splits = 0;
  const Encasement e = encased::run({"y - x^2 + 1/3", "y - x^2 + 1/3 - 1/10^9"}, square(), options);
  expect_certified(e);
  EXPECT_GT(count(e, CellState::Relaxed), 0);
}

TEST(EncaseOptions, FastTriesFewerLines) {
  const auto curves = random_pair(8, 1);
  EncaseOptions options;
  const Encasement best = encase(curves, square(), options).value();
  options.fast = true;
  const Encasement fast = encase(curves, square(), options).value();
  expect_certified(fast);
  EXPECT_LT(fast.statistics.candidate_lines, 0.6 * best.statistics.candidate_lines);
  EXPECT_LT(fast.cells.size(), 2 * best.cells.size());
}

TEST(EncaseOptions, PerturbationIsDeterminedByTheSeed) {
  const auto curves = encased::curves({"y - x^2", "y"});
  EncaseOptions options;
  options.perturbation = 1e-6;
  options.seed = 3;
  const std::string first = to_json(encase(curves, square(), options).value()),
                    again = to_json(encase(curves, square(), options).value());
  EXPECT_EQ(first, again);
  options.seed = 4;
  EXPECT_NE(to_json(encase(curves, square(), options).value()), first);
}

}  // namespace
}  // namespace encase
