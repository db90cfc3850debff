// SPDX-License-Identifier: MIT
//
// The curves of tests/data/curves, from the literature: each is answered within a minute as
// expected.json there says, and the answer is verified.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "encase/curves_file.hpp"
#include "encase/encasement.hpp"
#include "encase/verify.hpp"

namespace encase {
namespace {

const nlohmann::json& expected() {
  static const auto json =
      nlohmann::json::parse(std::ifstream(ENCASE_TEST_DATA "/curves/expected.json"));
  return json;
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const auto& [name, unused] : expected().items()) list.push_back(name);
  return list;
}

const char* name(Outcome outcome) {
  return outcome == Outcome::Certified    ? "certified"
         : outcome == Outcome::Degenerate ? "degenerate"
                                          : "undecided";
}

class Literature : public testing::TestWithParam<std::string> {};

TEST_P(Literature, IsAnsweredAsExpectedAndVerified) {
  const auto file = load_curves(ENCASE_TEST_DATA "/curves/" + GetParam() + ".curves");
  ASSERT_TRUE(file.ok()) << file.error().message;
  ASSERT_TRUE(file.value().region.has_value());
  const auto result = encase(file.value().curves, *file.value().region);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const Encasement& encasement = result.value();

  const auto& entry = expected().at(GetParam());
  const auto& statuses = entry.at("status");
  EXPECT_TRUE(std::find(statuses.begin(), statuses.end(), name(encasement.outcome)) !=
              statuses.end())
      << name(encasement.outcome) << ", not " << statuses;
  if (entry.contains("crossings")) {
    const auto inside =
        std::count_if(encasement.crossings.begin(), encasement.crossings.end(),
                      [](const Crossing& c) { return c.location != Location::Outside; });
    EXPECT_EQ(inside, entry.at("crossings").get<int>());
  }
  EXPECT_LT(encasement.seconds, 60);
  for (const std::string& objection : verify(encasement).objections) ADD_FAILURE() << objection;
}

INSTANTIATE_TEST_SUITE_P(Files, Literature, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace encase
