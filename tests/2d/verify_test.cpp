// SPDX-License-Identifier: MIT
#include "encase/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "hand_made_encasement.hpp"
#include "mutations.hpp"

namespace encase {
namespace {

using hand_made::polynomial;

const std::vector<Point<2>> kSquare{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

/// a x + b y + c
Polynomial<2> linear(const Rational& a, const Rational& b, const Rational& c) {
  return polynomial({{{1, 0}, a}, {{0, 1}, b}, {{0, 0}, c}});
}
/// x^2 + y^2 - r2
Polynomial<2> circle(const Rational& r2) {
  return polynomial({{{2, 0}, 1}, {{0, 2}, 1}, {{0, 0}, Rational(-r2)}});
}

/// Two lines that cross once, in one cell.
Encasement two_lines() {
  hand_made::Recipe recipe;
  recipe.curves = {linear(1, Rational(-1, 3), Rational(-1, 7)),
                   linear(1, Rational(1, 5), Rational(1, 9))};
  recipe.corners = kSquare;
  const double y = -(1.0 / 7 + 1.0 / 9) / (1.0 / 3 + 1.0 / 5);
  recipe.crossings = {{{0, 1}, {y / 3 + 1.0 / 7, y}}};
  return hand_made::build(recipe);
}

/// A circle of radius 3/4 and a line y = x/5 + 1/20 through it. The first cut leaves the circle's
/// centre, a critical region, in the left cell, where it needs a certificate; the second one makes
/// a T-junction at the right.
///
///     +---------+-----+
///     |         |  2  |
///     |    0    +-----+
///     |         |  1  |
///     +---------+-----+
Encasement circle_and_line() {
  hand_made::Recipe recipe;
  recipe.curves = {circle(Rational(9, 16)), linear(Rational(-1, 5), 1, Rational(-1, 20))};
  recipe.corners = kSquare;
  recipe.splitting_lines = {{1, 0, -0.375}, {0.125, 1, -0.875}};
  recipe.history = {{0, ~0, 1}, {1, ~1, ~2}};
  // 26/25 x^2 + x/50 + 1/400 - 9/16 = 0
  for (const double s : {1.0, -1.0}) {
    const double x = (-0.02 + s * std::sqrt(0.0004 + 4 * 1.04 * 0.56)) / 2.08;
    recipe.crossings.push_back({{0, 1}, {x, x / 5 + 0.05}});
  }
  return hand_made::build(recipe);
}

/// Two lines that do not meet, in one relaxed cell whose left and right edges are cut.
Encasement relaxed() {
  hand_made::Recipe recipe;
  recipe.curves = {linear(Rational(1, 7), 1, Rational(-1, 10)),
                   linear(Rational(1, 8), 1, Rational(1, 10))};
  recipe.corners = kSquare;
  Encasement e = hand_made::build(recipe);
  e.cells[0].state = CellState::Relaxed;
  return e;
}

/// A node at the origin, reported.
Encasement node() {
  hand_made::Recipe recipe;
  recipe.curves = {polynomial({{{2, 0}, 1}, {{0, 2}, -2}})};
  recipe.corners = kSquare;
  recipe.splitting_lines = {{1, 0, -0.25}, {1, 0, 0.25}, {0, 1, -0.0625}, {0, 1, 0.0625}};
  recipe.history = {{0, 1, 2}, {1, 3, ~0}, {2, ~1, ~2}, {3, ~3, ~4}};
  Unresolved singular;
  singular.kind = Unresolved::Kind::SingularPoint;
  singular.box = {{-0.125, -0.125}, {0.125, 0.125}};
  singular.has_box = true;
  singular.curves = {0};
  recipe.degenerate = {singular};
  return hand_made::build(recipe);
}

/// The diagonals of the square meet its corners, so that a larger polygon is used: the second line
/// crosses the diagonal x = y in the corner itself, the third beyond it.
Encasement diagonals() {
  hand_made::Recipe recipe;
  recipe.curves = {linear(1, -1, 0), linear(1, 1, -2)};
  recipe.asked_corners = kSquare;
  const double a = 1 + 0x1p-31, b = 1 + 0x1p-32;
  recipe.corners = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  recipe.crossings = {{{0, 1}, {1, 1}}};
  recipe.crossing_radius = 0x1p-40;
  Encasement e = hand_made::build(recipe);
  e.crossings[0].location = Location::OnBoundary;
  e.crossings[0].rounded = true;
  return e;
}

std::string text(const Verification& verification) {
  std::string all;
  for (const std::string& objection : verification.objections) all += objection + "\n";
  return all;
}

void expect_accepted(const Encasement& e) {
  const Verification verification = verify(e);
  EXPECT_TRUE(verification.ok()) << text(verification);
  EXPECT_GT(verification.claims, 0);
}

/// That the mutant is objected to, for a reason that `reason` is part of.
void expect_objection(const Encasement& mutant, const std::string& reason) {
  const Verification verification = verify(mutant);
  EXPECT_FALSE(verification.ok()) << "expected: " << reason;
  EXPECT_NE(text(verification).find(reason), std::string::npos)
      << "expected: " << reason << "\ngot: " << text(verification);
}

void expect_objection(Encasement e, const std::function<void(Encasement&)>& mutate,
                      const std::string& reason) {
  mutate(e);
  expect_objection(e, reason);
}

TEST(Verify, AcceptsTwoLinesInOneCell) { expect_accepted(two_lines()); }

TEST(Verify, AcceptsLoopCertificatesAndJunctions) {
  const Encasement e = circle_and_line();
  ASSERT_FALSE(e.cells[0].loop_certificates.empty());
  expect_accepted(e);
}

TEST(Verify, AcceptsARelaxedCellWithCutEdges) {
  const Encasement e = relaxed();
  ASSERT_EQ(e.cells[0].vertices.size(), 6u);
  expect_accepted(e);
}

TEST(Verify, AcceptsADegenerateCellAroundANode) {
  const Encasement e = node();
  ASSERT_EQ(e.cells[0].state, CellState::Degenerate);
  expect_accepted(e);
}

TEST(Verify, AcceptsALargerRegionWithACrossingOnTheBoundary) { expect_accepted(diagonals()); }

TEST(Verify, AcceptsAnEmptyListOfCurves) {
  hand_made::Recipe recipe;
  recipe.corners = kSquare;
  expect_accepted(hand_made::build(recipe));
}

TEST(Verify, ObjectsToAWrongPartition) {
  const Encasement e = circle_and_line();
  expect_objection(
      e,
      [](auto& m) {
        m.history.pop_back();
        m.history[0].positive = ~1;
      },
      "is not in the history");
  expect_objection(
      e, [](auto& m) { m.history.pop_back(); }, "bad line or child");
  expect_objection(
      e, [](auto& m) { m.history[1].positive = ~1; }, "has two places");
  expect_objection(
      e, [](auto& m) { m.history[1].positive = 0; }, "two parents or comes before");
  expect_objection(
      e, [](auto& m) { m.history[0].positive = 0; }, "two parents or comes before");
  expect_objection(
      e, [](auto& m) { m.history[1].line = m.history[0].line; }, "does not cut its polygon");
  expect_objection(
      e, [](auto& m) { m.lines[5].offset = 3; }, "does not cut its polygon");
  expect_objection(
      e, [](auto& m) { std::swap(m.history[1].negative, m.history[1].positive); }, "of cell 1");
  expect_objection(
      e, [](auto& m) { m.cells[1].depth = 1; }, "has depth 2");
  expect_objection(
      e, [](auto& m) { m.cells[2].vertices.pop_back(); }, "corners");
  expect_objection(
      e, [](auto& m) { m.cells[2].vertices[0].point[0] += 1e-9; }, "is not where its lines meet");
  expect_objection(
      e,
      [](auto& m) {
        std::rotate(m.cells[1].vertices.begin(), m.cells[1].vertices.begin() + 2,
                    m.cells[1].vertices.end());
      },
      "The word of cell 1");
  expect_objection(
      e,
      [](auto& m) {
        m.cells.clear();
        m.history.clear();
        m.crossings.clear();
      },
      "has a bad index");
  // A splitting line through the corner of the region.
  expect_objection(
      e,
      [](auto& m) {
        m.lines[5] = m.lines[4];
        m.lines[5].normal = {0, 1};
        m.lines[5].offset = -1;
      },
      "does not cut its polygon");
  expect_objection(
      relaxed(), [](auto& m) { m.cells[0].vertices[2].parameter += 0.5; },
      "does not follow its predecessor");
  expect_objection(
      e, [](auto& m) { m.history.push_back(m.history[1]); }, "cuts nothing");
  expect_objection(
      two_lines(),
      [](auto& m) {
        m.cells.clear();
        m.crossings[0].cell = -1;
      },
      "There are no cells");
}

TEST(Verify, ObjectsToAWrongRegion) {
  expect_objection(
      two_lines(), [](auto& m) { m.region.corners[0][0] = Rational(-11, 10); }, "does not contain");
  expect_objection(
      two_lines(), [](auto& m) { m.region.corners[0][0] = Rational(-9, 10); },
      "exceeds the region");
  expect_objection(
      two_lines(), [](auto& m) { std::swap(m.region_used.corners[0], m.region_used.corners[1]); },
      "convex");
  expect_objection(
      two_lines(), [](auto& m) { std::swap(m.lines[0], m.lines[1]); }, "is not side");
  expect_objection(
      diagonals(), [](auto& m) { m.crossings[0].location = Location::Inside; }, "location");
  expect_objection(
      diagonals(), [](auto& m) { m.crossings[0].location = Location::Outside; }, "location");
  expect_objection(
      diagonals(), [](auto& m) { m.region = m.region_used; }, "location");
  expect_objection(
      two_lines(), [](auto& m) { m.crossings[0].location = Location::OnBoundary; }, "location");
}

TEST(Verify, ObjectsToWrongLineCrossings) {
  const Encasement e = circle_and_line();
  const std::size_t n = e.line_crossings.size();
  for (std::size_t k = 0; k < n; ++k) {
    const LineCrossing c = e.line_crossings[k];
    const std::string name = "Line crossing " + std::to_string(k);
    expect_objection(
        e,
        [&](auto& m) {
          m.line_crossings[k].lo += 2 * (c.hi - c.lo);
          m.line_crossings[k].hi += 2 * (c.hi - c.lo);
        },
        name);
    expect_objection(
        e,
        [&](auto& m) {
          m.line_crossings[k].lo = c.hi;
          m.line_crossings[k].hi = c.lo;
        },
        name);
    expect_objection(
        e, [&](auto& m) { m.line_crossings[k].curve = 1 - c.curve; }, name);
    expect_objection(
        e, [&](auto& m) { m.line_crossings[k].line = (c.line + 1) % 6; }, "is not proved absent");
    // Dropped, with all that names it; others keep their indices by a copy of the last.
    expect_objection(
        e,
        [&](auto& m) {
          m.line_crossings[k] = m.line_crossings.back();
          m.line_crossings.pop_back();
          for (Cell& cell : m.cells) {
            std::erase(cell.word, static_cast<int>(k));
            std::erase_if(cell.branches, [&](const Branch& b) {
              return b.from == static_cast<int>(k) || b.to == static_cast<int>(k);
            });
            const auto rename = [&](int& id) {
              if (id == static_cast<int>(n) - 1) id = static_cast<int>(k);
            };
            for (int& id : cell.word) rename(id);
            for (Branch& b : cell.branches) {
              rename(b.from);
              rename(b.to);
            }
          }
        },
        "is not proved absent");
  }
  expect_objection(
      e, [](auto& m) { m.line_crossings.push_back(m.line_crossings[0]); }, "overlap");
  expect_objection(
      e,
      [](auto& m) {
        m.line_crossings.push_back({4, 0, 5.0, 5.5});
      },
      "lies on no edge");
}

TEST(Verify, ObjectsToIntervalsThatHoldCorners) {
  // Longer intervals with one root each, but of an order that is not proved.
  const Encasement e = circle_and_line();
  const auto widened = [&](int line, int curve, double hi) {
    Encasement mutant = e;
    for (LineCrossing& c : mutant.line_crossings)
      if (c.line == line && c.curve == curve && c.lo > 0) c.hi = hi;
    return mutant;
  };
  expect_accepted(widened(1, 1, 0.7));
  expect_objection(widened(1, 1, 0.8), "holds a corner");
  expect_objection(widened(1, 1, 1.5), "holds an end of its segment");
  expect_accepted(widened(4, 0, 0.8));
  expect_objection(widened(4, 0, 0.9), "holds a corner");
}

TEST(Verify, ObjectsToWhatUncertifiedCellsClaim) {
  expect_objection(
      node(), [](auto& m) { m.cells[0].branches.push_back(m.cells[1].branches[0]); },
      "is not certified but has branches");
  Encasement e = circle_and_line();
  e.outcome = Outcome::Undecided;
  for (Cell& cell : e.cells) {
    cell.state = CellState::Undecided;
    cell.branches.clear();
  }
  expect_accepted(e);
  expect_objection(
      e, [](auto& m) { std::swap(m.cells[0].crossing, m.cells[1].crossing); },
      "names a crossing that names another cell");
}

TEST(Verify, ObjectsToListsThatAreNotWellFormed) {
  const Encasement e = circle_and_line();
  expect_objection(
      e, [](auto& m) { m.perturbation = -1; }, "perturbation");
  expect_objection(
      e, [](auto& m) { m.input[0].polynomial = {}; }, "Input curve 0");
  expect_objection(
      e, [](auto& m) { m.region.corners.resize(2); }, "region is not a polygon");
  expect_objection(
      e, [](auto& m) { m.region_used.corners.resize(2); }, "used is not a polygon");
  expect_objection(
      e,
      [](auto& m) {
        m.region.corners[0] = {5, 5};
      },
      "The region is not a convex");
  expect_objection(
      e, [](auto& m) { m.cells[0].branches[0].from = -1; }, "A branch of cell 0");
  expect_objection(
      e, [](auto& m) { m.cells[0].crossing = 2; }, "a crossing that does not exist");
  expect_objection(
      e, [](auto& m) { m.cells[0].state = static_cast<CellState>(4); }, "valid state");
  expect_objection(
      e, [](auto& m) { m.crossings[0].location = static_cast<Location>(3); }, "valid location");
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].sign = Sign::Zero; }, "has no sign");
  expect_objection(
      e, [](auto& m) { m.region_used.corners.resize(7); }, "fewer lines than sides");
  expect_objection(
      e, [](auto& m) { m.crossings[0].point[0] = std::nan(""); }, "has a bad box or point");
  const Encasement n = node();
  expect_objection(
      n, [](auto& m) { m.degenerate[0].curves = {1}; }, "ascending indices of curves");
  expect_objection(
      n,
      [](auto& m) {
        m.degenerate[0].curves = {0, 0};
      },
      "ascending indices of curves");
  expect_objection(
      n, [](auto& m) { m.degenerate[0].box.lo[0] = std::nan(""); }, "has a bad box");
  expect_objection(
      n, [](auto& m) { m.degenerate[0].kind = static_cast<Unresolved::Kind>(7); }, "valid kind");
  expect_objection(
      n,
      [](auto& m) {
        m.undecided = m.degenerate;
        m.undecided[0].kind = Unresolved::Kind::SharedComponent;
      },
      "is listed as undecided");
  expect_objection(
      n, [](auto& m) { m.degenerate[0].kind = Unresolved::Kind::SharedComponent; },
      "a shared component that is not there");
}

