// SPDX-License-Identifier: MIT
//
// Every instruction set that this processor has gives the same answers: byte for byte where all
// crossings are proved to be rounded correctly and for sets that fuse products and sums, else the
// same facts.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstdio>
#include <string>
#include <vector>

#include "common/random_polynomials.hpp"
#include "encase/curves_file.hpp"
#include "encase/encasement.hpp"
#include "encase/result_json.hpp"
#include "encased.hpp"

namespace encase {
namespace {

/// Lets only one instruction set be chosen while it lives.
class OnlyTarget {
 public:
  explicit OnlyTarget(int64_t target) { choose(target); }
  ~OnlyTarget() { choose(0); }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;

 private:
  static void choose(int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

struct Input {
  std::string name;
  std::vector<NamedCurve> curves;
  Region region;
  bool generic = false;
};

std::vector<Input> inputs() {
  std::vector<Input> list;
  for (const int degree : {3, 4, 5, 7, 8, 9, 12}) {
    RandomOptions random;
    random.degree = degree;
    random.seed = 11 + degree;
    list.push_back(
        {"random " + std::to_string(degree), random_curves(random), encased::square(), true});
  }
  for (const char* name : {"cxy_7", "haas_drrs_sparse", "chebsuite_1_1", "y2_close_lines",
                           "degenerate_near_tangent_gap_1em12", "degenerate_tangent_circles_ext",
                           "degenerate_node_vs_line_through_node"}) {
    auto file = load_curves(ENCASE_TEST_DATA "/curves/" + std::string(name) + ".curves");
    EXPECT_TRUE(file.ok()) << name;
    if (file.ok()) list.push_back({name, file.value().curves, *file.value().region});
  }
  return list;
}

/// Whether nets are made with fused products and sums.
bool fuses(int64_t target) {
#if HWY_ARCH_X86
  return target <= HWY_AVX2;
#else
  return target != HWY_SCALAR && target != HWY_EMU128;
#endif
}

void expect_same_facts(const Encasement& a, const Encasement& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.cells.size(), b.cells.size());
  EXPECT_EQ(a.critical_regions.size(), b.critical_regions.size());
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  for (std::size_t k = 0; k < a.crossings.size(); ++k)
    EXPECT_TRUE(a.crossings[k].box.meets(b.crossings[k].box)) << k;
}

TEST(Portability, EveryInstructionSetGivesTheSameAnswers) {
  const std::vector<Input> list = inputs();
  std::vector<Encasement> expected;
  const std::vector<int64_t> targets = hwy::SupportedAndGeneratedTargets();
  ASSERT_FALSE(targets.empty());
  for (const int64_t target : targets) {
    std::printf("instruction set: %s\n", hwy::TargetName(target));
    const OnlyTarget only(target);
    ASSERT_EQ(hwy::SupportedAndGeneratedTargets(), std::vector<int64_t>{target});
    for (std::size_t k = 0; k < list.size(); ++k) {
      SCOPED_TRACE(list[k].name + " with " + hwy::TargetName(target));
      const auto result = encase(list[k].curves, list[k].region);
      ASSERT_TRUE(result.ok()) << result.error().message;
      const bool degenerate = list[k].name.rfind("degenerate_tangent", 0) == 0 ||
                              list[k].name.rfind("degenerate_node", 0) == 0;
      EXPECT_EQ(result.value().outcome, degenerate ? Outcome::Degenerate : Outcome::Certified);
      encased::expect_verified(result.value());
      if (k == expected.size()) expected.push_back(result.value());
      expect_same_facts(result.value(), expected[k]);
      if (list[k].generic || fuses(target)) {
        EXPECT_EQ(to_json(result.value()), to_json(expected[k]));
      }
    }
  }
  EXPECT_EQ(expected.size(), list.size());
}

TEST(Portability, AScalarPathIsAmongThem) {
  EXPECT_NE(HWY_TARGETS & (HWY_EMU128 | HWY_SCALAR | HWY_NEON), 0);
}

}  // namespace
}  // namespace encase
