// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "encase/result_json.hpp"
#include "encase/verify.hpp"
#include "tests/encased.hpp"
#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

using Json = nlohmann::json;

/// A circle with a line through it, and a loop inside another one.
Encasement scene() {
  return encased::run(
      {"x^2 + y^2 - 1/4", "3 x - y - 1", "(x + 3/4)^2 + y^2 - 1/50", "(x + 3/4)^2 + y^2 - 1/100"});
}

/// What becomes of a changed text: refused where it is read, objected to, or accepted.
bool is_refused(const Json& json) {
  const Result<StoredResult> stored = result_from_json(json.dump(), "changed");
  if (!stored) {
    EXPECT_EQ(stored.error().code, Error::Code::BadInput);
    return true;
  }
  const StoredResult& result = stored.value();
  if (!result.arrangement) return false;
  // `verify` does this for the proved encasement, which the changes leave alone.
  return arrange(result.encasement).value() != *result.arrangement;
}

TEST(ArrangementJson, ReadsBackWhatItWrote) {
  for (const Encasement& e : {scene(), sample::circle_and_line(),
                              encased::run({"x^2 - y^2 - 1", "y - 3 x"}, whole_plane())}) {
    const Arrangement a = arrange(e).value();
    const std::string text = to_json(e, &a);
    const Result<StoredResult> back = result_from_json(text, "result.json");
    ASSERT_TRUE(back.ok()) << back.error().message;
    ASSERT_TRUE(back.value().arrangement.has_value());
    EXPECT_EQ(*back.value().arrangement, a);
    EXPECT_EQ(check(*back.value().arrangement), "");
    EXPECT_EQ(to_json(back.value().encasement, &*back.value().arrangement), text);
    // The rest of the result is as without.
    Json json = Json::parse(text);
    json.erase("arrangement");
    EXPECT_EQ(json, Json::parse(to_json(e)));
    EXPECT_FALSE(result_from_json(to_json(e), "result.json").value().arrangement.has_value());
  }
  const Encasement e = scene();
  const Arrangement a = arrange(e).value();
  EXPECT_TRUE(verify(e, *result_from_json(to_json(e, &a), "").value().arrangement).ok());
}

TEST(ArrangementJson, SaysWhatIsDocumented) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  const Json json = Json::parse(to_json(e, &a))["arrangement"];
  // Four corners, the line's two ends and two crossings; six edges on the boundary, three on the
  // line and two on the circle.
  ASSERT_EQ(json["vertices"].size(), 8u);
  ASSERT_EQ(json["edges"].size(), 11u);
  ASSERT_EQ(json["faces"].size(), 5u);
  ASSERT_EQ(json["components"].size(), 1u);
  EXPECT_EQ(json["components"][0]["vertices"], 8);
  EXPECT_EQ(json["components"][0]["edges"], 11);
  EXPECT_EQ(json["components"][0]["faces"].size(), 4u);
  EXPECT_EQ(json["vertices"][0]["kind"], "corner");
  EXPECT_EQ(json["vertices"][0]["x"], -1);
  int crossings = 0;
  for (const Json& vertex : json["vertices"]) {
    if (vertex["kind"] == "crossing") {
      ++crossings;
      EXPECT_EQ(vertex["x"], e.crossings[vertex["index"].get<int>()].point[0]);
      EXPECT_EQ(vertex["half_edges"].size(), 4u);
    }
    if (vertex["kind"] == "on_boundary") {
      // On the line y = x/5 + 1/20.
      const double x = vertex["x"], y = vertex["y"];
      EXPECT_EQ(std::fabs(x), 1);
      EXPECT_NEAR(y, x / 5 + 0.05, 1e-15);
    }
  }
  EXPECT_EQ(crossings, 2);
  // Half-edge 2 k runs along edge k with its first face to the left.
  for (const Json& face : json["faces"]) {
    std::vector<Json> cycles = face["holes"];
    if (!face["outer"].empty()) cycles.push_back(face["outer"]);
    for (const Json& cycle : cycles)
      for (const int h : cycle) EXPECT_EQ(json["edges"][h / 2]["faces"][h % 2], face["id"]);
  }
  EXPECT_EQ(json["faces"][0]["parent"], nullptr);
  EXPECT_EQ(json["outside"], 0);
  EXPECT_EQ(json["curve_components"][0]["closed"], true);
  EXPECT_EQ(json["curve_components"][0]["crossings"].size(), 2u);
}