TEST(Verify, ObjectsToAWrongWordOrBranch) {
  const Encasement e = circle_and_line();
  expect_objection(
      e, [](auto& m) { std::swap(m.cells[0].word[0], m.cells[0].word[1]); }, "The word of cell 0");
  expect_objection(
      e, [](auto& m) { m.cells[2].word = m.cells[1].word; }, "The word of cell 2");
  expect_objection(
      e, [](auto& m) { m.cells[1].word.pop_back(); }, "The word of cell 1");
  expect_objection(
      e,
      [](auto& m) {
        m.cells[1].word.clear();
        m.cells[1].branches.clear();
      },
      "The word of cell 1");
  expect_objection(
      e, [](auto& m) { m.cells[1].branches.pop_back(); }, "The branches of cell 1");
  expect_objection(
      e, [](auto& m) { m.cells[1].branches[0].to = m.cells[1].branches[1].to; },
      "The branches of cell 1");
  expect_objection(
      relaxed(),
      [](auto& m) {
        auto& vertices = m.cells[0].vertices;
        std::erase_if(vertices, [](const Vertex& v) { return v.line_in == v.line_out; });
      },
      "has several crossings");
}

TEST(Verify, ObjectsToAWrongCrossing) {
  const Encasement e = circle_and_line();
  for (std::size_t k : {0, 1}) {
    const std::string box = "The box of crossing " + std::to_string(k);
    expect_objection(
        e,
        [&](auto& m) {
          m.crossings[k].box.lo[0] += 1e-4;
          m.crossings[k].box.hi[0] += 1e-4;
          m.crossings[k].point = m.crossings[k].box.center();
        },
        box);
    // Widened past its cell, with both coordinates still isolating.
    expect_objection(
        e,
        [&](auto& m) {
          auto& b = m.crossings[k].box;
          (k == 0 ? b.lo[0] : b.hi[0]) = 0.3;
        },
        box);
    expect_objection(
        e,
        [&](auto& m) {
          m.crossings[k].box = {{-1, -1}, {1, 1}};
        },
        box);
    expect_objection(
        e, [&](auto& m) { m.crossings[k].cell = 2; }, "is not inside cell 2");
    expect_objection(
        e, [&](auto& m) { m.crossings[k].cell = -1; }, "meets the certified cell");
    expect_objection(
        e, [&](auto& m) { m.crossings[k].point[1] += 1; }, "is not in its box");
    expect_objection(
        e, [&](auto& m) { m.crossings[k].rounded = true; }, "correctly rounded");
    const auto cell = static_cast<std::size_t>(e.crossings[k].cell);
    expect_objection(
        e, [&](auto& m) { m.cells[cell].crossing = -1; }, "does not name the only");
    expect_objection(
        e, [&](auto& m) { m.cells[2].crossing = static_cast<int>(k); }, "Cell 2");
    // Dropped, with the links of its cell and the cover: its leaves are claimed to be empty.
    expect_objection(
        e,
        [&](auto& m) {
          m.crossings[k] = m.crossings.back();
          m.crossings.pop_back();
          m.cells[static_cast<std::size_t>(m.crossings[0].cell)].crossing = 0;
          m.cells[cell].crossing = -1;
          for (int& token : m.crossing_covers[0].tokens)
            if (token >= 0) token = token == static_cast<int>(k) ? cover::kExcluded : 0;
        },
        "is not proved free of crossings");
  }
  expect_objection(
      e, [](auto& m) { m.crossings.push_back(m.crossings[0]); }, "meet");
  // The point of a crossing at a double is known exactly, and its neighbours are not it.
  expect_objection(
      diagonals(), [](auto& m) { m.crossings[0].point[0] = 1 + 0x1p-52; }, "correctly rounded");
}

