// SPDX-License-Identifier: MIT
#include "encase/tracing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "2d/curve_piece.hpp"
#include "common/random_polynomials.hpp"
#include "common/segments.hpp"
#include "tests/encased.hpp"

namespace encase {
namespace {

using encased::run;

RationalPoint<2> exactly(const Point<2>& p) { return {Rational(p[0]), Rational(p[1])}; }

Rational cross(const RationalPoint<2>& p, const RationalPoint<2>& q, const RationalPoint<2>& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// Whether closed segments have a common point, in rationals.
bool meet(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  for (int i = 0; i < 2; ++i)
    if (std::max(a[i], b[i]) < std::min(c[i], d[i]) || std::max(c[i], d[i]) < std::min(a[i], b[i]))
      return false;
  const auto p = exactly(a), q = exactly(b), r = exactly(c), s = exactly(d);
  return sgn(cross(p, q, r)) * sgn(cross(p, q, s)) <= 0 &&
         sgn(cross(r, s, p)) * sgn(cross(r, s, q)) <= 0;
}

/// Whether segments with one common end have more than that in common, in rationals.
bool overlap(const Point<2>& end, const Point<2>& a, const Point<2>& b) {
  const auto p = exactly(end), q = exactly(a), r = exactly(b);
  const Rational along = (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]);
  return cross(p, q, r) == 0 && along > 0;
}

double area(const Polyline& cycle) {
  double twice = 0;
  for (std::size_t k = 1; k < cycle.size(); ++k)
    twice += cycle[k - 1][0] * cycle[k][1] - cycle[k - 1][1] * cycle[k][0];
  return 0.5 * twice;
}

double distance(const Point<2>& p, const Point<2>& a, const Point<2>& b) {
  const double x = b[0] - a[0], y = b[1] - a[1], l = x * x + y * y;
  const double t = l > 0 ? std::clamp(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / l, 0.0, 1.0) : 0;
  return std::hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]);
}

/// A point of a chord about at a part of the way, exactly; its coordinate along the axis is a
/// double.
RationalPoint<2> on_chord(const Point<2>& a, const Point<2>& b, int axis, double part) {
  const RationalPoint<2> p = exactly(a), q = exactly(b);
  RationalPoint<2> at;
  at[axis] = a[axis] + part * (b[axis] - a[axis]);
  at[1 - axis] =
      p[1 - axis] + (at[axis] - p[axis]) / (q[axis] - p[axis]) * (q[1 - axis] - p[1 - axis]);
  return at;
}

/// The curve meets the line across the chord, there, once within the distance: exact signs on both
/// sides, and the number of roots between them.
void expect_once_beside(const FilteredFunction<2>& f, const Point<2>& a, const Point<2>& b,
                        int axis, double within, double part) {
  const int v = 1 - axis;
  const RationalPoint<2> at = on_chord(a, b, axis, part);
  RationalPoint<2> low = at, high = at;
  low[v] -= Rational(within);
  high[v] += Rational(within);
  EXPECT_EQ(sgn(f.polynomial().exact()(low)) * sgn(f.polynomial().exact()(high)), -1);
  if (within < 1e-13) return;
  Line line;
  line.normal[axis] = 1;
  line.offset = -at[axis].get_d();
  Kernel kernel;
  const auto roots =
      isolate_on_line(f, line, nearest_double(low[v]), nearest_double(high[v]), 500, kernel);
  ASSERT_TRUE(roots.has_value());
  EXPECT_EQ(roots->size(), 1u);
}