TEST(ArrangementJson, RefusesEveryChangedValue) {
  const Encasement e = scene();
  const Arrangement a = arrange(e).value();
  const Json right = Json::parse(to_json(e, &a));
  ASSERT_FALSE(is_refused(right));
  int changes = 0;
  const Json flat = right["arrangement"].flatten();
  for (const auto& [path, value] : flat.items()) {
    std::vector<Json> others = {nullptr, "text", -1, 1000000, Json::object()};
    if (value.is_number_integer())
      others.insert(others.end(),
                    {value.get<int>() + 1, value.get<int>() - 1, value.get<int>() ^ 1});
    else if (value.is_number())
      others.push_back(value.get<double>() + 1e-12);
    else if (value.is_boolean())
      others.push_back(!value.get<bool>());
    else if (value.is_null())
      others.push_back(0);
    else if (value.is_string())
      others.insert(others.end(), {"corner", "crossing", "on_boundary"});
    for (const Json& other : others) {
      if (other == value) continue;
      Json changed = right;
      changed["arrangement"][Json::json_pointer(path)] = other;
      ASSERT_TRUE(is_refused(changed)) << path << ": " << value << " to " << other;
      ++changes;
    }
  }
  EXPECT_GT(changes, 2000);
}

TEST(ArrangementJson, RefusesListsThatAreShorterOrLonger) {
  const Encasement e = scene();
  const Arrangement a = arrange(e).value();
  const Json right = Json::parse(to_json(e, &a));
  int changes = 0;
  const std::function<void(const Json::json_pointer&, const Json&)> visit =
      [&](const Json::json_pointer& path, const Json& value) {
        if (value.is_object())
          for (const auto& [key, member] : value.items()) {
            visit(path / key, member);
            Json changed = right;
            changed["arrangement"].at(path).erase(key);
            EXPECT_TRUE(is_refused(changed)) << "without " << path / key;
          }
        if (!value.is_array()) return;
        for (std::size_t k = 0; k < value.size(); ++k) {
          visit(path / k, value[k]);
          Json changed = right;
          changed["arrangement"].at(path).erase(k);
          EXPECT_TRUE(is_refused(changed)) << "without " << path / k;
          changed = right;
          changed["arrangement"].at(path).push_back(value[k]);
          ASSERT_TRUE(is_refused(changed)) << path / k << " twice";
          changes += 2;
        }
      };
  visit(Json::json_pointer(), right["arrangement"]);
  EXPECT_GT(changes, 500);
}

TEST(ArrangementJson, SurvivesDamagedBytes) {
  const Encasement e = scene();
  const Arrangement a = arrange(e).value();
  const std::string text = to_json(e, &a);
  const std::size_t from = text.find("\"arrangement\""), to = text.find("\"statistics\"");
  ASSERT_LT(from, to);
  std::mt19937 random(4);
  int read = 0;
  for (int round = 0; round < 5000; ++round) {
    std::string damaged = text;
    for (int k = 0; k <= round % 3; ++k)
      damaged[from + random() % (to - from)] = "0123456789-[]{},\"ae.\0"[random() % 22];
    const Result<StoredResult> stored = result_from_json(damaged, "damaged");
    if (!stored || !stored.value().arrangement) continue;
    ++read;
    // Whatever it is, its parts can be followed.
    static_cast<void>(check(*stored.value().arrangement));
  }
  EXPECT_GT(read, 0);
}

TEST(ArrangementJson, NamesThePlaceOfAnError) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  const auto error_after = [&](const std::function<void(Json&)>& change) {
    Json json = Json::parse(to_json(e, &a));
    change(json["arrangement"]);
    const auto result = result_from_json(json.dump(), "r.json");
    return result ? std::string() : result.error().message;
  };
  EXPECT_EQ(error_after([](Json& j) { j["vertices"][0]["kind"] = "middle"; }),
            "r.json: arrangement.vertices[0].kind: unknown word 'middle'");
  EXPECT_EQ(error_after([](Json& j) { std::swap(j["faces"][1]["outer"], j["faces"][2]["outer"]); }),
            "r.json: arrangement.faces[1].outer[0]: the half-edge is not here or not only here");
  EXPECT_EQ(error_after([](Json& j) {
              j["faces"][1]["outer"] = Json::array();
            }).rfind("r.json: arrangement.faces: half-edge ", 0),
            0u);
  EXPECT_EQ(error_after([](Json& j) { j["faces"][2]["pieces"][0] = j["faces"][1]["pieces"][0]; }),
            "r.json: arrangement.faces[2].pieces: a piece belongs to one face");
  EXPECT_EQ(error_after([](Json& j) { j["edges"][2]["side"] = 0; }),
            "r.json: arrangement.edges[2]: an edge is on a curve or on a side");
}

}  // namespace
}  // namespace encase
