// SPDX-License-Identifier: MIT
#include "encase/arrangement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/random_polynomials.hpp"
#include "common/segments.hpp"
#include "tests/encased.hpp"
#include "tests/located_points.hpp"
#include "tests/mutations.hpp"
#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

using encased::rectangle;
using encased::run;
using Feature = Arrangement::Feature;
using located_points::arranged;
using located_points::count;
using located_points::exact_sign;
using located_points::exactly;
using located_points::expect_locates;
using located_points::expect_right;
using located_points::mixed_curves;

struct Counts {
  int vertices, edges, faces, components;
  bool operator==(const Counts&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.vertices << " vertices, " << c.edges << " edges, " << c.faces << " faces, "
             << c.components << " components";
}

/// Without the region's corners, its sides taken as one closed edge if no curve meets them, and
/// without the outside.
Counts counts(const Arrangement& a) {
  int corners = 0;
  for (const auto& v : a.vertices) corners += v.kind == Arrangement::Vertex::Kind::Corner;
  return {static_cast<int>(a.vertices.size()) - corners, static_cast<int>(a.edges.size()) - corners,
          static_cast<int>(a.faces.size()) - 1, static_cast<int>(a.components.size())};
}

Encasement permuted(Encasement e, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> place(e.cells.size());
  for (std::size_t k = 0; k < place.size(); ++k) place[k] = static_cast<int>(k);
  std::shuffle(place.begin(), place.end(), random);
  std::vector<Cell> cells(e.cells.size());
  for (std::size_t k = 0; k < place.size(); ++k) cells[place[k]] = e.cells[k];
  for (Crossing& c : e.crossings)
    if (c.cell >= 0) c.cell = place[c.cell];
  for (Split& s : e.history)
    for (int* child : {&s.negative, &s.positive})
      if (*child < 0) *child = ~place[~*child];
  std::vector<int> line_place(e.line_crossings.size());
  for (std::size_t k = 0; k < line_place.size(); ++k) line_place[k] = static_cast<int>(k);
  std::shuffle(line_place.begin(), line_place.end(), random);
  std::vector<LineCrossing> line_crossings(e.line_crossings.size());
  for (std::size_t k = 0; k < line_place.size(); ++k)
    line_crossings[line_place[k]] = e.line_crossings[k];
  e.line_crossings = line_crossings;
  for (Cell& cell : cells) {
    for (int& c : cell.word) c = line_place[c];
    for (Branch& b : cell.branches) {
      b.from = line_place[b.from];
      b.to = line_place[b.to];
      if (random() % 2 == 0) std::swap(b.from, b.to);
    }
    if (cell.branches.size() == 2 && random() % 2 == 0)
      std::swap(cell.branches[0], cell.branches[1]);
  }
  e.cells = cells;
  return e;
}

TEST(Arrange, DividesNothingByNoCurve) {
  const Encasement e = run({"x - 5"});
  const Arrangement a = arranged(e);
  EXPECT_EQ(counts(a), (Counts{0, 0, 1, 1}));
  EXPECT_EQ(a.faces[1].signs, std::vector<Sign>{Sign::Negative});
}

TEST(Arrange, DividesTheRegionByACircle) {
  const Encasement e = run({"x^2 + y^2 - 1/2"});
  const Arrangement a = arranged(e);
  EXPECT_EQ(counts(a), (Counts{0, 1, 2, 2}));
  ASSERT_EQ(a.curve_components.size(), 1u);
  EXPECT_TRUE(a.curve_components[0].closed);
  EXPECT_TRUE(a.curve_components[0].crossings.empty());
  const PointLocator locator(e, a);
  const Feature inner = locator.locate(Point<2>{0.1, 0.2}),
                outer = locator.locate(Point<2>{0.9, -0.9});
  ASSERT_EQ(inner.kind, Feature::Kind::Face);
  ASSERT_EQ(outer.kind, Feature::Kind::Face);
  EXPECT_EQ(a.faces[inner.index].signs, std::vector<Sign>{Sign::Negative});
  EXPECT_EQ(a.faces[outer.index].signs, std::vector<Sign>{Sign::Positive});
  EXPECT_EQ(a.faces[inner.index].parent, outer.index);
  EXPECT_EQ(a.faces[outer.index].parent, a.outside);
  EXPECT_EQ(a.faces[outer.index].holes.size(), 1u);
  EXPECT_EQ(locator.locate(Point<2>{0.5, 0.5}).kind, Feature::Kind::Edge);
  EXPECT_EQ(locator.locate(Point<2>{-0.5, 0.5}), locator.locate(Point<2>{0.5, -0.5}));
  EXPECT_EQ(locator.locate(Point<2>{2, 0}), (Feature{Feature::Kind::Face, a.outside}));
}

TEST(Arrange, KnowsTheFourFacesOfTwoCircles) {
  const Encasement e = run({"(x + 1/4)^2 + y^2 - 1/4", "(x - 1/4)^2 + y^2 - 1/4"});
  const Arrangement a = arranged(e);
  EXPECT_EQ(counts(a), (Counts{2, 4, 4, 2}));
  const std::vector<int> crossings = a.crossings_of(1, 0);
  ASSERT_EQ(crossings.size(), 2u);
  for (const int v : crossings) {
    const std::vector<int> faces = a.faces_around(v);
    EXPECT_EQ(std::set<int>(faces.begin(), faces.end()).size(), 4u);
  }
  for (const auto& c : a.curve_components) EXPECT_EQ(c.crossings.size(), 2u);
  expect_locates(e, a, 500, 1);
}

TEST(Arrange, NestsCircles) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "x^2 + y^2 - 1/8", "x^2 + (y - 1/50)^2 - 1/30",
                            "(x - 9/10)^2 + (y - 9/10)^2 - 1/400"});
  const Arrangement a = arranged(e);
  EXPECT_EQ(counts(a), (Counts{0, 4, 5, 5}));
  const PointLocator locator(e, a);
  std::vector<int> chain;
  for (int f = locator.locate(Point<2>{0, 0}).index; f != a.outside; f = a.faces[f].parent)
    chain.push_back(f);
  EXPECT_EQ(chain.size(), 4u);
  const int small = locator.locate(Point<2>{0.9, 0.9}).index;
  EXPECT_EQ(a.faces[small].parent, chain.back());
  EXPECT_EQ(a.faces[chain.back()].holes.size(), 2u);
  expect_locates(e, a, 500, 2);
}