/// What is said of pieces is true of them, by exact signs on lines across some of the chords.
void expect_pieces(const Encasement& e, const Arrangement& a, const Tracing& tracing) {
  for (std::size_t k = 0; k < a.edges.size(); ++k) {
    const TracedEdge& edge = tracing.edges[k];
    ASSERT_EQ(edge.points.size(), edge.pieces.size() + 1);
    ASSERT_EQ(edge.boxes.size(), edge.points.size());
    for (std::size_t i = 0; i < edge.points.size(); ++i)
      EXPECT_TRUE(edge.boxes[i].contains(edge.points[i]));
    if (a.edges[k].curve < 0) continue;
    const FilteredFunction<2> f(e.curves[a.edges[k].curve].function.polynomial());
    const std::size_t step = std::max<std::size_t>(1, edge.pieces.size() / 40);
    for (std::size_t i = 0; i < edge.pieces.size(); ++i) {
      const auto& [axis, bound] = edge.pieces[i];
      const Point<2>&p = edge.points[i], &q = edge.points[i + 1];
      EXPECT_NE(p[axis], q[axis]);
      if (i % step != 0) continue;
      for (const double part : {1e-3, 0.25, 0.5, 0.75, 0.999})
        expect_once_beside(f, p, q, axis, bound * (1 + 1e-9) + 1e-16, part);
    }
  }
}

/// Every point of a curve is near one of its edges' polylines.
void expect_covers(const Encasement& e, const Arrangement& a, const Tracing& tracing,
                   double tolerance) {
  const Box<2> box = e.region_used.bounding_box();
  Kernel kernel;
  for (int curve = 0; curve < static_cast<int>(e.curves.size()); ++curve) {
    const FilteredFunction<2> f(e.curves[curve].function.polynomial());
    for (int axis = 0; axis < 2; ++axis)
      for (int k = 1; k < 40; ++k) {
        Line line;
        line.normal[axis] = 1;
        line.offset = -(box.lo[axis] + (k + 0.123) / 41 * box.width(axis));
        const auto roots =
            isolate_on_line(f, line, box.lo[1 - axis], box.hi[1 - axis], 2000, kernel);
        if (!roots) continue;
        for (RootInterval root : *roots) {
          for (int n = 0; n < 60 && refine_on_line(f, line, &root, kernel); ++n) {
          }
          Point<2> p;
          p[axis] = -line.offset;
          p[1 - axis] = root.lo;
          double least = std::numeric_limits<double>::infinity();
          for (std::size_t edge = 0; edge < a.edges.size(); ++edge)
            if (a.edges[edge].curve == curve)
              for (std::size_t i = 1; i < tracing.edges[edge].points.size(); ++i)
                least = std::min(least, distance(p, tracing.edges[edge].points[i - 1],
                                                 tracing.edges[edge].points[i]));
          EXPECT_LE(least, tolerance * (1 + 1e-9) + 1e-12);
        }
      }
  }
}

/// No two polylines meet but at vertices of both, in rationals, all pairs.
int meeting_pairs(const Arrangement& a, const Tracing& tracing) {
  struct Segment {
    Point<2> p, q;
    std::size_t edge, piece;
    int from, to;
  };
  std::vector<Segment> all;
  int next = static_cast<int>(a.vertices.size());
  for (std::size_t k = 0; k < a.edges.size(); ++k) {
    const Polyline& line = tracing.edges[k].points;
    const int first = next, count = static_cast<int>(line.size()) - 1;
    next += count;
    for (int i = 0; i < count; ++i) {
      const int start = a.half_edges[2 * k].origin, end = a.half_edges[2 * k + 1].origin;
      all.push_back({line[i], line[i + 1], k, static_cast<std::size_t>(i),
                     i == 0 && start >= 0 ? start : first + i,
                     i + 1 < count ? first + i + 1
                     : end >= 0    ? end
                                   : first});
    }
  }
  int result = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Segment &s = all[i], &t = all[j];
      if (s.from == t.from)
        result += overlap(s.p, s.q, t.q);
      else if (s.from == t.to)
        result += overlap(s.p, s.q, t.p);
      else if (s.to == t.from)
        result += overlap(s.q, s.p, t.q);
      else if (s.to == t.to)
        result += overlap(s.q, s.p, t.p);
      else
        result += meet(s.p, s.q, t.p, t.q);
    }
  return result;
}

