// SPDX-License-Identifier: MIT
//
// What is not in generic position is reported, and everything away from it certified.
#include <cmath>

#include "common/random_polynomials.hpp"
#include "encase/encasement.hpp"
#include "encased.hpp"

namespace encase {
namespace {

using encased::branches;
using encased::inside;
using encased::run;

using Kind = Unresolved::Kind;

/// The outcome is Degenerate with reports of exactly these kinds; boxes are small and around the
/// point, and only cells that meet one are not certified.
void expect_degenerate_at(const Encasement& e, Kind kind, const Point<2>& point,
                          const std::vector<int>& curves) {
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  EXPECT_TRUE(e.undecided.empty());
  ASSERT_FALSE(e.degenerate.empty());
  bool found = false;
  for (const Unresolved& entry : e.degenerate) {
    ASSERT_TRUE(entry.has_box) << entry.reason;
    EXPECT_FALSE(entry.proved) << "of a box nothing is proved";
    EXPECT_FALSE(entry.reason.empty());
    EXPECT_LT(entry.box.largest_width(), 1e-3);
    found = found || (entry.kind == kind && entry.box.contains(point) && entry.curves == curves);
  }
  EXPECT_TRUE(found) << e.degenerate.front().reason;
  EXPECT_GE(encased::count(e, CellState::Certified), 1);
  EXPECT_EQ(encased::count(e, CellState::Undecided), 0);
  EXPECT_GE(encased::count(e, CellState::Degenerate), 1);
  // Degenerate cells are few and near the box.
  EXPECT_LE(encased::count(e, CellState::Degenerate), 4);
  for (const Cell& cell : e.cells) {
    if (cell.state != CellState::Degenerate) continue;
    for (const Vertex& vertex : cell.vertices)
      EXPECT_LT(std::hypot(vertex.point[0] - point[0], vertex.point[1] - point[1]), 0.25);
  }
}

TEST(EncaseDegenerate, TangencyIsAContact) {
  const Encasement e = run({"x^2 + y^2 - 1/4", "y - 1/2"});
  expect_degenerate_at(e, Kind::Contact, {0, 0.5}, {0, 1});
  const Encasement rational = run({"y - (x - 1/3)^2 - 1/7", "y - 1/7"});
  expect_degenerate_at(rational, Kind::Contact, {1.0 / 3, 1.0 / 7}, {0, 1});
}

TEST(EncaseDegenerate, CrossingsBesideATangencyAreCertified) {
  // A tangency at (0, 0) and a simple crossing at (1/2, 0).
  const Encasement e = run({"y - x^2 (x - 1/2)", "y"});
  expect_degenerate_at(e, Kind::Contact, {0, 0}, {0, 1});
  EXPECT_EQ(inside(e), 1);
  EXPECT_TRUE(encased::has_crossing_at(e, 0, 1, 0.5, 0));
}

TEST(EncaseDegenerate, SingularPointsOfOneCurveAreReported) {
  const Encasement cusp = run({"y^2 - x^3"});
  expect_degenerate_at(cusp, Kind::SingularPoint, {0, 0}, {0});
  const Encasement node = run({"(y - 1/9)^2 - (x + 1/3)^2 - (x + 1/3)^3"});
  expect_degenerate_at(node, Kind::SingularPoint, {-1.0 / 3, 1.0 / 9}, {0});
  const Encasement isolated = run({"(x - 1/5)^2 + y^2 + y^3/3"});
  expect_degenerate_at(isolated, Kind::SingularPoint, {0.2, 0}, {0});
  const Encasement tacnode = run({"(y - x^2) (y + x^2)"});
  expect_degenerate_at(tacnode, Kind::SingularPoint, {0, 0}, {0});
}

TEST(EncaseDegenerate, SingularPointAwayFromTheOtherCurveLeavesCrossings) {
  const Encasement e = run({"y^2 - x^3", "y - x + 1/5"});
  expect_degenerate_at(e, Kind::SingularPoint, {0, 0}, {0});
  EXPECT_GT(inside(e), 0);
}

TEST(EncaseDegenerate, LineThroughASingularPointIsAContact) {
  const Encasement e = run({"y^2 - x^2 - x^3", "y - x/3"});
  expect_degenerate_at(e, Kind::Contact, {0, 0}, {0, 1});
}

TEST(EncaseDegenerate, ThreeCurvesThroughOnePointAreReported) {
  const Encasement e = run({"y - x - 1/3", "y + x - 1/3", "y - x/3 - 1/3"});
  expect_degenerate_at(e, Kind::Concurrency, {0, 1.0 / 3}, {0, 1, 2});
  EXPECT_EQ(e.crossings.size(), 3u);
}

const Unresolved* entry_of(const Encasement& e, Kind kind) {
  for (const Unresolved& entry : e.degenerate)
    if (entry.kind == kind) return &entry;
  return nullptr;
}

TEST(EncaseDegenerate, SameCurveTwiceIsEncasedOnceAndProved) {
  const Encasement e = run({"x^2 + y^2 - 1/3", "2/7 x^2 + 2/7 y^2 - 2/21", "y - x - 1/9"});
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  ASSERT_EQ(e.degenerate.size(), 1u);
  const Unresolved* shared = entry_of(e, Kind::SharedComponent);
  ASSERT_NE(shared, nullptr);
  EXPECT_TRUE(shared->proved);
  EXPECT_FALSE(shared->has_box);
  EXPECT_EQ(shared->curves, (std::vector<int>{0, 1}));
  ASSERT_EQ(e.curves.size(), 2u);
  EXPECT_EQ(e.curves[0].sources, (std::vector<int>{0, 1}));
  EXPECT_EQ(inside(e), 2);
  EXPECT_EQ(encased::count(e, CellState::Certified), static_cast<int>(e.cells.size()));
}

TEST(EncaseDegenerate, RepeatedComponentIsEncasedOnceAndProved) {
  const Encasement e = run({"(x^2 + y^2 - 1/3)^2 (x - 1/7)", "y - x/3 - 1/9"});
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  const Unresolved* repeated = entry_of(e, Kind::RepeatedComponent);
  ASSERT_NE(repeated, nullptr);
  EXPECT_TRUE(repeated->proved);
  EXPECT_FALSE(repeated->has_box);
  EXPECT_EQ(repeated->curves, std::vector<int>{0});
  // The circle, the vertical line and the other curve.
  EXPECT_EQ(e.curves.size(), 3u);
  EXPECT_EQ(e.degenerate.size(), 1u);
  EXPECT_EQ(inside(e), 5);
  EXPECT_EQ(encased::count(e, CellState::Certified), static_cast<int>(e.cells.size()));
}

TEST(EncaseDegenerate, SharedComponentIsEncasedOnceAndProved) {
  const Encasement e =
      run({"(x^2 + y^2 - 1/3) (x - 1/5)", "(x^2 + y^2 - 1/3) (y - 1/7)", "y + x/9 - 3/4"});
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  const Unresolved* shared = entry_of(e, Kind::SharedComponent);
  ASSERT_NE(shared, nullptr);
  EXPECT_TRUE(shared->proved);
  EXPECT_EQ(shared->curves, (std::vector<int>{0, 1}));
  EXPECT_EQ(e.curves.size(), 4u);
  EXPECT_EQ(e.degenerate.size(), 1u);
  EXPECT_EQ(inside(e), 6);
  EXPECT_EQ(encased::count(e, CellState::Certified), static_cast<int>(e.cells.size()));
}

TEST(EncaseDegenerate, PerturbationMakesACuspCertified) {
  EncaseOptions options;
  options.perturbation = 1e-8;
  for (const std::uint64_t seed : {1, 2}) {
    options.seed = seed;
    const Encasement e = run({"y^2 - x^3", "y - x - 1/3"}, encased::square(), options);
    encased::expect_certified(e);
    EXPECT_EQ(e.perturbation, 1e-8);
    EXPECT_EQ(e.seed, seed);
    EXPECT_NE(e.input[0].function.polynomial(), written::polynomial<2>("y^2 - x^3"));
  }
}

TEST(EncaseDegenerate, PerturbationMakesATangencyCertified) {
  EncaseOptions options;
  options.perturbation = 1e-8;
  for (const std::uint64_t seed : {1, 2, 3}) {
    options.seed = seed;
    encased::expect_certified(run({"y - x^2", "y", "x^2 + y^2 - 1/4"}, encased::square(), options));
    encased::expect_certified(run({"y - x", "y + x", "y - x/3"}, encased::square(), options));
    encased::expect_certified(
        run({"x^2 + y^2 - 1/3", "x^2 + y^2 - 1/3"}, encased::square(), options));
  }
}

}  // namespace
}  // namespace encase