TEST(Verify, ProvesRoundingToTheLastBit) {
  Encasement e = two_lines();
  // x = y / 3 + 1 / 7 and x = -y / 5 - 1 / 9.
  const Rational y = -(Rational(1, 7) + Rational(1, 9)) / (Rational(1, 3) + Rational(1, 5));
  e.crossings[0].point = {nearest_double(y / 3 + Rational(1, 7)), nearest_double(y)};
  e.crossings[0].rounded = true;
  expect_accepted(e);
  for (std::size_t i : {0, 1})
    for (const double to : {-1.0, 1.0}) {
      Encasement mutant = e;
      mutant.crossings[0].point[i] = std::nextafter(e.crossings[0].point[i], to);
      expect_objection(mutant, "correctly rounded");
    }
}

TEST(Verify, ObjectsToEveryWrongLeaf) {
  // Every leaf of every cover claims something that is not true of another kind of leaf.
  const Encasement e = circle_and_line();
  const auto& tokens = e.crossing_covers[0].tokens;
  for (std::size_t t = 0; t < tokens.size(); ++t) {
    const auto with = [&](int token) {
      Encasement mutant = e;
      mutant.crossing_covers[0].tokens[t] = token;
      return verify(mutant).ok();
    };
    if (tokens[t] == cover::kSplitX || tokens[t] == cover::kSplitY) {
      EXPECT_FALSE(with(cover::kExcluded));
      continue;
    }
    EXPECT_FALSE(with(cover::kOutside));
    EXPECT_FALSE(with(cover::kUnresolved));
    EXPECT_FALSE(with(cover::kSplitX));
    EXPECT_FALSE(with(cover::kSplitZ));
    if (tokens[t] >= 0) {
      EXPECT_FALSE(with(1 - tokens[t]));
    }
  }
  // Leaves around a crossing cannot all be excluded.
  for (int k : {0, 1})
    expect_objection(
        e,
        [&](auto& m) {
          for (int& token : m.crossing_covers[0].tokens)
            if (token == k) token = cover::kExcluded;
        },
        "is not proved free of crossings");

  const auto& critical = e.critical_covers[0].tokens;
  for (std::size_t t = 0; t < critical.size(); ++t) {
    if (critical[t] < 0) continue;
    expect_objection(
        e, [&](auto& m) { m.critical_covers[0].tokens[t] = cover::kOutside; }, "is not outside");
  }
  expect_objection(
      e,
      [&](auto& m) {
        for (int& token : m.critical_covers[0].tokens)
          if (token >= 0) token = cover::kExcluded;
      },
      "is not proved free of critical points");
}

