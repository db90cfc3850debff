// SPDX-License-Identifier: MIT
#include "2d/piece_complex.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "encased.hpp"
#include "sample_encasements.hpp"

namespace encase {
namespace {

using encased::rectangle;
using encased::run;

struct Pieces {
  Arrangement arrangement;
  std::vector<Polyline> edges;
  PieceComplex complex;
};

Pieces pieces_of(const Encasement& e, double tolerance = 1e-4) {
  Pieces p;
  p.arrangement = arrange(e).value();
  p.edges = trace_edges(e, p.arrangement, tolerance);
  p.complex = make_piece_complex(e, p.arrangement, p.edges).value();
  return p;
}

double cross(const Point<2>& p, const Point<2>& q) { return p[0] * q[1] - p[1] * q[0]; }

double area(const PieceComplex& complex, const std::vector<int>& piece) {
  double twice = 0;
  for (std::size_t k = 0; k < piece.size(); ++k)
    twice += cross(complex.points[piece[k]], complex.points[piece[(k + 1) % piece.size()]]);
  return twice / 2;
}

double area(const Region& region) {
  Rational twice = 0;
  for (int k = 0; k < region.side_count(); ++k) {
    const auto &p = region.corners[k], &q = region.corners[(k + 1) % region.side_count()];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice.get_d() / 2;
}

/// The area that the polylines around a face enclose.
double area(const Pieces& p, const Arrangement::Face& face) {
  std::vector<int> cycles = face.holes;
  cycles.push_back(face.outer);
  double twice = 0;
  for (const int first : cycles)
    for (const int h : p.arrangement.cycle(first)) {
      const Polyline& line = p.edges[Arrangement::edge_of(h)];
      for (std::size_t k = 1; k < line.size(); ++k)
        twice += (h % 2 == 0 ? 1 : -1) * cross(line[k - 1], line[k]);
    }
  return twice / 2;
}

/// Polygons share corners and edges, every edge lies between two of them or on the region's
/// boundary, together they are a disc, and those of a face have the face's area.
void expect_right(const Encasement& e, const Pieces& p) {
  const PieceComplex& complex = p.complex;
  ASSERT_EQ(complex.pieces.size(), p.arrangement.pieces.size());
  std::set<std::pair<int, int>> directed, edges;
  std::set<int> points;
  std::vector<double> of_face(p.arrangement.faces.size());
  double all = 0;
  const double whole = area(e.region_used);
  for (std::size_t k = 0; k < complex.pieces.size(); ++k) {
    const std::vector<int>& piece = complex.pieces[k];
    EXPECT_EQ(std::set<int>(piece.begin(), piece.end()).size(), piece.size());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const int from = piece[i], to = piece[(i + 1) % piece.size()];
      EXPECT_TRUE(directed.emplace(from, to).second);
      edges.insert(std::minmax(from, to));
      points.insert(from);
    }
    const double a = area(complex, piece);
    EXPECT_GT(a, -1e-9 * whole);
    all += a;
    of_face[p.arrangement.pieces[k].face] += a;
  }
  EXPECT_EQ(points.size(), complex.points.size());
  EXPECT_EQ(static_cast<int>(points.size()) - static_cast<int>(edges.size()) +
                static_cast<int>(complex.pieces.size()),
            1);
  EXPECT_NEAR(all, whole, 1e-12 * whole);
  for (std::size_t f = 0; f < of_face.size(); ++f)
    if (p.arrangement.faces[f].outer >= 0) {
      EXPECT_NEAR(of_face[f], area(p, p.arrangement.faces[f]), 1e-9 * whole) << f;
    }
}

TEST(PieceComplex, CutsCellsAtTheirBranches) {
  const Encasement e = sample::circle_and_line();
  const Pieces p = pieces_of(e);
  // Four around the crossing of each of the cells that have one.
  ASSERT_EQ(p.complex.pieces.size(), 9u);
  expect_right(e, p);
  double inside = 0;
  for (std::size_t k = 0; k < p.complex.pieces.size(); ++k)
    if (p.arrangement.faces[p.arrangement.pieces[k].face].signs[0] == Sign::Negative)
      inside += area(p.complex, p.complex.pieces[k]);
  EXPECT_NEAR(inside, std::acos(-1.0) / 2, 1e-3);
}

TEST(PieceComplex, IsADiscForAllKindsOfCells) {
  EncaseOptions relaxed;
  relaxed.relaxed = true;
  const std::vector<Encasement> scenes = {
      run({}), run({"x^2 + y^2 - 1/2"}), run({"y - x^3", "x^2 + y^2 - 1/3", "x + y/3 - 1/7"}),
      // Nested loops, and branches that are close to each other.
      run({"x^2 + y^2 - 4", "x^2 + y^2 - 1", "x^2 + y^2 - 1/4", "x - 2 y + 3"},
          rectangle(-3, 3, -3, 3)),
      run({"x^2 + y^2 - 1/2", "x^2 + 2 y^2 - 3/4"}, encased::square(), relaxed),
      run({"y - x/3", "y - x/3 - 1/1000"}, encased::square(), relaxed),
      run({"(x^2 + y^2)^2 - x^2 + y^2 + 1/100", "y - x/2 - 1/50"},
          make_region({{-2, -1}, {2, Rational(-3, 2)}, {1, 2}, {-1, 1}}).value()),
      run({"x^2 - y^2 - 1", "y - 3 x"}, whole_plane())};
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    SCOPED_TRACE(k);
    ASSERT_EQ(scenes[k].outcome, Outcome::Certified);
    for (const double tolerance : {1e-4, 0.1})
      expect_right(scenes[k], pieces_of(scenes[k], tolerance));
  }
}

TEST(PieceComplex, RefusesPolylinesThatAreTooShort) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  std::vector<Polyline> edges = trace_edges(e, a, 1e-4);
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (a.edges[k].strands.size() > 1) edges[k].resize(1);
  const Result<PieceComplex> result = make_piece_complex(e, a, edges);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Error::Code::Internal);
}

}  // namespace
}  // namespace encase
