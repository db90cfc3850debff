// SPDX-License-Identifier: MIT
//
// Encasements of surfaces are the same bytes for any number of threads.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "encase/surface_encasement.hpp"
#include "encase/surface_result_json.hpp"
#include "encase/surfaces_file.hpp"
#include "random_triples.hpp"
#include "written.hpp"

namespace encase {
namespace {

struct Scene {
  std::string name;
  std::vector<NamedSurface> surfaces;
  Polyhedron region;
  SurfaceOptions options = {};
};

std::vector<NamedSurface> triple(int degree, std::uint64_t seed) {
  const auto three = named(random_triple(degree, seed));
  return {three.begin(), three.end()};
}

std::vector<NamedSurface> expressions(const std::string& lines) {
  auto file = read_surfaces(lines, "test");
  EXPECT_TRUE(file) << file.error().message;
  return file.value().surfaces;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  all.push_back({"cubics", triple(3, 1), cube(1)});
  std::vector<NamedSurface> quadrics = triple(2, 2);
  for (const NamedSurface& surface : triple(2, 3))
    quadrics.push_back({"more " + surface.name, surface.function});
  all.push_back({"six quadrics", quadrics, cube(1)});
  all.push_back({"touching spheres",
                 expressions("x^2 + y^2 + z^2 - 1\n(x - 2)^2 + y^2 + z^2 - 1\nz - x/3"), cube(4)});
  all.push_back({"expressions", expressions("z - sin(x*y)\nx^2 + y^2 + z^2 - 1"), cube(2)});
  all.push_back({"few cells", triple(4, 1), cube(1)});
  all.back().options.max_cells = 30;
  all.push_back({"perturbed", expressions("x*y*z"), cube(1)});
  all.back().options.perturbation = 1e-2;
  return all;
}

std::string bytes(const Scene& scene, int threads) {
  SurfaceOptions options = scene.options;
  options.threads = threads;
  const auto result = encase(scene.surfaces, scene.region, options);
  EXPECT_TRUE(result.ok()) << scene.name;
  return result ? to_json(result.value(), nullptr) : std::string();
}

TEST(SurfaceThreads, ResultsAreTheSameBytesForAnyNumber) {
  for (const Scene& scene : scenes()) {
    const std::string expected = bytes(scene, 1);
    for (const int threads : {2, 3, 8})
      EXPECT_TRUE(bytes(scene, threads) == expected) << scene.name << ", " << threads;
  }
}

TEST(SurfaceThreads, OneOfSeveralCancels) {
  int calls = 0;
  SurfaceOptions options;
  options.threads = 3;
  options.progress = [&calls](const char*, double) { return ++calls < 40; };
  const auto result = encase(triple(4, 2), cube(1), options);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().outcome, Outcome::Undecided);
  EXPECT_GE(calls, 40);
  EXPECT_TRUE(verify(result.value()).ok());
}

}  // namespace
}  // namespace encase
