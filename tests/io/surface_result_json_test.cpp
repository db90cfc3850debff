// SPDX-License-Identifier: MIT
#include "encase/surface_result_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "3d/encased_surfaces.hpp"

namespace encase {
namespace {

SurfaceEncasement sample() {
  return encased_surfaces({"x^2+y^2+z^2-1", "z-x/7-1/9", "x-y/5-1/10"}, 2);
}

TEST(SurfaceResultJson, ReadsBackTheSameBytes) {
  const std::string text = to_json(sample());
  const auto read = surfaces_from_json(text, "sample.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(to_json(read.value().encasement), text);
  EXPECT_EQ(read.value().encasement.triple_points.size(), 2u);
}

TEST(SurfaceResultJson, ReadsBackMeshes) {
  const SurfaceEncasement e = sample();
  SurfaceMeshOptions options;
  options.tolerance = 0.05;
  auto meshes = mesh(e, options);
  ASSERT_TRUE(meshes);
  meshes.value()[1].distances[0] = std::numeric_limits<double>::infinity();
  const std::string text = to_json(e, nullptr, meshes.value());
  const auto read = surfaces_from_json(text, "sample.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(to_json(read.value().encasement, nullptr, read.value().meshes) == text);
  ASSERT_EQ(read.value().meshes.size(), 3u);
  EXPECT_TRUE(read.value().meshes[0].isotopic);
  EXPECT_TRUE(std::isinf(read.value().meshes[1].distances[0]));
  EXPECT_EQ(check(read.value().meshes[0], read.value().encasement), "");
  const nlohmann::json good = nlohmann::json::parse(text);
  const auto refused = [&](const char* pointer, const nlohmann::json& value) {
    nlohmann::json bad = good;
    bad[nlohmann::json::json_pointer(pointer)] = value;
    return !surfaces_from_json(bad.dump(), "bad.json");
  };
  EXPECT_TRUE(refused("/meshes/0/surface", 3));
  EXPECT_TRUE(refused("/meshes/0/triangles/0/1", 1000000));
  EXPECT_TRUE(refused("/meshes/0/cells/0", -1));
  EXPECT_TRUE(refused("/meshes/0/normals", nlohmann::json::array()));
  EXPECT_TRUE(refused("/meshes/0/isotopic", 1));
  EXPECT_TRUE(refused("/meshes/0/points/0/0", nullptr));
}

TEST(SurfaceResultJson, ReadsBackWhatIsDegenerate) {
  auto result = encase({{"planes", written::polynomial<3>("x*y")}},
                       make_box({-1, -1, -1}, {1, 1, 1}).value());
  ASSERT_TRUE(result);
  SurfaceEncasement& e = result.value();
  ASSERT_FALSE(e.degenerate.empty());
  e.perturbation = 0.25;
  e.seed = 7;
  const std::string text = to_json(e);
  const auto read = surfaces_from_json(text, "sample.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(to_json(read.value().encasement) == text);  // (too long to be compared by gtest)
  EXPECT_EQ(read.value().encasement.degenerate[0].cells, e.degenerate[0].cells);
  EXPECT_EQ(read.value().encasement.perturbation, 0.25);
  EXPECT_EQ(read.value().encasement.seed, 7u);
}

TEST(SurfaceResultJson, RefusesWhatRefersToNothing) {
  const nlohmann::json good = nlohmann::json::parse(to_json(sample()));
  const auto refused = [&](const char* pointer, const nlohmann::json& value) {
    nlohmann::json bad = good;
    bad[nlohmann::json::json_pointer(pointer)] = value;
    const auto read = surfaces_from_json(bad.dump(), "bad.json");
    return !read && read.error().code == Error::Code::BadInput &&
           read.error().message.find("bad.json: ") == 0;
  };
  EXPECT_TRUE(refused("/command", "curves"));
  EXPECT_TRUE(refused("/version", 2));
  EXPECT_TRUE(refused("/cells/0/facets/0", 100000));
  EXPECT_TRUE(refused("/cells/0/signs", nlohmann::json::array()));
  EXPECT_TRUE(refused("/facets/0/plane", -1));
  EXPECT_TRUE(refused("/facets/0/side_planes", nlohmann::json::array()));
  EXPECT_TRUE(refused("/points/0/surfaces", {2, 1, 0}));
  EXPECT_TRUE(refused("/history/0/1", 0));
  EXPECT_TRUE(refused("/certificates/graphs/0/box", 7));
  EXPECT_FALSE(surfaces_from_json("{", "bad.json"));
}

TEST(SurfaceSummary, CountsCurvesAndShapes) {
  const auto summary =
      nlohmann::json::parse(summary_json(encased_surfaces({"x^2+y^2+z^2-1", "z-1/3"}, 2)));
  EXPECT_EQ(summary["status"], "certified");
  EXPECT_EQ(summary["surfaces"], 2);
  EXPECT_EQ(summary["points"], 0);
  EXPECT_EQ(summary["intersection_curves"], 1);
  EXPECT_EQ(summary["closed_curves"], 1);
  EXPECT_EQ(summary["euler"], nlohmann::json({2, 1}));
  EXPECT_EQ(summary["components"], nlohmann::json({1, 1}));
}

}  // namespace
}  // namespace encase