TEST(Verify, ObjectsToIncompleteCovers) {
  const Encasement e = circle_and_line();
  expect_objection(
      e, [](auto& m) { m.crossing_covers.clear(); }, "has no crossing cover");
  expect_objection(
      e, [](auto& m) { m.critical_covers.pop_back(); }, "has no critical cover");
  expect_objection(
      e, [](auto& m) { m.critical_covers[1] = m.critical_covers[0]; }, "has two critical covers");
  expect_objection(
      e, [](auto& m) { m.crossing_covers.push_back(m.crossing_covers[0]); },
      "have two crossing covers");
  expect_objection(
      e, [](auto& m) { m.crossing_covers[0].tokens.pop_back(); }, "ends before its last leaf");
  expect_objection(
      e, [](auto& m) { m.critical_covers[0].tokens.clear(); }, "ends before its last leaf");
  expect_objection(
      e, [](auto& m) { m.critical_covers[0].tokens.push_back(cover::kExcluded); }, "tokens left");
  expect_objection(
      e, [](auto& m) { m.crossing_covers[0].root.hi[0] = 0.99; }, "does not cover");
  expect_objection(
      e, [](auto& m) { m.crossing_covers[0].tokens.assign(5000, cover::kSplitX); },
      "that doubles cannot split");
}

