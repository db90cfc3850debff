// SPDX-License-Identifier: MIT
#include "3d/mesh_cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include "3d/space_vectors.hpp"
#include "3d/triangle_bounds.hpp"
#include "encased_surfaces.hpp"

namespace encase {
namespace {

SurfaceMesh mesh_of(const SurfaceEncasement& e, double tolerance) {
  SurfaceMeshOptions options;
  options.tolerance = tolerance;
  return mesh(e, options).value()[0];
}

/// Whether a mesh is proved to come near all points of its surface.
bool is_cover(const SurfaceMesh& mesh, const SurfaceEncasement& e) {
  const FilteredFunction<3> function(e.surfaces[mesh.surface].function);
  const SurfaceBounds bounds(function, e.region_used.bounding_box().largest_width());
  Kernel kernel;
  SurfaceModels models(bounds, kernel);
  const MeshCorners maker(e, bounds);
  const auto sides = sides_of_points(mesh, maker);
  if (!sides) return false;
  std::vector<Corner> corners;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    corners.push_back(maker.corner(mesh.points[k], (*sides)[k]));
  double way = 0;
  for (const auto& [p, q, r] : mesh.triangles)
    way = std::max(way, bound_triangle(models, {corners[p], corners[q], corners[r]}, mesh.tolerance,
                                       maker.moved())
                            .way);
  return covers_surface(mesh, e, maker, corners, way);
}

double distance(const Point<3>& p, const Point<3>& a, const Point<3>& b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - (a + t * (b - a)));
}

double distance(const Point<3>& p, const SurfaceMesh& mesh) {
  double least = INFINITY;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Point<3>&a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    const Point<3> n = unit(cross(b - a, c - a));
    if (dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
        dot(cross(a - c, p - c), n) >= 0)
      least = std::min(least, std::fabs(dot(p - a, n)));
    least = std::min({least, distance(p, a, b), distance(p, b, c), distance(p, c, a)});
  }
  return least;
}

/// A point of the surface on the way between two, by halving it.
std::optional<Point<3>> point_between(const FilteredFunction<3>& f, Point<3> p, Point<3> q) {
  if (!(f.approximate(p) < 0 && f.approximate(q) > 0)) return std::nullopt;
  for (int step = 0; step < 60; ++step) {
    const Point<3> middle = 0.5 * (p + q);
    (f.approximate(middle) < 0 ? p : q) = middle;
  }
  return p;
}

void expect_covered(const SurfaceEncasement& e, double tolerance) {
  const SurfaceMesh mesh = mesh_of(e, tolerance);
  EXPECT_EQ(check(mesh, e), "");
  ASSERT_LE(mesh.distance_to_mesh, tolerance);
  EXPECT_TRUE(mesh.isotopic);
  const FilteredFunction<3> f(e.surfaces[0].function);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  int found = 0;
  double largest = 0;
  for (int k = 0; k < 20000 && found < 60; ++k) {
    const auto any = [&] {
      return Point<3>{coordinate(random), coordinate(random), coordinate(random)};
    };
    const Point<3> from = any(), to = any();
    const auto p = point_between(f, from, to);
    if (!p) continue;
    ++found;
    largest = std::max(largest, distance(*p, mesh));
  }
  EXPECT_EQ(found, 60);
  EXPECT_LE(largest, mesh.distance_to_mesh);
  EXPECT_GE(largest, 0.1 * mesh.distance_to_mesh - 1e-9);  // it says something
}

TEST(MeshCover, HoldsForPointsOfASphere) {
  expect_covered(encased_surfaces({"x^2+y^2+z^2-1"}, 2), 0.02);
}

TEST(MeshCover, HoldsUpToTheRegionsBoundary) {
  expect_covered(encased_surfaces({"z-x*y/3-x/7-1/9"}, 2), 0.02);
}

TEST(MeshCover, HoldsForTwoSheets) {
  expect_covered(encased_surfaces({"x^2-y^2-z^2-1/3"}, 2), 0.02);
}

TEST(MeshCover, HoldsForATorus) {
  expect_covered(encased_surfaces({"(x^2+y^2+z^2+1-0.16)^2-4*(x^2+y^2)"}, 2), 0.02);
}

