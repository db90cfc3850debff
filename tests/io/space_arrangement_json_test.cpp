// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <variant>
#include <vector>

#include "encase/result_json.hpp"
#include "encase/space_arrangement.hpp"
#include "encase/surface_result_json.hpp"
#include "written.hpp"

namespace encase {
namespace {

struct Scene {
  SurfaceEncasement encasement;
  SpaceArrangement arrangement;
};

/// Two spheres and a plane: a triple point twice, three regions inside each of the spheres' parts.
const Scene& scene() {
  static const Scene made = [] {
    std::vector<NamedSurface> surfaces;
    for (const char* text : {"x^2+y^2+z^2-1", "(x-1)^2+y^2+z^2-1", "z-x/5+y/7-1/9"})
      surfaces.push_back({text, written::polynomial<3>(text)});
    auto encasement = encase(surfaces, make_box({-3, -3, -3}, {3, 3, 3}).value()).value();
    auto arrangement = arrange(encasement).value();
    return Scene{std::move(encasement), std::move(arrangement)};
  }();
  return made;
}

TEST(SpaceArrangementJson, IsReadBackAndProvedAgain) {
  const std::string text = to_json(scene().encasement, &scene().arrangement);
  const auto stored = surfaces_from_json(text, "file");
  ASSERT_TRUE(stored) << stored.error().message;
  ASSERT_TRUE(stored.value().arrangement);
  EXPECT_EQ(*stored.value().arrangement, scene().arrangement);
  EXPECT_EQ(to_json(stored.value().encasement, &*stored.value().arrangement), text);
  const Verification again = verify(stored.value().encasement, *stored.value().arrangement);
  EXPECT_TRUE(again.ok()) << again.objections.front();
}

TEST(SpaceArrangementJson, IsToldFromOtherResults) {
  const auto any = any_result_from_json(to_json(scene().encasement), "file");
  ASSERT_TRUE(any) << any.error().message;
  EXPECT_TRUE(std::holds_alternative<StoredSurfaces>(any.value()));
  EXPECT_FALSE(result_from_json(to_json(scene().encasement), "file"));
}

TEST(SpaceArrangementJson, AChangedArrangementIsRefused) {
  const auto refused = [](const SpaceArrangement& changed) {
    return !verify(scene().encasement, changed).ok();
  };
  SpaceArrangement a = scene().arrangement;
  EXPECT_FALSE(refused(a));
  a.components[0].euler += 2;
  EXPECT_TRUE(refused(a));
  a = scene().arrangement;
  a.components[1].closed = !a.components[1].closed;
  EXPECT_TRUE(refused(a));
  a = scene().arrangement;
  std::swap(a.faces[0].regions[0], a.faces[0].regions[1]);
  EXPECT_TRUE(refused(a));
  a = scene().arrangement;
  a.regions[0].signs[0] = -a.regions[0].signs[0];
  EXPECT_TRUE(refused(a));
  a = scene().arrangement;
  a.regions.pop_back();
  EXPECT_TRUE(refused(a));
  a = scene().arrangement;
  a.region_of_facet[0][0] = 1 - a.region_of_facet[0][0];
  EXPECT_TRUE(refused(a));
}

TEST(SpaceArrangementJson, SurvivesDamage) {
  const std::string text = to_json(scene().encasement, &scene().arrangement);
  std::mt19937_64 random(3);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int refused = 0;
  constexpr int kTrials = 300;
  for (int k = 0; k < kTrials; ++k) {
    std::string damaged = text;
    for (std::size_t changes = 1 + below(3); changes > 0; --changes)
      damaged[below(damaged.size())] = "0123456789-,[]{}\"e.n"[below(20)];
    if (k % 10 == 0) damaged.resize(below(damaged.size()));
    const auto stored = surfaces_from_json(damaged, "file");
    // What can be read is refused by verification, or still right.
    if (!stored || !verify(stored.value().encasement).ok()) ++refused;
  }
  EXPECT_GT(refused, kTrials / 2);
}

}  // namespace
}  // namespace encase