bool is_inside(const Point<2>& p, const std::vector<Polyline>& boundary) {
  bool inside = false;
  for (const Polyline& cycle : boundary)
    for (std::size_t k = 1; k < cycle.size(); ++k) {
      const Point<2>&a = cycle[k - 1], &b = cycle[k];
      if ((a[1] > p[1]) != (b[1] > p[1]) &&
          (sgn(cross(exactly(a), exactly(b), exactly(p))) > 0) == (b[1] > a[1]))
        inside = !inside;
    }
  return inside;
}

/// The boundaries of faces are closed and run as they should, fill the region, and hold the points
/// that lie in the face and not near its border.
void expect_faces(const Encasement& e, const Arrangement& a, const Tracing& tracing,
                  double tolerance) {
  const Box<2> box = e.region_used.bounding_box();
  double sum = 0, size = 0;
  std::vector<std::vector<Polyline>> boundaries;
  for (int f = 0; f < static_cast<int>(a.faces.size()); ++f) {
    boundaries.push_back(face_boundary(a, tracing, f));
    ASSERT_EQ(boundaries[f].size(), a.faces[f].holes.size() + (f != a.outside));
    for (std::size_t k = 0; k < boundaries[f].size(); ++k) {
      const Polyline& cycle = boundaries[f][k];
      EXPECT_EQ(cycle.front(), cycle.back());
      const bool outer = k == 0 && f != a.outside;
      EXPECT_EQ(area(cycle) > 0, outer);
      for (std::size_t j = 0; j < boundaries[f].size() && !outer; ++j)
        if (j != k) {
          EXPECT_EQ(is_inside(cycle.front(), {boundaries[f][j]}), j == 0 && f != a.outside);
        }
      if (f != a.outside) sum += area(cycle);
    }
  }
  for (const Polyline& cycle : boundaries[a.outside]) size -= area(cycle);
  EXPECT_NEAR(sum, size, 1e-9);
  EXPECT_NEAR(size, box.width(0) * box.width(1), 1e-9);

  const PointLocator locator(e, a);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int n = 0; n < 200; ++n) {
    const Point<2> p = {box.lo[0] + part(random) * box.width(0),
                        box.lo[1] + part(random) * box.width(1)};
    double least = std::numeric_limits<double>::infinity();
    for (const TracedEdge& edge : tracing.edges)
      for (std::size_t i = 1; i < edge.points.size(); ++i)
        least = std::min(least, distance(p, edge.points[i - 1], edge.points[i]));
    if (least <= 1.01 * tolerance) continue;
    const int here = locator.locate(p).index;
    for (int f = 0; f < static_cast<int>(a.faces.size()); ++f)
      if (f != a.outside) {
        EXPECT_EQ(is_inside(p, boundaries[f]), f == here);
      }
  }
}

Tracing traced(const Encasement& e, const Arrangement& a, double tolerance) {
  TraceOptions options;
  options.tolerance = tolerance;
  const Result<Tracing> tracing = trace(e, a, options);
  EXPECT_TRUE(tracing.ok());
  return tracing.value();
}

void expect_traced(const Encasement& e, double tolerance) {
  const Arrangement a = arrange(e).value();
  const Tracing tracing = traced(e, a, tolerance);
  EXPECT_TRUE(tracing.within_tolerance);
  EXPECT_TRUE(tracing.same_topology);
  EXPECT_TRUE(tracing.conflicts.empty());
  EXPECT_LE(tracing.distance, tolerance);
  expect_pieces(e, a, tracing);
  expect_covers(e, a, tracing, tolerance);
  EXPECT_EQ(meeting_pairs(a, tracing), 0);
  expect_faces(e, a, tracing, tolerance);
}