TEST(Arrange, CutsACircleByALine) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20"});
  const Arrangement a = arranged(e);
  // Two crossings, two ends of the line.
  EXPECT_EQ(counts(a), (Counts{4, 7, 4, 1}));
  ASSERT_EQ(a.curve_components.size(), 2u);
  EXPECT_TRUE(a.curve_components[0].closed);
  EXPECT_FALSE(a.curve_components[1].closed);
  EXPECT_EQ(a.curve_components[1].half_edges.size(), 3u);
  expect_locates(e, a, 500, 3);
}

TEST(Arrange, ReadsAnEncasementMadeByHand) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arranged(e);
  EXPECT_EQ(counts(a), (Counts{4, 7, 4, 1}));
  EXPECT_EQ(canonical_topology(a),
            canonical_topology(arranged(run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20"}))));
  expect_locates(e, a, 1000, 4);
}

TEST(Arrange, CountsTheFacesOfThreeLines) {
  const Encasement e = run({"y - x/3", "y + x/2", "x - 1/2"});
  const Arrangement a = arranged(e);
  // Three crossings, six ends; nine edges and six pieces of the boundary.
  EXPECT_EQ(counts(a), (Counts{9, 15, 7, 1}));
  const PointLocator locator(e, a);
  const Feature origin = locator.locate(Point<2>{0, 0});
  ASSERT_EQ(origin.kind, Feature::Kind::Vertex);
  EXPECT_EQ(a.crossings_of(0, 1), std::vector<int>{origin.index});
  const Feature third = locator.locate(RationalPoint<2>{Rational(1, 2), Rational(1, 6)});
  ASSERT_EQ(third.kind, Feature::Kind::Vertex);
  EXPECT_EQ(a.crossings_of(0, 2), std::vector<int>{third.index});
  EXPECT_EQ(locator.locate(Point<2>{0.5, 1. / 6}).kind, Feature::Kind::Edge);
  EXPECT_EQ(locator.locate(RationalPoint<2>{Rational(1, 10), Rational(1, 30)}).kind,
            Feature::Kind::Edge);
  expect_locates(e, a, 1000, 5);
}

TEST(Arrange, HoldsTheTwoOvalsOfCassiniApart) {
  const Encasement e = run({"(x^2 + y^2)^2 - 2*(x^2 - y^2) + 1/5"}, rectangle(-2, 2, -2, 2));
  const Arrangement a = arranged(e);
  EXPECT_EQ(counts(a), (Counts{0, 2, 3, 3}));
  EXPECT_EQ(a.curve_components.size(), 2u);
  const PointLocator locator(e, a);
  const Feature left = locator.locate(Point<2>{-1, 0}), right = locator.locate(Point<2>{1, 0});
  EXPECT_NE(left, right);
  EXPECT_EQ(a.faces[left.index].signs, a.faces[right.index].signs);
  expect_locates(e, a, 500, 6);
}

TEST(Arrange, FollowsCurvesThroughTheBoundary) {
  // A circle that leaves by the right and the upper side, and a parabola that crosses it.
  const Encasement e = run({"(x - 1/2)^2 + (y - 1/2)^2 - 2/5", "y - x^2 + 1/3"});
  const Arrangement a = arranged(e);
  EXPECT_EQ(count(a, Arrangement::Vertex::Kind::Corner), 4);
  for (const auto& c : a.curve_components) EXPECT_FALSE(c.closed);
  const PointLocator locator(e, a);
  for (int k = 0; k < 4; ++k) {
    const Feature corner = locator.locate(e.region_used.corners[k]);
    ASSERT_EQ(corner.kind, Feature::Kind::Vertex);
    EXPECT_EQ(a.vertices[corner.index].index, k);
  }
  const Feature bottom = locator.locate(Point<2>{0, -1});
  ASSERT_EQ(bottom.kind, Feature::Kind::Edge);
  EXPECT_EQ(a.edges[bottom.index].side, 0);
  expect_locates(e, a, 1000, 7);
}

TEST(Arrange, FindsPointsWhereACurveMeetsTheBoundary) {
  const Encasement e = run({"y - x/2", "y + x^2 - 1/4"});
  const Arrangement a = arranged(e);
  ASSERT_EQ(e.region.corners, e.region_used.corners);
  const PointLocator locator(e, a);
  for (const Point<2>& p : {Point<2>{1, 0.5}, {-1, -0.5}, {1, -0.75}}) {
    const Feature feature = locator.locate(p);
    ASSERT_EQ(feature.kind, Feature::Kind::Vertex);
    EXPECT_EQ(a.vertices[feature.index].kind, Arrangement::Vertex::Kind::OnBoundary);
  }
  EXPECT_EQ(locator.locate(Point<2>{1, 0.25}).kind, Feature::Kind::Edge);
  EXPECT_NE(locator.locate(Point<2>{1, 0.25}), locator.locate(Point<2>{1, 0.75}));
  expect_locates(e, a, 1000, 8);
}

TEST(Arrange, UsesRelaxedCells) {
  EncaseOptions options;
  options.relaxed = true;
  const std::vector<std::string> texts = {"y - x^2/10", "y - x^2/10 - 1/1000", "x + y/7"};
  const Encasement relaxed = run(texts, encased::square(), options);
  EXPECT_GT(encased::count(relaxed, CellState::Relaxed), 0);
  const Arrangement a = arranged(relaxed);
  EXPECT_EQ(counts(a), (Counts{8, 13, 6, 1}));
  EXPECT_EQ(canonical_topology(a), canonical_topology(arranged(run(texts))));
  const PointLocator locator(relaxed, a);
  std::set<int> faces;
  for (const double y : {0.02, 0.0255, 0.03})
    for (const double x : {0.5, -0.5}) faces.insert(locator.locate(Point<2>{x, y}).index);
  EXPECT_EQ(faces.size(), 6u);
  expect_locates(relaxed, a, 1000, 9);
}

TEST(Arrange, IsThatOfTheRegionUsed) {
  // The curves pass through a corner and touch a side.
  const Encasement e = run({"y - x", "x^2 + y^2 - 1"});
  const Arrangement a = arranged(e);
  EXPECT_NE(e.region.corners, e.region_used.corners);
  expect_locates(e, a, 300, 10);
}

TEST(Arrange, RefusesWhatIsNotCertified) {
  const auto code = [](const std::vector<std::string>& texts, const EncaseOptions& options) {
    const auto result = arrange(run(texts, encased::square(), options));
    EXPECT_FALSE(result.ok());
    return result.ok() ? Error::Code::Internal : result.error().code;
  };
  EXPECT_EQ(code({"x^2 + y^2 - 1/4", "x - 1/2"}, {}), Error::Code::Degenerate);
  EncaseOptions few;
  few.max_cells = 2;
  EXPECT_EQ(code({"x^2 + y^2 - 1/4", "3*x^2 + y^2/2 - 1/4"}, few), Error::Code::Undecided);
}

TEST(Arrange, NoticesPartsThatDoNotFit) {
  const Encasement good = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20"});
  const auto refused = [&](auto&& spoil) {
    Encasement e = good;
    spoil(e);
    const auto result = arrange(e);
    return !result.ok() && result.error().code == Error::Code::Internal;
  };
  EXPECT_TRUE(refused([](Encasement& e) { e.cells[0].word.push_back(0); }));
  EXPECT_TRUE(refused([](Encasement& e) { e.cells[0].vertices[0].line_in = 1000; }));
  EXPECT_TRUE(refused([](Encasement& e) { e.history.pop_back(); }));
  EXPECT_TRUE(refused([](Encasement& e) { e.history.back().negative = 0; }));
  EXPECT_TRUE(refused([](Encasement& e) { e.line_crossings.push_back({4, 0, 5, 6}); }));
  EXPECT_TRUE(refused([](Encasement& e) {
    for (Cell& cell : e.cells) cell.crossing = -1;
  }));
}

TEST(Arrange, SurvivesWhatIsCorrupt) {
  const Encasement good = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20", "x*y - 1/5"});
  mutations::Mutator mutator(3);
  int refused = 0;
  for (int k = 0; k < 3000; ++k) {
    Encasement e = good;
    if (k % 2 == 0)
      mutator.apply(e);
    else
      mutator.corrupt(e, 1 + k % 5);
    const auto result = arrange(e);
    refused += !result.ok();
    if (result) {
      EXPECT_EQ(check(result.value()), "");
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(Arrange, SatisfiesEulerOnRandomCurves) {
  for (int number = 2; number <= 8; ++number)
    for (const std::uint64_t seed : {1, 2}) {
      const Encasement e = encased::run_curves(mixed_curves(number, seed));
      const Arrangement a = arranged(e);
      EXPECT_EQ(encased::inside(e), count(a, Arrangement::Vertex::Kind::Crossing));
      int crossings = 0;
      for (int i = 0; i < number; ++i)
        for (int j = i + 1; j < number; ++j)
          crossings += static_cast<int>(a.crossings_of(i, j).size());
      EXPECT_EQ(encased::inside(e), crossings);
      expect_locates(e, a, 1000, static_cast<unsigned>(number));
    }
}

TEST(CanonicalTopology, IsThatOfTheInput) {
  std::set<std::string> different;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto curves = mixed_curves(5, seed);
    const Encasement e = encased::run_curves(curves);
    const std::string text = canonical_topology(arranged(e));
    EXPECT_TRUE(different.insert(text).second);
    for (const unsigned order : {1u, 2u})
      EXPECT_EQ(canonical_topology(arranged(permuted(e, order))), text);
    EncaseOptions options;
    options.fast = true;
    EXPECT_EQ(canonical_topology(arranged(encased::run_curves(curves, encased::square(), options))),
              text);
    options.fast = false;
    options.relaxed = true;
    EXPECT_EQ(canonical_topology(arranged(encased::run_curves(curves, encased::square(), options))),
              text);
  }
}

TEST(CanonicalTopology, TellsWhereLoopsLie) {
  const std::string big = "x^2 + y^2 - 1/4";
  const auto text = [&](const std::vector<std::string>& texts) {
    return canonical_topology(arranged(run(texts)));
  };
  const std::string inside = text({big, "x^2 + y^2 - 1/16"});
  EXPECT_NE(inside, text({big, "(x - 3/4)^2 + y^2 - 1/100"}));
  EXPECT_EQ(inside, text({big, "(x - 1/10)^2 + y^2 - 1/100"}));
  EXPECT_NE(inside, text({"x^2 + y^2 - 1/16", big}));
  EXPECT_NE(inside, text({big, "1/16 - x^2 - y^2"}));
  // Two small loops on the same side of a line, or on different sides.
  const std::string line = "y - x/9 - 1/100";
  EXPECT_NE(text({line, "x^2 + (y - 1/2)^2 - 1/50", "x^2 + (y + 1/2)^2 - 1/40"}),
            text({line, "x^2 + (y - 1/2)^2 - 1/50", "(x - 1/2)^2 + (y - 1/2)^2 - 1/40"}));
  // Mirror images: three circles with a common part, in their order around it.
  const std::string first = "x^2 + (y - 1/4)^2 - 1/9", left = "(x + 1/5)^2 + y^2 - 1/9",
                    right = "(x - 1/5)^2 + y^2 - 1/9";
  EXPECT_NE(text({first, left, right}), text({first, right, left}));
  EXPECT_EQ(text({first, left, right}),
            text({right, "(x + 1/10)^2 + (y - 1/8)^2 - 1/9", "(x + 1/20)^2 + (y + 1/4)^2 - 1/9"}));
}

TEST(CheckArrangement, ObjectsToWhatIsWrong) {
  const Arrangement good =
      arranged(run({"(x + 1/4)^2 + y^2 - 1/4", "(x - 1/4)^2 + y^2 - 1/4", "y - x/3 - 1/9"}));
  const auto wrong = [&](auto&& spoil) {
    Arrangement a = good;
    spoil(a);
    return !check(a).empty();
  };
  EXPECT_FALSE(wrong([](Arrangement&) {}));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.half_edges[0].next = a.half_edges[0].prev; }));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.half_edges[3].face = 0; }));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.half_edges[3].origin ^= 1; }));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.faces[1].signs[0] = -a.faces[1].signs[0]; }));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.faces.emplace_back(); }));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.components.pop_back(); }));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.curve_components.pop_back(); }));
  EXPECT_TRUE(wrong([](Arrangement& a) { a.edges[0].curve = 2 - a.edges[0].curve; }));
}

