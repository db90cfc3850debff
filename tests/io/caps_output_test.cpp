// SPDX-License-Identifier: MIT
#include "encase/caps_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "encase/curves_file.hpp"

namespace encase {
namespace {

using Json = nlohmann::json;

CapsResult sample(bool self_crossings = true) {
  CurvesFile file = read_curves(
                        "region: -2 3 -2 2\n"
                        "circle: x^2 + y^2 = 2\n"
                        "y = sin(2x)/2\n"
                        "x = 1/7\n",
                        "test")
                        .value();
  file.curves[1].name = "wave & co";
  CapsOptions options;
  options.epsilon = 1e-4;
  options.self_crossings = self_crossings;
  return caps(file.curves, *file.region, options).value();
}

TEST(CapsJson, HoldsTheResult) {
  const CapsResult r = sample();
  const Json json = Json::parse(to_json(r));
  EXPECT_EQ(json["format"], "encase-result");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["command"], "caps");
  EXPECT_EQ(json["status"], "exact");
  EXPECT_EQ(json["epsilon"], 1e-4);
  EXPECT_EQ(json["delta"], 2e-4);
  EXPECT_EQ(json["curves"].size(), 3U);
  EXPECT_EQ(json["curves"][1]["name"], "wave & co");
  for (const auto& curve : json["curves"])
    EXPECT_TRUE(parse_function(curve["expression"].get<std::string>()).ok());
  EXPECT_EQ(json["tokens"].size(), static_cast<std::size_t>(r.nodes));
  ASSERT_EQ(json["leaves"].size(), r.leaves.size());
  for (std::size_t k = 0; k < r.leaves.size(); ++k) {
    const Json& leaf = json["leaves"][k];
    EXPECT_EQ(leaf[1], r.leaves[k].depth);
    EXPECT_EQ(leaf[2], r.leaves[k].curves);
    EXPECT_EQ(leaf[3], r.leaves[k].region);
    EXPECT_EQ(leaf[4].is_null(), r.leaves[k].graph_axis < 0);
  }
  EXPECT_EQ(json["regions"].size(), r.regions.size());
  ASSERT_EQ(json["vertices"].size(), r.vertices.size());
  EXPECT_EQ(json["vertices"][0]["kind"], "crossing");
  ASSERT_EQ(json["edges"].size(), r.edges.size());
  EXPECT_EQ(json["edges"][0]["polyline"].size(), r.edges[0].polyline.size());
  EXPECT_EQ(json["statistics"]["nodes"], r.nodes);
}

TEST(CapsJson, IsTheSameEachTime) { EXPECT_EQ(to_json(sample()), to_json(sample())); }

TEST(CapsJson, SummaryCounts) {
  const CapsResult r = sample();
  const Json json = Json::parse(summary_json(r));
  EXPECT_EQ(json["status"], "exact");
  EXPECT_EQ(json["curves"], 3);
  EXPECT_EQ(json["crossings"], 5);
  EXPECT_EQ(json["vertices"], static_cast<int>(r.vertices.size()));
  EXPECT_EQ(json["edges"], json["proved_edges"]);
  int leaves = 0;
  for (const auto& [label, count] : json["leaves"].items()) leaves += count.get<int>();
  EXPECT_EQ(leaves, static_cast<int>(r.leaves.size()));
  EXPECT_GE(json["seconds"], json["tree_seconds"]);
}

TEST(CapsSvg, DrawsLeavesCurvesAndVertices) {
  const std::string svg = to_svg(sample());
  EXPECT_EQ(svg, to_svg(sample()));
  for (const char* part : {"id=\"leaves\"", "id=\"curves\"", "id=\"vertices\"", "id=\"axes\"",
                           "id=\"legend\"", "wave &amp; co", ">crossing<", ">leaves the box<"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
  CapsSvgOptions bare;
  bare.axes = bare.legend = false;
  EXPECT_EQ(to_svg(sample(), bare).find("id=\"axes\""), std::string::npos);
}

}  // namespace
}  // namespace encase