TEST(Trace, KeepsItsWordOnRandomCurves) {
  for (int degree = 1; degree <= 8; ++degree)
    for (const int count : {1, 3, 6}) {
      if (degree * count > 24) continue;
      RandomOptions options;
      options.degree = degree;
      options.count = count;
      options.seed = static_cast<std::uint64_t>(10 * degree + count);
      const Result<Encasement> e = encase(random_curves(options), encased::square());
      ASSERT_TRUE(e.ok() && e.value().outcome == Outcome::Certified);
      SCOPED_TRACE("degree " + std::to_string(degree) + ", " + std::to_string(count) + " curves");
      expect_traced(e.value(), degree % 2 == 0 ? 1e-3 : 0.03);
    }
}

TEST(Trace, KeepsItsWordForAnyTolerance) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20", "x*y - 1/5"});
  for (const double tolerance : {std::numeric_limits<double>::infinity(), 1e9, 0.5, 1e-2, 1e-4})
    expect_traced(e, tolerance);
  const Arrangement a = arrange(e).value();
  const Tracing fine = traced(e, a, 1e-9);
  EXPECT_TRUE(fine.within_tolerance && fine.same_topology);
  expect_pieces(e, a, fine);
}

TEST(Trace, RefusesAToleranceThatIsNone) {
  const Encasement e = run({"x^2 + y^2 - 1/2"});
  const Arrangement a = arrange(e).value();
  for (const double tolerance : {0.0, -1.0, std::nan("")}) {
    TraceOptions options;
    options.tolerance = tolerance;
    const auto result = trace(e, a, options);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, Error::Code::BadInput);
    EXPECT_EQ(face_boundary(e, a, 1, tolerance).error().code, Error::Code::BadInput);
  }
}

TEST(Trace, SaysWhatDoublesDoNotAllow) {
  const Encasement e = run({"y - x/3 - 1/7", "x^2 + y^2/3 - 1/1000000"});
  const Arrangement a = arrange(e).value();
  const Tracing tracing = traced(e, a, 1e-18);
  EXPECT_FALSE(tracing.within_tolerance);
  EXPECT_TRUE(tracing.same_topology);
  EXPECT_GT(tracing.distance, 1e-18);
  EXPECT_LT(tracing.distance, 1e-12);
  expect_pieces(e, a, tracing);
}

TEST(Trace, SaysWhatItsBudgetDoesNotAllow) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x^3"});
  const Arrangement a = arrange(e).value();
  TraceOptions options;
  options.tolerance = 1e-6;
  options.max_points = 50;
  const Tracing tracing = trace(e, a, options).value();
  EXPECT_FALSE(tracing.within_tolerance);
  EXPECT_TRUE(std::isinf(tracing.distance));
  std::size_t pieces = 0;
  for (const TracedEdge& edge : tracing.edges) pieces += edge.pieces.size();
  EXPECT_LT(pieces, 150u);
}

TEST(Trace, KeepsParabolasApartThatAreClose) {
  EncaseOptions options;
  options.relaxed = true;
  const Encasement e =
      run({"y - x^2/10", "y - x^2/10 - 1/1000000", "y + x/7 - 1/30"}, encased::square(), options);
  EXPECT_GT(encased::count(e, CellState::Relaxed), 0);
  expect_traced(e, 0.02);
}

TEST(Trace, NestsLoopsThatAreClose) {
  const Encasement e =
      run({"x^2 + y^2 - 1/4", "x^2 + y^2 - 1/4 - 1/100000", "(x - 1/100)^2 + y^2 - 1/1000",
           "(x - 4/5)^2 + (y - 3/4)^2 - 1/1000000"});
  expect_traced(e, 0.1);
}

TEST(Trace, KeepsDotsInsideThatAChordWouldLeaveOutside) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto circle = [&](const Rational& at_x, const Rational& at_y, const Rational& square) {
    const auto u = x - Polynomial<2>::constant(at_x), v = y - Polynomial<2>::constant(at_y);
    return u * u + v * v - Polynomial<2>::constant(square);
  };
  std::vector<NamedCurve> curves = {{"large", circle(0, 0, Rational(1, 4))}};
  for (int k = 0; k < 12; ++k) {
    const double angle = 0.3 + k * 0.5236;
    curves.push_back({"dot", circle(Rational(0.49 * std::cos(angle)),
                                    Rational(0.49 * std::sin(angle)), Rational(1, 1000000))});
  }
  expect_traced(encased::run_curves(curves), 0.1);
}

