// SPDX-License-Identifier: MIT
//
// Every instruction set that this processor has gives the same common points, bit by bit.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <vector>

#include "random_triples.hpp"

namespace encase {
namespace {

void choose(int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(PortabilityInSpace, EveryInstructionSetGivesTheSamePoints) {
  std::vector<std::array<NamedSurface, 3>> triples;
  for (int degree = 1; degree <= 8; ++degree)
    triples.push_back(named(random_triple(degree, 20 + static_cast<std::uint64_t>(degree))));
  triples.push_back({triples[3][0], triples[3][1], triples[5][2]});  // of unequal degrees
  std::vector<CommonPoints> expected;
  for (const auto& triple : triples) expected.push_back(common_points(triple, cube(1)).value());
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    choose(target);
    for (std::size_t k = 0; k < triples.size(); ++k) {
      const CommonPoints points = common_points(triples[k], cube(1)).value();
      EXPECT_EQ(points.tokens, expected[k].tokens) << hwy::TargetName(target);
      ASSERT_EQ(points.points.size(), expected[k].points.size());
      for (std::size_t i = 0; i < points.points.size(); ++i) {
        EXPECT_EQ(points.points[i].box, expected[k].points[i].box) << hwy::TargetName(target);
        EXPECT_EQ(points.points[i].point, expected[k].points[i].point);
      }
    }
  }
  choose(0);
}

}  // namespace
}  // namespace encase