/// A circle, two lines through it and a far small circle, with a shared cover.
Encasement four_curves() {
  const auto far = polynomial({{{2, 0}, 1},
                               {{0, 2}, 1},
                               {{1, 0}, Rational(-8, 5)},
                               {{0, 1}, Rational(-8, 5)},
                               {{0, 0}, Rational(32, 25) - Rational(1, 100)}});
  const std::vector<NamedCurve> curves{{"circle", circle(Rational(1, 4))},
                                       {"rising", linear(Rational(-1, 5), 1, Rational(-1, 20))},
                                       {"falling", linear(1, Rational(1, 3), Rational(1, 9))},
                                       {"far", far}};
  return encase(curves, make_region(-1, 1, -1, 1).value()).value();
}

TEST(Verify, AcceptsASharedCover) {
  const Encasement e = four_curves();
  ASSERT_FALSE(e.shared_cover.tokens.empty());
  ASSERT_LT(e.crossing_covers.size(), 6u);
  expect_accepted(e);
  // Covers of all pairs prove the same without it.
  Encasement plain = e;
  plain.shared_cover = {};
  expect_objection(plain, "does not cover the region used");
  expect_objection(plain, "Some pair of curves has no crossing cover");
}

TEST(Verify, ObjectsToAWrongSharedCover) {
  const Encasement e = four_curves();
  const std::size_t leaves = e.shared_cover.alive.size();
  ASSERT_GT(leaves, 3u);
  expect_objection(
      e, [](auto& m) { m.shared_cover.root.hi[0] = 0.99; }, "does not cover the region used");
  expect_objection(
      e, [](auto& m) { m.shared_cover.root.lo[1] = std::nan(""); }, "bad root or token");
  expect_objection(
      e, [](auto& m) { m.shared_cover.tokens.pop_back(); }, "bad root or token");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.tokens.pop_back();
        m.shared_cover.alive.pop_back();
      },
      "ends before its last leaf");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.tokens.push_back(static_cast<int>(m.shared_cover.alive.size()));
        m.shared_cover.alive.push_back({0, 1, 2, 3});
      },
      "tokens left");
  expect_objection(
      e, [](auto& m) { m.shared_cover.alive.push_back({}); }, "bad root or token");
  expect_objection(
      e, [](auto& m) { m.shared_cover.tokens.clear(); }, "bad root or token");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.alive[0] = {1, 0};
      },
      "ascending indices");
  expect_objection(
      e, [](auto& m) { m.shared_cover.alive[0] = {4}; }, "ascending indices");
  expect_objection(
      e, [](auto& m) { m.shared_cover.alive[0] = {-1}; }, "ascending indices");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.tokens.back() = cover::kUnresolved;
        m.shared_cover.alive.pop_back();
      },
      "is in no unresolved box of all curves");
  for (const int bad : {cover::kExcluded, cover::kUnresolved, cover::kSplitZ, 0, 1000000})
    for (std::size_t t = 1; t < e.shared_cover.tokens.size(); ++t) {
      if (e.shared_cover.tokens[t] == bad) continue;
      Encasement mutant = e;
      mutant.shared_cover.tokens[t] = bad;
      EXPECT_FALSE(verify(mutant).ok()) << t;
    }
  // A leaf in the region is not outside.
  for (std::size_t t = 1; t < e.shared_cover.tokens.size(); ++t) {
    if (e.shared_cover.tokens[t] < 0) continue;
    Encasement mutant = e;
    mutant.shared_cover.tokens[t] = cover::kOutside;
    mutant.shared_cover.alive.erase(mutant.shared_cover.alive.begin() + e.shared_cover.tokens[t]);
    for (int& token : mutant.shared_cover.tokens) token -= token > e.shared_cover.tokens[t];
    expect_objection(mutant, "is not outside the region used");
  }
}