TEST(Trace, KeepsTheSidesOfALens) {
  // Between two crossings one of two curves bends so little more than the other that its chord is
  // beyond it. The factor has no zeros; it only makes the second curve's pieces shorter.
  const Encasement e = run({"y - x^2",
                            "(y - x^2 - (1/4 - x^2)/1000)*"
                            "((x - 1/10)^2 + (y - 1/5)^2 + 1/50)"});
  expect_traced(e, std::numeric_limits<double>::infinity());
}

TEST(Trace, LeavesAFlatCrossingInTheRightOrder) {
  // Three curves whose tangents are nearly the same where they cross, and that bend.
  const Encasement e = run({"y - x^2", "y - x^2 - (x - 1/10)/10000", "y - x^2 + (x + 1/5)/10000"});
  expect_traced(e, 0.05);
}

TEST(Trace, FollowsACuspThatIsNone) {
  const Encasement e = run({"y^2 - x^3 - 1/10000000", "(x^2 + y^2)^2 - x^2 + y^2 - 1/100000000"});
  expect_traced(e, 0.01);
}

TEST(Trace, IsDeterministic) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x^3", "x*y - 1/5"});
  const Arrangement a = arrange(e).value();
  const Tracing one = traced(e, a, 1e-3), two = traced(e, a, 1e-3);
  for (std::size_t k = 0; k < a.edges.size(); ++k)
    EXPECT_EQ(one.edges[k].points, two.edges[k].points);
}

TEST(FaceBoundary, IsTracedAlone) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20", "x^2 + (y - 1/3)^2 - 1/50"});
  const Arrangement a = arrange(e).value();
  const Tracing all = traced(e, a, 1e-4);
  for (int f = 0; f < static_cast<int>(a.faces.size()); ++f) {
    const auto one = face_boundary(e, a, f, 1e-4);
    ASSERT_TRUE(one.ok());
    EXPECT_EQ(one.value(), face_boundary(a, all, f));
  }
  EXPECT_FALSE(face_boundary(e, a, -1, 1e-4).ok());
  EXPECT_FALSE(face_boundary(e, a, 100, 1e-4).ok());
}

TEST(Neighbours, ShareAnEdge) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20"});
  const Arrangement a = arrange(e).value();
  const PointLocator locator(e, a);
  const int upper = locator.locate(Point<2>{0, 0.4}).index,
            lower = locator.locate(Point<2>{0, -0.4}).index,
            above = locator.locate(Point<2>{0, 0.9}).index,
            below = locator.locate(Point<2>{0, -0.9}).index;
  const auto sorted = [](std::vector<int> list) {
    std::sort(list.begin(), list.end());
    return list;
  };
  EXPECT_EQ(a.neighbours(upper), sorted({lower, above}));
  EXPECT_EQ(a.neighbours(lower), sorted({upper, below}));
  EXPECT_EQ(a.neighbours(above), sorted({upper, below, a.outside}));
  EXPECT_EQ(a.neighbours(a.outside), sorted({above, below}));
  for (int h = 0; h < static_cast<int>(a.half_edges.size()); ++h)
    EXPECT_EQ(a.across(h), a.half_edges[Arrangement::twin(h)].face);
}

/// The distance proved for the chord from (-1, 0) to (1, 0).
double proved_distance(const std::string& text) {
  Kernel kernel;
  const FilteredFunction<2> f(written::polynomial<2>(text));
  TiledFunction tiles(f, {{-2, -2}, {2, 2}}, kernel);
  const CurvePoint p{{-1, 0}, {{-1, 0}, {-1, 0}}}, q{{1, 0}, {{1, 0}, {1, 0}}};
  const Attempt attempt = PieceProver(tiles, kernel).prove(p, q, false, 0, 1, 1);
  EXPECT_TRUE(attempt.proved);
  EXPECT_FALSE(attempt.tube.may_meet({{2, 0}, {3, 1}}));
  EXPECT_FALSE(attempt.tube.may_meet({{-0.5, 1.5}, {0.5, 3}}));
  return attempt.piece.distance;
}

