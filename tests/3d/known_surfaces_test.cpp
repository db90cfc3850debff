// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "encase/space_arrangement.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"
#include "encase/surface_topology.hpp"
#include "encase/surfaces_file.hpp"
#include "random_triples.hpp"
#include "tetrahedra.hpp"
#include "written.hpp"

namespace encase {
namespace {

SurfaceEncasement encased(const SurfacesFile& file, const SurfaceOptions& options = {}) {
  auto result = encase(file.surfaces, *file.region, options);
  EXPECT_TRUE(result) << result.error().message;
  const Verification proof = verify(result.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return std::move(result).value();
}

SurfacesFile from_file(const std::string& name) {
  auto file = load_surfaces(std::string(ENCASE_TEST_DATA) + "/surfaces/" + name + ".surfaces");
  EXPECT_TRUE(file) << file.error().message;
  return std::move(file).value();
}

void expect_isotopic_meshes(const SurfaceEncasement& e) {
  SurfaceMeshOptions options;
  options.tolerance = 0.01 * e.region_used.bounding_box().largest_width();
  const auto meshes = mesh(e, options);
  ASSERT_TRUE(meshes);
  EXPECT_EQ(check(meshes.value(), e), "");
  for (const SurfaceMesh& mesh : meshes.value()) {
    EXPECT_TRUE(mesh.isotopic);
    EXPECT_TRUE(mesh.apart);
    EXPECT_TRUE(mesh.within_tolerance);
    EXPECT_LE(mesh.distance_to_mesh, options.tolerance);
  }
}

/// The one surface of the file, certified: its components and its Euler characteristic, which is
/// that of a grid of tetrahedra too.
SurfaceTopology shape_of(const SurfacesFile& file, int grid) {
  const SurfaceEncasement e = encased(file);
  EXPECT_EQ(e.outcome, Outcome::Certified);
  const SurfaceTopology shape = surface_topology(e)[0];
  const auto arrangement = arrange(e);
  EXPECT_TRUE(arrangement);
  int euler = 0;
  for (const auto& component : arrangement.value().components) euler += component.euler;
  EXPECT_EQ(euler, shape.euler);
  EXPECT_EQ(static_cast<int>(arrangement.value().components.size()), shape.components);
  EXPECT_EQ(euler_by_tetrahedra(file.surfaces[0].function.polynomial(),
                                e.region_used.bounding_box(), grid),
            shape.euler);
  expect_isotopic_meshes(e);
  return shape;
}

TEST(KnownSurfaces, ClebschsCubicIsOnePieceOfCharacteristicMinusTwo) {
  const SurfaceTopology shape = shape_of(from_file("clebsch"), 151);
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler, -2);
}

TEST(KnownSurfaces, ATorusWithTwoHolesHasCharacteristicMinusTwo) {
  const SurfacesFile file{
      {{"two holes", written::polynomial<3>("(x*(x-1)^2*(x-2)+y^2)^2+z^2-1/100")}},
      make_box({-1, -2, -1}, {3, 2, 1}).value()};
  const SurfaceTopology shape = shape_of(file, 101);
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler, -2);
  EXPECT_EQ(shape.boundary_loops, 0);
}

TEST(KnownSurfaces, ATorusAndFourSpheresAreDivided) {
  const SurfaceEncasement e = encased(from_file("torus_2spheres"));
  EXPECT_EQ(e.outcome, Outcome::Certified);
  const auto shapes = surface_topology(e);
  ASSERT_EQ(shapes.size(), 5u);
  EXPECT_EQ(shapes[0].euler, 0);
  for (std::size_t k = 1; k < 5; ++k) EXPECT_EQ(shapes[k].euler, 2);
  EXPECT_TRUE(arrange(e));
  expect_isotopic_meshes(e);
}

TEST(KnownSurfaces, RandomCubicsHaveIsotopicMeshes) {
  for (const int seed : {1, 2}) {
    const auto triple = named(random_triple(3, seed));
    expect_isotopic_meshes(encased({{triple.begin(), triple.end()}, cube(1)}));
  }
}

}  // namespace
}  // namespace encase
