// SPDX-License-Identifier: MIT
#include "2d/cell_at_hand.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "2d/locate.hpp"
#include "encase/verify.hpp"
#include "written.hpp"

namespace encase {
namespace {

Encasement encased(const std::vector<NamedCurve>& curves, const Region& region) {
  auto result = encase::encase(curves, region);
  EXPECT_TRUE(result.ok());
  return std::move(result).value();
}

TEST(Partition, FindsLoopsFarFromTheOrigin) {
  const Rational far("10000000000");
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto shift = Polynomial<2>::constant(far + Rational(1, 2));
  const Polynomial<2> circle =
      (x - shift).power(2) + (y - shift).power(2) - Polynomial<2>::constant(Rational(1, 100));
  const Encasement e =
      encased({{"circle", circle}}, make_region(far, far + 1, far, far + 1).value());
  EXPECT_EQ(e.outcome, Outcome::Certified);
  EXPECT_GE(e.cells.size(), 2u);  // the loop is cut
  EXPECT_FALSE(e.line_crossings.empty());
  const Verification v = verify(e);
  EXPECT_TRUE(v.ok()) << (v.objections.empty() ? "" : v.objections.front());
}

TEST(Partition, LocatesACrossingThatOnlyExactNumbersTellFromASide) {
  // The curves meet in (-1e-25, 0), outside [0, 1] x [-1, 1] by far less than an ulp of the region.
  const Encasement e = encased({{"f", written::polynomial<2>("x - y + 1e-25")},
                                {"g", written::polynomial<2>("x + y + 1e-25")}},
                               make_region(0, 1, -1, 1).value());
  ASSERT_EQ(e.crossings.size(), 1u);
  EXPECT_EQ(e.crossings[0].location, Location::Outside);
  const Verification v = verify(e);
  EXPECT_TRUE(v.ok()) << (v.objections.empty() ? "" : v.objections.front());
}

TEST(Partition, ParameterGrowsCounterClockwiseAroundASquare) {
  const Region square = make_region(-1, 1, -1, 1).value();
  for (int k = 0; k < 4; ++k) {
    const Line side = square.side(k);
    const int axis = parameter_axis(side);
    const auto &from = square.corners[k], &to = square.corners[(k + 1) % 4];
    EXPECT_EQ(parameter_grows(side, false), from[axis] < to[axis]) << k;
    EXPECT_NE(parameter_grows(side, true), parameter_grows(side, false)) << k;
  }
}

/// A curve in the square [-1,1]^2, to be partitioned.
struct CurveInSquare {
  explicit CurveInSquare(const std::string& text) {
    curves.emplace_back(written::polynomial<2>(text));
    for (int k = 0; k < 4; ++k) sides.push_back(square.side(k));
    tiles.emplace_back(curves[0], Box<2>{{-2, -2}, {2, 2}}, kernel);
    nested.emplace(curves, tiles, Point<2>{0, 0}, false, kernel);
  }
  Partition partition() { return Partition(curves, *nested, features, kernel); }