TEST(Verify, ObjectsToCurvesThatAreSaidToBeAbsent) {
  const Encasement e = four_curves();
  // Every crossing lies in leaves in which both curves are alive: one of these without a curve is
  // wrong. The others are tried by the mutations.
  const auto leaf_boxes = [&] {
    std::vector<Box<2>> boxes, stack{e.shared_cover.root};
    for (const int token : e.shared_cover.tokens) {
      const Box<2> box = stack.back();
      stack.pop_back();
      if (token >= 0) boxes.push_back(box);
      if (token != cover::kSplitX && token != cover::kSplitY) continue;
      const int axis = cover::kSplitX - token;
      Box<2> lower = box, upper = box;
      lower.hi[axis] = upper.lo[axis] = box.center()[axis];
      stack.push_back(upper);
      stack.push_back(lower);
    }
    return boxes;
  }();
  ASSERT_EQ(leaf_boxes.size(), e.shared_cover.alive.size());
  int tried = 0;
  for (const Crossing& crossing : e.crossings)
    for (std::size_t k = 0; k < leaf_boxes.size(); ++k) {
      if (crossing.location == Location::Outside || !leaf_boxes[k].contains(crossing.box)) continue;
      for (const int curve : crossing.curves) {
        expect_objection(
            e, [&](auto& m) { std::erase(m.shared_cover.alive[k], curve); },
            "is not proved absent from leaf " + std::to_string(k));
        ++tried;
      }
    }
  EXPECT_GT(tried, 5);
}

TEST(Verify, ObjectsToCoversThatLeaveOutLeaves) {
  const Encasement e = four_curves();
  for (std::size_t k = 0; k < e.crossing_covers.size(); ++k) {
    expect_objection(
        e,
        [&](auto& m) {
          m.crossing_covers.erase(m.crossing_covers.begin() + static_cast<std::ptrdiff_t>(k));
        },
        "Some pair of curves has no crossing cover");
    for (const int axis : {0, 1})
      expect_objection(
          e,
          [&](auto& m) {
            Box<2>& root = m.crossing_covers[k].root;
            root.hi[axis] -= 0.5 * root.width(axis);
          },
          "Crossing cover " + std::to_string(k) + " does not cover the shared cover's leaves");
  }
  for (std::size_t k = 0; k < e.critical_covers.size(); ++k) {
    expect_objection(
        e,
        [&](auto& m) {
          m.critical_covers.erase(m.critical_covers.begin() + static_cast<std::ptrdiff_t>(k));
        },
        "Some curve has no critical cover");
    expect_objection(
        e,
        [&](auto& m) {
          Box<2>& root = m.critical_covers[k].root;
          root.lo[0] += 0.5 * root.width(0);
        },
        "Critical cover " + std::to_string(k) + " does not cover the shared cover's leaves");
  }
  // Curves that are alive in one leaf more meet others there.
  expect_objection(
      e,
      [](auto& m) {
        for (auto& alive : m.shared_cover.alive) alive = {0, 1, 2, 3};
      },
      "Some pair of curves has no crossing cover");
}

TEST(Verify, ObjectsToMissingLineCrossingsBesideASharedCover) {
  // Only curves that the shared cover leaves near are looked for on a line: all that are there.
  const Encasement e = four_curves();
  for (std::size_t k = 0; k < e.line_crossings.size(); ++k)
    expect_objection(
        e, [&](auto& m) { m.line_crossings[k].line = (m.line_crossings[k].line + 1) % 4; },
        "is not proved absent");
}

TEST(Verify, ObjectsToRandomMutationsOfASharedCover) {
  const Encasement e = four_curves();
  mutations::Mutator mutator(3);
  for (int round = 0; round < 1000; ++round) {
    Encasement mutant = e;
    const mutations::Mutation mutation =
        round % 2 == 0 ? mutator.change_shared_cover(mutant) : mutator.apply(mutant);
    const Verification verification = verify(mutant);
    EXPECT_TRUE(mutation.may_hold || !verification.ok()) << mutation.what;
  }
}

TEST(Verify, ObjectsToWrongCriticalRegions) {
  const Encasement e = circle_and_line();
  ASSERT_EQ(e.critical_regions.size(), 1u);
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].sign = Sign::Positive; }, "sign");
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].sign = Sign::Zero; }, "sign");
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].curve = 1; }, "another curve");
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].boxes.pop_back(); },
      "is not a box of its critical region");
  expect_objection(
      e,
      [](auto& m) {
        m.critical_regions[0].boxes.push_back({{.9, .9}, {1, 1}});
      },
      "sign");
  expect_objection(
      e,
      [](auto& m) {
        m.critical_regions[0].boxes.push_back({{.6, .1}, {.61, .11}});
      },
      "do not hang together");
}

TEST(Verify, ObjectsToWrongLoopCertificates) {
  const Encasement e = circle_and_line();
  expect_objection(
      e, [](auto& m) { m.cells[0].loop_certificates.clear(); }, "has no certificate");
  const auto with = [&](const Point<2>& from, const Point<2>& to) {
    Encasement mutant = e;
    mutant.cells[0].loop_certificates[0].from = from;
    mutant.cells[0].loop_certificates[0].to = to;
    return mutant;
  };
  const Point<2> from = e.cells[0].loop_certificates[0].from;
  expect_accepted(with(from, {0.375, 0}));                   // just on the cell's edge
  expect_objection(with(from, {0.37, 0}), "does not hold");  // still inside
  expect_objection(with(from, {0.8, 0}), "does not hold");   // through the circle
  expect_objection(with(from, {-2, 0}), "does not hold");
  expect_objection(with({0.7, 0}, {0.7, 0.01}), "does not hold");  // not from the region
}