TEST(MeshCover, IsNotClaimedOfWhatLeavesOutATriangle) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  SurfaceMesh bad = mesh_of(e, 0.02);
  ASSERT_TRUE(is_cover(bad, e));
  bad.triangles.pop_back();
  EXPECT_FALSE(is_cover(bad, e));
}

TEST(MeshCover, IsNotClaimedOfWhatIsFarOffOrFolded) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  const SurfaceMesh good = mesh_of(e, 0.02);
  SurfaceMesh bad = good;
  bad.points[5] = 1.3 * bad.points[5];
  EXPECT_FALSE(is_cover(bad, e));
  bad = good;
  // Onto the other side of a neighbour, on the surface.
  const auto& [p, q, r] = bad.triangles[0];
  bad.points[p] = unit(bad.points[q] + 0.5 * (bad.points[q] - bad.points[p]));
  EXPECT_FALSE(is_cover(bad, e));
}

TEST(MeshCover, IsNotClaimedOfOneSheetTwice) {
  const SurfaceEncasement e = encased_surfaces({"x^2-y^2-z^2-1/3"}, 2);
  SurfaceMesh bad = mesh_of(e, 0.02);
  ASSERT_TRUE(is_cover(bad, e));
  const auto right = [&](const std::array<int, 3>& t) { return bad.points[t[0]][0] > 0; };
  std::erase_if(bad.triangles, [&](const auto& t) { return !right(t); });
  std::vector<Point<3>> points;
  std::vector<int> number(bad.points.size(), -1);
  for (auto& t : bad.triangles)
    for (int& p : t) {
      if (number[p] < 0) {
        number[p] = static_cast<int>(points.size());
        points.push_back(bad.points[p]);
      }
      p = number[p];
    }
  bad.points = points;
  EXPECT_FALSE(is_cover(bad, e));
  const int half = static_cast<int>(points.size());
  bad.points.insert(bad.points.end(), points.begin(), points.end());
  const auto once = bad.triangles;
  for (const auto& [p, q, r] : once) bad.triangles.push_back({p + half, q + half, r + half});
  EXPECT_FALSE(is_cover(bad, e));
}

TEST(MeshCover, HoldsWhereSurfacesMeetEdgesOfTheRegionAtSmallAngles) {
  // Nearly along x at the edge y = z = -2 of the region.
  expect_covered(encased_surfaces({"z+2-(y+2)/3-(x-1/9)/50"}, 2), 0.02);
  expect_covered(encased_surfaces({"z+2-(y+2)^2/3-(x-1/9)^2/20+(x-1/9)/90"}, 2), 0.02);
}

TEST(MeshCover, IsNotClaimedOfWhatWindsTwice) {
  const SurfaceEncasement e = encased_surfaces({"z"}, 2);
  const std::vector<Point<3>> ring{{2, 0, 0},  {2, 2, 0},   {0, 2, 0},  {-2, 2, 0},
                                   {-2, 0, 0}, {-2, -2, 0}, {0, -2, 0}, {2, -2, 0}};
  for (const int turns : {1, 2}) {
    SurfaceMesh mesh;
    mesh.surface = 0;
    mesh.tolerance = 0.02;
    mesh.points.push_back({0, 0, 0});
    const int count = turns * static_cast<int>(ring.size());
    for (int k = 0; k < count; ++k) {
      mesh.points.push_back(ring[k % ring.size()]);
      mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % count});
    }
    EXPECT_EQ(is_cover(mesh, e), turns == 1);
  }
}

TEST(MeshCover, IsNotClaimedOfAnEdgeAcrossASide) {
  const SurfaceEncasement e = encased_surfaces({"z"}, 2);
  const FilteredFunction<3> function(e.surfaces[0].function);
  const SurfaceBounds bounds(function, 4);
  const MeshCorners maker(e, bounds);
  SurfaceMesh mesh;
  mesh.surface = 0;
  mesh.points = {{2, 0, 0}, {2, 2, 0}, {-2, 2, 0}, {-2, -2, 0}, {2, -2, 0}};
  // From a point of the side x = 2 to the others; or with an edge along all of that side within.
  for (const bool across : {false, true}) {
    mesh.triangles = across ? std::vector<std::array<int, 3>>{{2, 3, 4}, {2, 4, 1}, {4, 0, 1}}
                            : std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    const auto sides = sides_of_points(mesh, maker);
    ASSERT_TRUE(sides);
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
      corners.push_back(maker.corner(mesh.points[k], (*sides)[k]));
    EXPECT_EQ(covers_surface(mesh, e, maker, corners, 0.001), !across);
  }
}

