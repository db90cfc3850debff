// SPDX-License-Identifier: MIT
#include "encase/caps_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "encase/curves_file.hpp"
#include "encase/result_json.hpp"
#include "encase/verify.hpp"

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

TEST(CapsJson, ReadsBackToTheSame) {
  for (const bool self_crossings : {false, true}) {
    const std::string text = to_json(sample(self_crossings));
    const Result<CapsResult> read = caps_from_json(text, "file");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_json(read.value()), text);
    EXPECT_TRUE(verify(read.value()).ok());
    const Result<AnyResult> any = any_result_from_json(text, "file");
    ASSERT_TRUE(any);
    EXPECT_TRUE(std::holds_alternative<CapsResult>(any.value()));
  }
}

TEST(CapsJson, WhatIsNoResultIsRefused) {
  const Json json = Json::parse(to_json(sample()));
  const auto refused = [&](const std::string& pointer, const Json& value,
                           const std::string& message) {
    Json other = json;
    other[Json::json_pointer(pointer)] = value;
    const auto read = caps_from_json(other.dump(), "file");
    ASSERT_FALSE(read) << pointer;
    EXPECT_EQ(read.error().code, Error::Code::BadInput);
    EXPECT_EQ(read.error().message, "file: " + message);
  };
  refused("/command", "curves", "command: expected a result of 'caps'");
  refused("/format", "result", "format: this is not a result of encase");
  refused("/version", 2, "version: this version of encase reads version 1 only");
  refused("/status", "certified", "status: unknown word 'certified'");
  refused("/cut/0", 0.5, "cut: boxes are cut elsewhere by this version of encase");
  refused("/tokens", Json::array({-1, 0}), "tokens: the quadtree is not complete");
  refused("/tokens", Json::array({0, 0}), "tokens[1]: the quadtree has ended");
  refused("/tokens", Json::array({-1, 0, 0}), "tokens[2]: the leaf is there twice");
  refused("/tokens/1", -2,
          "tokens[1]: expected an integer from -1 to " + std::to_string(json["leaves"].size() - 1));
  refused("/leaves/0/4", 2, "leaves[0][4]: expected an integer from 0 to 1");
  refused("/leaves/0/2", 99,
          "leaves[0][2]: expected an integer from 0 to " +
              std::to_string(json["curve_sets"].size() - 1));
  refused("/curves/0/expression", "x + 'y'",
          "curves[0].expression: at character 5: unexpected character '''");
  refused("/edges/0/vertices/0", 99,
          "edges[0].vertices[0]: expected an integer from 0 to " +
              std::to_string(json["vertices"].size() - 1));
  const auto curves = result_from_json(json.dump(), "file");
  ASSERT_FALSE(curves);
  EXPECT_EQ(curves.error().message, "file: command: expected a result of 'curves' or 'slice'");
}

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