TEST(Arrangement, RoundsTheEndsOfCurvesOnTheBoundary) {
  // Ends at thirds, at doubles, at irrational numbers and at zero.
  const Encasement e =
      run({"y - 3 x", "x + y^3 - 1/2", "y - (x + 1) / 2"}, rectangle(-1, 2, -1, 1));
  const Arrangement a = arranged(e);
  int ends = 0;
  for (const Arrangement::Vertex& v : a.vertices) {
    if (v.kind != Arrangement::Vertex::Kind::OnBoundary) continue;
    ++ends;
    const LineCrossing& c = e.line_crossings[v.index];
    const Line& line = e.lines[c.line];
    const int axis = parameter_axis(line);
    const Polynomial<2>& f = e.curves[c.curve].function.polynomial();
    EXPECT_GE(v.point[axis], c.lo);
    EXPECT_LE(v.point[axis], c.hi);
    // The root lies between the points halfway to the neighbours.
    const Rational at(v.point[axis]);
    const auto halfway = [&](double to) {
      return exact_sign(
          f, point_on_line(line, (at + Rational(std::nextafter(v.point[axis], to))) / 2));
    };
    const Sign here = exact_sign(f, point_on_line(line, at));
    EXPECT_TRUE(here == Sign::Zero || halfway(-9) != halfway(9)) << v.index;
    EXPECT_EQ(exactly(v.point), point_on_line(line, at));
  }
  EXPECT_GE(ends, 5);
  Arrangement without = arrange(e, {false}).value();
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    if (a.vertices[v].kind == Arrangement::Vertex::Kind::OnBoundary) {
      EXPECT_EQ(without.vertices[v].point, (Point<2>{}));
      without.vertices[v].point = a.vertices[v].point;
    }
  EXPECT_EQ(without, a);
}

}  // namespace
}  // namespace encase
