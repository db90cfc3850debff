// SPDX-License-Identifier: MIT
//
// What starts at MPFR gives the same answers as what starts at doubles.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/random_polynomials.hpp"
#include "encase/curves_file.hpp"
#include "encased.hpp"

namespace encase {
namespace {

/// Every crossing of one has just one of the same pair in the other whose box meets its own.
void expect_same_crossings(const Encasement& one, const Encasement& other) {
  ASSERT_EQ(one.crossings.size(), other.crossings.size());
  for (const Crossing& a : one.crossings) {
    int met = 0;
    for (const Crossing& b : other.crossings) met += a.curves == b.curves && a.box.meets(b.box);
    EXPECT_EQ(met, 1);
  }
}

void expect_same_from(int bits, const std::vector<NamedCurve>& curves, const Region& region) {
  const Encasement usual = encased::run_curves(curves, region);
  EncaseOptions options;
  options.start_bits = bits;
  const Encasement careful = encased::run_curves(curves, region, options);
  EXPECT_EQ(careful.outcome, usual.outcome);
  EXPECT_EQ(careful.region_used.corners, usual.region_used.corners);
  expect_same_crossings(usual, careful);
  // Nothing was expanded in doubles.
  EXPECT_GT(careful.statistics.expansions, 0);
  EXPECT_EQ(careful.statistics.mpfr_expansions, careful.statistics.expansions);
  EXPECT_LT(usual.statistics.mpfr_expansions, usual.statistics.expansions);
}

class StartBits : public testing::TestWithParam<int> {};

TEST_P(StartBits, OfMpfrChangeNoAnswerForRandomCurves) {
  RandomOptions random;
  random.degree = GetParam();
  for (random.seed = 1; random.seed <= 3; ++random.seed)
    expect_same_from(106, random_curves(random), encased::square());
}

INSTANTIATE_TEST_SUITE_P(Degrees, StartBits, testing::Range(2, 9),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(StartBits, OfMpfrChangeNoAnswerForPublishedCurves) {
  for (const std::string name : {"chebsuite_1_1", "chebsuite_1_4", "cxy_7", "haas_drrs_sparse",
                                 "degenerate_near_tangent_gap_1em12", "linyap_1"}) {
    SCOPED_TRACE(name);
    const auto file = load_curves(ENCASE_TEST_DATA "/curves/" + name + ".curves");
    ASSERT_TRUE(file.ok()) << file.error().message;
    expect_same_from(106, file.value().curves, *file.value().region);
  }
}

}  // namespace
}  // namespace encase