TEST(PieceProver, SeesWhatVanishesAtTheEndsAndInTheMiddle) {
  // y = (x^3 - x^5) / 10: on the chord all terms up to degree 2 vanish.
  const double x = std::sqrt(0.6);
  EXPECT_GE(proved_distance("10*y - x^3 + x^5"), (x * x * x - x * x * x * x * x) / 10);
}

TEST(PieceProver, SeesThatTheSlopeFallsOffTheChord) {
  // At x = 0, y - 9/20 y^2 = 1/5.
  EXPECT_GE(proved_distance("y - 9/20*y^2 - 1/5 + x^2/5"), 2. / 9);
}

/// Chords between any points near a curve: what is proved of them holds.
TEST(PieceProver, ProvesNothingThatIsFalse) {
  int proved = 0, not_proved = 0;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-0.9, 0.9), away(-1, 1);
  for (const std::string text :
       {"x^2 + y^2 - 1/2", "y^2 - x^3 - 1/1000", "(y - x^2)*(y - x^2 - 1/100) - 1/100000",
        "(x^2 + y^2)^2 - x^2 + y^2 - 1/1000", "x^5 - 3*x^3*y + y^5 - x/9 + 1/30"}) {
    Kernel kernel;
    const FilteredFunction<2> f(written::polynomial<2>(text));
    TiledFunction tiles(f, {{-1.1, -1.1}, {1.1, 1.1}}, kernel);
    PieceProver prover(tiles, kernel);
    std::vector<CurvePoint> points;
    for (int n = 0; n < 60; ++n) {
      Line line;
      const int axis = n % 2;
      line.normal[axis] = 1;
      line.offset = place(random);
      const auto roots = isolate_on_line(f, line, -1, 1, 500, kernel);
      if (!roots) continue;
      for (RootInterval root : *roots) {
        for (int k = 0; k < 60 && refine_on_line(f, line, &root, kernel); ++k) {
        }
        CurvePoint p;
        p.point[axis] = -line.offset;
        p.point[1 - axis] = root.lo;
        p.box = {p.point, p.point};
        p.box.hi[1 - axis] = root.hi;
        points.push_back(p);
      }
    }
    ASSERT_GT(points.size(), 20u);
    for (const CurvePoint& p : points)
      for (const CurvePoint& q : points) {
        if (&p == &q || std::hypot(p.point[0] - q.point[0], p.point[1] - q.point[1]) > 0.3)
          continue;
        for (const int axis : {0, 1})
          for (const int direction : {1, -1}) {
            const Attempt attempt = prover.prove(p, q, false, axis, direction, 1e-3);
            (attempt.proved ? proved : not_proved) += 1;
            if (!attempt.proved) continue;
            for (const double part : {0.01, 0.3, 0.6, 0.99})
              expect_once_beside(f, p.point, q.point, axis,
                                 attempt.piece.distance * (1 + 1e-9) + 1e-16, part);
            // On the left of its direction f is positive.
            const RationalPoint<2> middle = on_chord(p.point, q.point, axis, 0.5);
            RationalPoint<2> left = middle;
            const bool grows = p.point[axis] < q.point[axis];
            const Rational side(attempt.piece.distance * 1.01 + 1e-15);
            left[1 - axis] += (axis == 0) == grows ? side : Rational(-side);
            EXPECT_EQ(sgn(f.polynomial().exact()(left)), direction);
            EXPECT_TRUE(attempt.tube.may_meet(p.box));
            EXPECT_TRUE(attempt.tube.may_meet(q.box));
          }
      }
  }
  EXPECT_GT(proved, 300);
  EXPECT_GT(not_proved, 1000);
}

}  // namespace
}  // namespace encase