TEST(MeshCorners, LeadAlongSidesAndNotBeyondOthers) {
  const SurfaceEncasement e = encased_surfaces({"x+z-1/9"}, 2);
  const FilteredFunction<3> function(e.surfaces[0].function);
  const SurfaceBounds bounds(function, 4);
  const MeshCorners maker(e, bounds);
  const double half = std::sqrt(0.5);
  const Corner within = maker.corner({1.5, 0, -1}, kWithin);
  EXPECT_NEAR(length(within.direction - Point<3>{half, 0, half}), 0, 1e-12);
  EXPECT_NEAR(within.room, 0.5 / half, 1e-9);
  PointSides sides = kWithin;
  for (int k = 0; k < maker.side_count(); ++k)
    if (maker.beyond(k, {2, 0, -1}) == 0) sides[0] = k;
  const Corner in_side = maker.corner({2, 0, -1}, sides);
  EXPECT_NEAR(length(in_side.direction - Point<3>{0, 0, 1}), 0, 1e-12);
  EXPECT_NEAR(in_side.room, 1, 1e-9);
}

TEST(CheckMesh, ObjectsToCellsThatAreNotItsOwn) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1", "z-x/7-1/9"}, 2);
  SurfaceMesh bad = mesh_of(e, 0.05);
  ASSERT_EQ(check(bad, e), "");
  for (int& cell : bad.cells) cell = bad.cells.back();
  EXPECT_NE(check(bad, e).find(" leaves its cell"), std::string::npos);
}

TEST(CheckMesh, ObjectsToCompletenessWithoutCertificate) {
  const auto e = encase({{"planes", written::polynomial<3>("x*y")}},
                        make_box({-1, -1, -1}, {1, 1, 1}).value());
  ASSERT_TRUE(e);
  ASSERT_EQ(e.value().outcome, Outcome::Degenerate);
  SurfaceMesh bad = mesh_of(e.value(), 0.05);
  EXPECT_FALSE(bad.complete);
  EXPECT_EQ(check(bad, e.value()), "");
  bad.complete = true;
  EXPECT_EQ(check(bad, e.value()), "cells without certificate may meet the surface");
}

TEST(CheckMesh, ObjectsToAnIsotopyThatIsNotProved) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  const SurfaceMesh good = mesh_of(e, 0.02);
  ASSERT_TRUE(good.isotopic);
  ASSERT_EQ(check(good, e), "");
  SurfaceMesh bad = good;
  bad.complete = false;
  bad.distance_to_mesh = std::numeric_limits<double>::infinity();
  EXPECT_EQ(check(bad, e), "that mesh and surface are isotopic is not proved");
  bad.isotopic = false;
  EXPECT_EQ(check(bad, e), "");
}

TEST(MeshCover, IsNotEmbeddedWhereTrianglesMeet) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  SurfaceMesh mesh = mesh_of(e, 0.02);
  const FilteredFunction<3> function(e.surfaces[0].function);
  const SurfaceBounds bounds(function, 4);
  const MeshCorners maker(e, bounds);
  EXPECT_TRUE(is_embedded(mesh, maker));
  // A copy that is turned over crosses it.
  const int count = static_cast<int>(mesh.points.size());
  const auto once = mesh.triangles;
  for (int k = 0; k < count; ++k) {
    const Point<3> p = mesh.points[k];
    mesh.points.push_back({p[1], p[2], p[0]});
  }
  for (const auto& [p, q, r] : once) mesh.triangles.push_back({p + count, q + count, r + count});
  EXPECT_FALSE(is_embedded(mesh, maker));
}

TEST(CheckMesh, ObjectsToADistanceToTheMeshThatIsTooSmall) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  SurfaceMesh bad = mesh_of(e, 0.02);
  bad.distance_to_mesh *= 0.9;
  EXPECT_NE(check(bad, e), "");
}

}  // namespace
}  // namespace encase
