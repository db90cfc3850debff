// SPDX-License-Identifier: MIT
#include "encase/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "mutations.hpp"
#include "verified.hpp"

namespace encase {
namespace {

using namespace verified;

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
      e, [](auto& m) { m.input[0].function = {}; }, "Input curve 0");
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
      n, [](auto& m) { m.degenerate[0].kind = static_cast<Unresolved::Kind>(99); }, "valid kind");
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