TEST(Verify, ObjectsToWrongStates) {
  const Encasement e = circle_and_line();
  for (std::size_t i : {0, 1, 2})
    for (const CellState state : {CellState::Relaxed, CellState::Degenerate, CellState::Undecided})
      EXPECT_FALSE([&] {
        Encasement m = e;
        m.cells[i].state = state;
        return verify(m).ok();
      }());
  expect_objection(
      relaxed(), [](auto& m) { m.cells[0].state = CellState::Certified; }, "is not relaxed");
  for (const Outcome outcome : {Outcome::Degenerate, Outcome::Undecided})
    expect_objection(
        e, [&](auto& m) { m.outcome = outcome; }, "The outcome should be certified");
  const Encasement n = node();
  expect_objection(
      n, [](auto& m) { m.outcome = Outcome::Certified; }, "The outcome should be degenerate");
  expect_objection(
      n, [](auto& m) { m.cells[0].state = CellState::Certified; }, "cell 0");
  expect_objection(
      n, [](auto& m) { m.cells[1].state = CellState::Degenerate; }, "meets no degenerate box");
  expect_objection(
      n, [](auto& m) { m.degenerate.clear(); }, "unresolved box");
  expect_objection(
      n, [](auto& m) { m.degenerate[0].curves.clear(); }, "unresolved box");
  expect_objection(
      n, [](auto& m) { m.degenerate[0].box.lo[0] = -0.3; }, "meets the box");
  expect_objection(
      n, [](auto& m) { m.degenerate[0].box.lo[0] = 0; }, "unresolved box");
  expect_objection(
      n, [](auto& m) { m.degenerate[0].proved = true; }, "there is no proof");
  // Undecided instead: as good a reason, but another outcome.
  Encasement undecided = n;
  std::swap(undecided.degenerate, undecided.undecided);
  undecided.cells[0].state = CellState::Undecided;
  undecided.outcome = Outcome::Undecided;
  expect_accepted(undecided);
}

TEST(Verify, ObjectsToOtherCurves) {
  const Encasement e = circle_and_line();
  const auto nudged = linear(Rational(-1, 5), 1, Rational(-1, 20) + Rational(1, 1000000000));
  expect_objection(
      e, [&](auto& m) { m.curves[1].polynomial = nudged; }, "input curve 1");
  expect_objection(
      e, [&](auto& m) { m.input[1].polynomial = nudged; }, "input curve 1");
  const auto moved = linear(Rational(-1, 5), 1, Rational(-1, 10));
  expect_objection(
      e, [&](auto& m) { m.curves[1].polynomial = m.input[1].polynomial = moved; }, "Line crossing");
  expect_objection(
      e, [](auto& m) { std::swap(m.curves[0].polynomial, m.curves[1].polynomial); },
      "components that its sources say");
  expect_objection(
      e, [](auto& m) { m.input.pop_back(); }, "does not name ascending");
  expect_objection(
      e, [](auto& m) { m.curves[1].polynomial = {}; }, "degree 1 to");
  expect_objection(
      e, [](auto& m) { m.curves[1].polynomial = Polynomial<2>::constant(3); }, "degree 1 to");
  expect_objection(
      e,
      [](auto& m) {
        m.input[0].polynomial = m.curves[0].polynomial = Polynomial<2>::variable(0).power(61);
      },
      "degree 1 to");
  expect_objection(
      e, [](auto& m) { m.curves[1].sources = {0}; }, "");
  // A constant factor is no other curve.
  Encasement scaled = e;
  scaled.input[1].polynomial =
      scaled.input[1].polynomial * Polynomial<2>::constant(Rational(-7, 3));
  expect_accepted(scaled);
}

TEST(Verify, TracksSharedAndRepeatedComponents) {
  // Input circle^2 line and line, encased as circle and line.
  Encasement e = circle_and_line();
  const auto c = e.curves[0].polynomial, l = e.curves[1].polynomial;
  e.input[0].polynomial = c * c * l;
  e.curves[1].sources = {0, 1};
  e.outcome = Outcome::Degenerate;
  Unresolved repeated, shared;
  repeated.kind = Unresolved::Kind::RepeatedComponent;
  repeated.curves = {0};
  repeated.proved = true;
  shared.kind = Unresolved::Kind::SharedComponent;
  shared.curves = {0, 1};
  shared.proved = true;
  e.degenerate = {repeated, shared};
  expect_accepted(e);
  expect_objection(
      e, [](auto& m) { m.degenerate.pop_back(); }, "share is not reported");
  expect_objection(
      e, [](auto& m) { m.degenerate.erase(m.degenerate.begin()); },
      "repeated component of input curve 0 is not reported");
  expect_objection(
      e,
      [](auto& m) {
        m.degenerate[0].curves = {0, 1};
      },
      "a repeated component that is not there");
  expect_objection(
      e, [&](auto& m) { m.input[0].polynomial = c * l; }, "a repeated component that is not there");
  expect_objection(
      e, [&](auto& m) { m.input[0].polynomial = c * c; }, "components that its sources say");
  expect_objection(
      e, [&](auto& m) { m.input[0].polynomial = c * c * l * linear(1, 1, 9); }, "is in no curve");
  expect_objection(
      e, [](auto& m) { m.curves[1].sources = {1}; }, "components that its sources say");
  expect_objection(
      e, [&](auto& m) { m.curves[0].polynomial = c * c; }, "has a repeated component");
  expect_objection(
      e, [&](auto& m) { m.curves[0].polynomial = c * l; }, "share a component");
}

