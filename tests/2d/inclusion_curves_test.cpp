// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "encase/arrangement.hpp"
#include "encase/caps.hpp"
#include "encase/crossing.hpp"
#include "encase/encasement.hpp"
#include "encase/result_json.hpp"
#include "encase/tracing.hpp"
#include "encase/verify.hpp"
#include "inclusions.hpp"
#include "written.hpp"

namespace encase {
namespace {

using Coordinates = std::array<inclusions::Jet<2>, 2>;

/// x^2 + y^2 - 1
Function<2> circle() {
  return inclusions::of<2>([](const Coordinates& x) { return square(x[0]) + square(x[1]) - 1; });
}
/// exp(-x^2) - y - 1/4
Function<2> bump() {
  return inclusions::of<2>([](const Coordinates& x) { return exp(-square(x[0])) - x[1] - 0.25; });
}

const Region kSquare = make_region(-2, 2, -2, 2).value();

Encasement encased(std::vector<NamedCurve> curves) {
  auto result = encase(curves, kSquare);
  EXPECT_TRUE(result) << result.error().message;
  EXPECT_EQ(result.value().outcome, Outcome::Certified);
  const Verification proof = verify(result.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return std::move(result).value();
}

TEST(InclusionCurves, CrossOneAnotherAndPolynomials) {
  const Function<2> line = written::polynomial<2>("y-x/3-1/9");
  const Encasement e = encased({{"circle", circle()}, {"bump", bump()}, {"line", line}});
  const Encasement other =
      encased({{"circle", written::polynomial<2>("x^2+y^2-1")}, {"bump", bump()}, {"line", line}});
  EXPECT_EQ(e.crossings.size(), 5u);
  EXPECT_EQ(e.crossings.size(), other.crossings.size());
  EXPECT_EQ(arrange(e).value().faces.size(), arrange(other).value().faces.size());
  EXPECT_TRUE(trace(e, arrange(e).value(), {}));
}

TEST(InclusionCurves, ACrossingIsRefinedAsFarAsDoublesGo) {
  const Encasement e = encased({{"circle", circle()}, {"bump", bump()}});
  ASSERT_EQ(e.crossings.size(), 2u);
  EXPECT_TRUE(refine(e, 0, 40));
  EXPECT_FALSE(refine(e, 0, 200));
}

TEST(InclusionCurves, CapsFindsThem) {
  CapsOptions options;
  options.epsilon = 0.01;
  const auto result = caps({{"circle", circle()}, {"bump", bump()}}, kSquare, options);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(verify(result.value()).ok());
  EXPECT_FALSE(result.value().leaves.empty());
}

TEST(InclusionCurves, HaveNoPlaceInTheWholePlaneNorInFiles) {
  Region plane;
  plane.plane = true;
  EXPECT_FALSE(encase({{"circle", circle()}}, plane));
  const auto read = encasement_from_json(to_json(encased({{"circle", circle()}})), "circle.json");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("given by an inclusion function"), std::string::npos);
}

TEST(InclusionCurves, ADoublePointStaysOpen) {
  const Function<2> node = inclusions::of<2>(
      [](const Coordinates& x) { return square(x[0] - 0.3) - square(x[1] - 0.2); });
  const auto result = encase({{"node", node}}, kSquare);
  ASSERT_TRUE(result);
  EXPECT_NE(result.value().outcome, Outcome::Certified);
}

}  // namespace
}  // namespace encase
