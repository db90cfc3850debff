// SPDX-License-Identifier: MIT
//
// Surfaces whose functions have no values or no derivatives somewhere: this is reported, and all
// else is certified.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "encase/surface_encasement.hpp"
#include "encase/surfaces_file.hpp"

namespace encase {
namespace {

struct Scene {
  std::string name;
  std::string surface;
  /// How far a point of [-2,2]^3 is from where the function is not analytic, at least.
  std::function<double(const Point<3>&)> distance;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) { return out << scene.name; }

class Undefined : public testing::TestWithParam<Scene> {};

TEST_P(Undefined, PlacesAreReportedAndAllElseIsCertified) {
  const auto file = read_surfaces(GetParam().surface + "\nregion: box -2 2 -2 2 -2 2\n", "test");
  ASSERT_TRUE(file);
  const auto result = encase(file.value().surfaces, *file.value().region);
  ASSERT_TRUE(result);
  const SurfaceEncasement& e = result.value();
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  ASSERT_FALSE(e.degenerate.empty());
  for (const UnresolvedInSpace& place : e.degenerate)
    EXPECT_EQ(place.kind, Unresolved::Kind::NotAnalytic);
  const Verification proof = verify(e);
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  int certified = 0;
  for (const SpaceCell& cell : e.cells) {
    certified += cell.state == CellState::Certified;
    if (cell.state == CellState::Certified) continue;
    // A cell at the gap is small. (Bounds of x^2 + y^2 may reach 0 also beside the line.)
    EXPECT_LE(GetParam().distance(cell.box.center()), 2 * cell.box.largest_width());
    if (GetParam().distance(cell.box.center()) > 0) {
      EXPECT_LE(cell.box.largest_width(), 0.3);
    }
  }
  EXPECT_GT(certified, 2);
}

INSTANTIATE_TEST_SUITE_P(
    All, Undefined,
    testing::Values(Scene{"half_space_without_values", "sqrt(x) - y",
                          [](const auto& p) { return p[0]; }},
                    Scene{"crease", "z - abs(x)", [](const auto& p) { return std::fabs(p[0]); }},
                    Scene{"pole_along_a_line", "z - log(x^2 + y^2)",
                          [](const auto& p) { return std::hypot(p[0], p[1]); }}),
    [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace encase