TEST(Verify, SurvivesIndicesOutOfRangeAndNumbersThatAreNone) {
  const Encasement e = circle_and_line();
  for (const int bad :
       {-1, -7, 1000, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    const std::vector<std::function<void(Encasement&)>> mutations{
        [&](auto& m) { m.line_crossings[0].line = bad; },
        [&](auto& m) { m.line_crossings[0].curve = bad; },
        [&](auto& m) { m.crossings[0].curves[0] = bad; },
        [&](auto& m) { m.crossings[0].curves[1] = bad; },
        [&](auto& m) { m.crossings[0].cell = bad; },
        [&](auto& m) { m.cells[0].vertices[0].line_in = bad; },
        [&](auto& m) { m.cells[0].vertices[0].line_out = bad; },
        [&](auto& m) { m.cells[0].word[0] = bad; },
        [&](auto& m) { m.cells[0].branches[0].curve = bad; },
        [&](auto& m) { m.cells[0].branches[0].from = bad; },
        [&](auto& m) { m.cells[0].branches[0].to = bad; },
        [&](auto& m) { m.cells[0].crossing = bad; },
        [&](auto& m) { m.cells[0].loop_certificates[0].critical_region = bad; },
        [&](auto& m) { m.cells[0].depth = bad; },
        [&](auto& m) { m.cells[0].state = static_cast<CellState>(bad); },
        [&](auto& m) { m.history[0].line = bad; },
        [&](auto& m) { m.history[1].negative = bad; },
        [&](auto& m) { m.history[0].positive = bad; },
        [&](auto& m) { m.crossing_covers[0].curves[0] = bad; },
        [&](auto& m) { m.crossing_covers[0].curves[1] = bad; },
        [&](auto& m) { m.crossing_covers[0].tokens.back() = bad; },
        [&](auto& m) { m.critical_covers[0].curve = bad; },
        [&](auto& m) { m.critical_covers[0].tokens.back() = bad; },
        [&](auto& m) { m.critical_regions[0].curve = bad; },
        [&](auto& m) { m.critical_regions[0].sign = static_cast<Sign>(bad == -1 ? 0 : 7); },
        [&](auto& m) { m.curves[0].sources[0] = bad; },
        [&](auto& m) { m.outcome = static_cast<Outcome>(bad); },
        [&](auto& m) { m.crossings[0].location = static_cast<Location>(bad); },
    };
    for (std::size_t k = 0; k < mutations.size(); ++k) {
      Encasement mutant = e;
      mutations[k](mutant);
      EXPECT_FALSE(verify(mutant).ok()) << "mutation " << k << " with " << bad;
    }
  }
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity, 1e308, -1e308}) {
    const std::vector<std::function<void(Encasement&)>> mutations{
        [&](auto& m) { m.lines[4].normal[0] = bad; },
        [&](auto& m) { m.lines[4].offset = bad; },
        [&](auto& m) { m.lines[0].normal[1] = bad; },
        [&](auto& m) { m.line_crossings[0].lo = bad; },
        [&](auto& m) { m.line_crossings[0].hi = bad; },
        [&](auto& m) { m.crossings[0].box.lo[0] = bad; },
        [&](auto& m) { m.crossings[0].box.hi[1] = bad; },
        [&](auto& m) { m.crossings[0].point[0] = bad; },
        [&](auto& m) { m.cells[0].vertices[0].point[0] = bad; },
        [&](auto& m) { m.cells[0].loop_certificates[0].from[0] = bad; },
        [&](auto& m) { m.cells[0].loop_certificates[0].to[1] = bad; },
        [&](auto& m) { m.crossing_covers[0].root.hi[0] = bad; },
        [&](auto& m) { m.critical_covers[0].root.hi[1] = bad; },
        [&](auto& m) { m.critical_regions[0].boxes[0].lo[0] = bad; },
        [&](auto& m) { m.critical_regions[0].boxes[0].hi[0] = bad; },
    };
    for (std::size_t k = 0; k < mutations.size(); ++k) {
      Encasement mutant = e;
      mutations[k](mutant);
      EXPECT_FALSE(verify(mutant).ok()) << "mutation " << k << " with " << bad;
    }
  }
}

TEST(Verify, StopsAtTheLimitOfObjections) {
  Encasement e = circle_and_line();
  for (LineCrossing& c : e.line_crossings) c.line = -1;
  EXPECT_EQ(verify(e, {848, 3}).objections.size(), 3u);
  // No limit makes a wrong result right.
  EXPECT_FALSE(verify(e, {848, 0}).ok());
}

TEST(Verify, ObjectsToRandomMutations) {
  const Encasement e = circle_and_line();
  mutations::Mutator mutator(1);
  for (int round = 0; round < 2000; ++round) {
    Encasement mutant = e;
    const mutations::Mutation mutation = mutator.apply(mutant);
    const Verification verification = verify(mutant);
    EXPECT_TRUE(mutation.may_hold || !verification.ok()) << mutation.what;
  }
}

TEST(Verify, SurvivesRandomCorruption) {
  const Encasement e = circle_and_line();
  mutations::Mutator mutator(2);
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    Encasement mutant = e;
    mutator.corrupt(mutant, 1 + round % 3);
    refused += !verify(mutant).ok();
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace encase
