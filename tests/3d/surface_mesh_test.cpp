// SPDX-License-Identifier: MIT
#include "encase/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "3d/space_vectors.hpp"
#include "encase/surface_topology.hpp"
#include "encased_surfaces.hpp"

namespace encase {
namespace {

std::vector<SurfaceMesh> meshes_of(const SurfaceEncasement& e, double tolerance) {
  SurfaceMeshOptions options;
  options.tolerance = tolerance;
  return mesh(e, options).value();
}

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [p, q, r] : mesh.triangles)
    sum += 0.5 * length(cross(mesh.points[q] - mesh.points[p], mesh.points[r] - mesh.points[p]));
  return sum;
}

TEST(SurfaceMesh, OfASphereIsClosedAndWithinTheTolerance) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  const auto meshes = meshes_of(e, 0.01);
  ASSERT_EQ(meshes.size(), 1u);
  const SurfaceMesh& sphere = meshes[0];
  EXPECT_EQ(check(sphere, e), "");
  EXPECT_TRUE(sphere.complete);
  EXPECT_TRUE(sphere.within_tolerance);
  EXPECT_EQ(sphere.euler, 2);
  EXPECT_NEAR(area(sphere), 4 * M_PI, 0.1);
  for (std::size_t k = 0; k < sphere.triangles.size(); ++k) {
    const auto& [p, q, r] = sphere.triangles[k];
    const Point<3> middle = (1.0 / 3) * (sphere.points[p] + sphere.points[q] + sphere.points[r]);
    EXPECT_LE(std::fabs(length(middle) - 1), sphere.distances[k]);
    // Counter-clockwise seen from outside.
    EXPECT_GT(dot(cross(sphere.points[q] - sphere.points[p], sphere.points[r] - sphere.points[p]),
                  middle),
              0);
  }
}

TEST(SurfaceMesh, OfSurfacesCutByOthersIsGlued) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1", "z-x/7-1/9", "x-y^2/3+z/9"}, 2);
  const auto shapes = surface_topology(e);
  EXPECT_EQ(shapes[0].euler, 2);
  EXPECT_EQ(shapes[1].euler, 1);
  EXPECT_EQ(shapes[1].boundary_loops, 1);
  EXPECT_EQ(shapes[2].euler, 1);
  const auto meshes = meshes_of(e, 0.01);
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    EXPECT_EQ(check(meshes[k], e), "");
    EXPECT_EQ(meshes[k].euler, shapes[k].euler);
    EXPECT_EQ(shapes[k].components, 1);
  }
  EXPECT_NEAR(area(meshes[0]), 4 * M_PI, 0.1);
  // A plane over a square: x grows by 7 for each 1 of z.
  EXPECT_NEAR(area(meshes[1]), 16 * std::sqrt(1 + 1.0 / 49), 1e-6);
}

TEST(SurfaceMesh, OfOneSurfaceDoesNotMeetThatOfAnother) {
  // Spheres at distances from 0.0042 to 0.006, with triangles that could be 0.05 off.
  const SurfaceEncasement e =
      encased_surfaces({"x^2+y^2+z^2-1", "x^2+(y-1/1000)^2+z^2-1-1/100-1/5000"}, 2);
  const std::vector<SurfaceMesh> meshes = meshes_of(e, 0.05);
  EXPECT_TRUE(meshes[0].apart);
  EXPECT_TRUE(meshes[1].apart);
  EXPECT_EQ(check(meshes, e), "");
  // With as many triangles as one of them needs alone they would meet.
  const SurfaceEncasement one = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  const SurfaceMesh coarse = meshes_of(one, 0.05)[0];
  EXPECT_LT(coarse.triangles.size(), meshes[0].triangles.size());
  EXPECT_GT(coarse.distance, 0.005);
}

TEST(CheckMesh, ObjectsToMeshesThatAreNotApart) {
  const SurfaceEncasement e =
      encased_surfaces({"x^2+y^2+z^2-1", "x^2+(y-1/1000)^2+z^2-1-1/100-1/5000"}, 2);
  // Too few triangles to keep them apart.
  SurfaceMeshOptions options;
  options.tolerance = 0.05;
  options.max_triangles = 1500;
  std::vector<SurfaceMesh> meshes = mesh(e, options).value();
  EXPECT_FALSE(meshes[0].apart);
  EXPECT_FALSE(meshes[1].apart);
  EXPECT_EQ(check(meshes, e), "");
  for (SurfaceMesh& mesh : meshes) mesh.apart = true;
  EXPECT_EQ(check(meshes, e), "that meshes are apart where the surfaces are is not proved");
}

TEST(CheckMesh, ObjectsToWhatIsChanged) {
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1"}, 2);
  const SurfaceMesh good = meshes_of(e, 0.05)[0];
  ASSERT_EQ(check(good, e), "");
  SurfaceMesh bad = good;
  bad.points[0][0] += 0.05;
  EXPECT_NE(check(bad, e), "");
  bad = good;
  bad.distances[3] = 1e-9;
  EXPECT_NE(check(bad, e), "");
  bad = good;
  std::swap(bad.triangles[0][0], bad.triangles[0][1]);
  EXPECT_NE(check(bad, e), "");
  bad = good;
  bad.triangles.pop_back();
  bad.cells.pop_back();
  bad.distances.pop_back();
  bad.angles.pop_back();
  EXPECT_NE(check(bad, e), "");
  bad = good;
  bad.normals[7] = -1.0 * bad.normals[7];
  EXPECT_EQ(check(bad, e), "the normal at point 7 is not the surface's");
  bad = good;
  bad.points[7] = {1e300, 0, 0};
  EXPECT_NE(check(bad, e), "");
  bad = good;
  bad.euler = 0;
  EXPECT_NE(check(bad, e), "");
}

}  // namespace
}  // namespace encase