  Kernel kernel;
  const Region square = make_region(-1, 1, -1, 1).value();
  std::vector<Line> sides;
  std::vector<FilteredFunction<2>> curves;
  std::vector<TiledFunction> tiles;
  std::optional<NestedTiles> nested;
  Features features;
};

TEST(Partition, DoesNotOpenWhereACurvePassesThroughACorner) {
  CurveInSquare given("x - y");
  const Region square = given.square;
  Partition partition = given.partition();
  EXPECT_FALSE(partition.open(given.sides).has_value());
  // A slightly larger polygon moves the corners off the curve, and contains the square.
  const auto larger = enlarged(square, 1);
  ASSERT_TRUE(larger.has_value());
  std::vector<Line> sides;
  for (int k = 0; k < 4; ++k) sides.push_back(larger->side(k));
  for (const auto& corner : square.corners)
    for (const Line& side_line : sides)
      EXPECT_EQ(side(side_line, corner, given.kernel), Sign::Negative);
  const auto cell = partition.open(sides);
  ASSERT_TRUE(cell.has_value());
  EXPECT_EQ(cell->word.size(), 2u);
}

TEST(Partition, RefusesLinesThatMissTheCellOrMeetAVertex) {
  CurveInSquare given("x - 1/3");
  Partition partition = given.partition();
  const auto cell = partition.open(given.sides);
  ASSERT_TRUE(cell.has_value());
  const auto line = [](double a, double b, double c) {
    Line l;
    l.normal = {a, b};
    l.offset = c;
    return l;
  };
  CellAtHand at_hand(partition);
  at_hand.take(*cell);
  at_hand.propose(line(1, 0, -2));  // misses
  EXPECT_FALSE(at_hand.prove_best());
  at_hand.propose(line(1, -1, 0));  // through corners
  EXPECT_FALSE(at_hand.prove_best());
  at_hand.propose(line(3, 0, -2));  // a part that no curve meets
  ASSERT_TRUE(at_hand.prove_best());
  EXPECT_TRUE(at_hand.cut().roots.empty());
  at_hand.propose(line(0, 1, -0.99));  // close to vertices
  at_hand.propose(line(0, 1, -0.25));
  ASSERT_TRUE(at_hand.prove_best());  // a better line
  EXPECT_EQ(at_hand.cut().line.offset, -0.25);
  EXPECT_EQ(at_hand.cut().roots.size(), 1u);
  OpenCell below, above;
  ASSERT_TRUE(partition.apply(*cell, &at_hand.cut(), &below, &above));
  EXPECT_EQ(below.word.size(), 2u);
  EXPECT_EQ(above.word.size(), 2u);
  EXPECT_EQ(partition.history.size(), 1u);
}

TEST(Partition, JoinsWhatAPartMadeOfAHalf) {
  CurveInSquare given("x - 1/3");
  Partition whole = given.partition();
  const auto cell = whole.open(given.sides);
  ASSERT_TRUE(cell.has_value());
  const auto cut = [](Partition& partition, const OpenCell& from, double height, OpenCell* below,
                      OpenCell* above) {
    Line line;
    line.normal = {0, 1};
    line.offset = -height;
    CellAtHand at_hand(partition);
    at_hand.take(from);
    at_hand.propose(line);
    return at_hand.prove_best() && partition.apply(from, &at_hand.cut(), below, above);
  };
  OpenCell below, above;
  ASSERT_TRUE(cut(whole, *cell, 0.25, &below, &above));

  Partition part = given.partition();
  const OpenCell lower = part.begin(whole, below);
  ASSERT_EQ(part.lines.size(), 4u);
  ASSERT_EQ(part.line_crossings.size(), 2u);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(part.lines[lower.edges[k].line].offset, whole.lines[below.edges[k].line].offset);
  // Either refines the interval of the crossing on the line between them.
  int shared = 0;
  while (shared < 2 && whole.line_crossings[below.word[shared]].line != 4) ++shared;
  const int id = below.word[shared];
  ASSERT_EQ(whole.line_crossings[id].line, 4);
  LineCrossing &ours = whole.line_crossings[id], &theirs = part.line_crossings[shared];
  ours.lo = 0.25, ours.hi = 0.375;
  theirs.lo = 0.3125, theirs.hi = 0.5;
  OpenCell lowest, middle;
  ASSERT_TRUE(cut(part, lower, -0.5, &lowest, &middle));
  ASSERT_EQ(part.line_crossings.size(), 3u);

  const auto numbers = whole.join(below, part, 7);
  EXPECT_EQ(numbers.lines.back(), 5);
  EXPECT_EQ(whole.lines.size(), 6u);
  EXPECT_EQ(whole.lines[5].offset, 0.5);
  EXPECT_EQ(whole.line_crossings[id].lo, 0.3125);
  EXPECT_EQ(whole.line_crossings[id].hi, 0.375);
  EXPECT_EQ(whole.line_crossings[id].line, 4);
  ASSERT_EQ(whole.line_crossings.size(), 4u);
  EXPECT_EQ(whole.line_crossings[3].line, 5);
  EXPECT_EQ(numbers.line_crossings.back(), 3);
  ASSERT_EQ(whole.history.size(), 2u);
  EXPECT_EQ(whole.history[0].negative, 1);
  EXPECT_EQ(whole.history[1].line, 5);
  // A part that was not cut is one cell.
  Partition upper = given.partition();
  upper.begin(whole, above);
  whole.join(above, upper, 9);
  EXPECT_EQ(whole.history[0].positive, ~9);
  EXPECT_EQ(whole.history.size(), 2u);
}

}  // namespace
}  // namespace encase
