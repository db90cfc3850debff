// SPDX-License-Identifier: MIT
//
// Encasements of curves that are not polynomials: what the search finds is verified, agrees with an
// independent search in MPFR, and what is changed afterwards is refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "analytic_scenes.hpp"
#include "encase/arrangement.hpp"
#include "encase/tracing.hpp"
#include "encase/verify.hpp"
#include "located_points.hpp"
#include "mpfr_search.hpp"
#include "mutations.hpp"

namespace encase {
namespace {

using analytic::Scene;

std::string text(const Verification& verification) {
  std::string all;
  for (const std::string& objection : verification.objections) all += objection + "\n";
  return all;
}

void expect_verified(const Encasement& e) {
  const Verification verification = verify(e);
  EXPECT_TRUE(verification.ok()) << text(verification);
}

Encasement certified(const Scene& scene) {
  const Encasement e = encase(scene.curves, scene.region).value();
  EXPECT_EQ(e.outcome, Outcome::Certified) << scene.name;
  return e;
}

RationalBox exactly(const Box<2>& box) {
  RationalBox result;
  for (int i = 0; i < 2; ++i) {
    result.lo[i] = box.lo[i];
    result.hi[i] = box.hi[i];
  }
  return result;
}
bool inside(const RationalBox& inner, const RationalBox& outer) {
  for (int i = 0; i < 2; ++i)
    if (inner.lo[i] < outer.lo[i] || inner.hi[i] > outer.hi[i]) return false;
  return true;
}

/// The crossings of a pair are the common zeros that a search in MPFR finds, one by one.
void expect_all_crossings(const Encasement& e, int first, int second) {
  mpfr_search::System system(e.curves[first].function, e.curves[second].function);
  const auto zeros = system.common_zeros(exactly(e.region_used.bounding_box()));
  std::vector<int> hits(zeros.size(), 0);
  std::size_t count = 0;
  for (const Crossing& c : e.crossings) {
    if (c.curves != std::array{first, second}) continue;
    ++count;
    for (std::size_t k = 0; k < zeros.size(); ++k) hits[k] += inside(exactly(c.box), zeros[k]);
  }
  EXPECT_EQ(count, zeros.size());
  EXPECT_EQ(hits, std::vector<int>(zeros.size(), 1));
}

/// Refined to 200 bits, all crossings are where MPFR at another precision proves a zero.
void expect_refines(const Encasement& e) {
  constexpr int kBits = 200;
  Rational width = 1;
  width >>= kBits;
  for (std::size_t k = 0; k < e.crossings.size(); ++k) {
    const auto box = refine(e, static_cast<int>(k), kBits);
    ASSERT_TRUE(box.ok()) << box.error().message;
    RationalBox around = box.value();
    EXPECT_TRUE(inside(around, exactly(e.crossings[k].box)));
    for (int i = 0; i < 2; ++i) {
      EXPECT_LE(around.hi[i] - around.lo[i], width);
      around.lo[i] -= 4 * width;
      around.hi[i] += 4 * width;
    }
    const auto& curves = e.crossings[k].curves;
    mpfr_search::System system(e.curves[curves[0]].function, e.curves[curves[1]].function, 500);
    EXPECT_TRUE(system.holds_one_zero(around)) << "crossing " << k;
  }
}

/// The polylines are within the tolerance and have the arrangement's topology; their points on
/// curves are close to zeros.
void expect_traces(const Encasement& e, const Arrangement& a) {
  TraceOptions options;
  options.tolerance = 1e-4;
  const Tracing tracing = trace(e, a, options).value();
  EXPECT_TRUE(tracing.within_tolerance);
  EXPECT_TRUE(tracing.same_topology);
  for (std::size_t k = 0; k < a.edges.size(); ++k) {
    if (a.edges[k].curve < 0) continue;
    const Function<2>& f = e.curves[a.edges[k].curve].function;
    const ExpressionProgram<2> program(f.is_polynomial() ? Expression(f.polynomial())
                                                         : f.expression());
    ExpressionProgram<2>::Workspace<Interval> workspace;
    for (const Point<2>& p : tracing.edges[k].points) {
      const auto jet = program.value_and_gradient(intervals<2>(Box<2>{p, p}), workspace).jet;
      const double slope = std::hypot(jet.first(0).mid(), jet.first(1).mid());
      EXPECT_LE(std::fabs(jet.value().mid()), 1e-9 * (1 + slope));
    }
  }
}

void expect_all(const Encasement& e) {
  expect_verified(e);
  for (int i = 0; i < static_cast<int>(e.curves.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(e.curves.size()); ++j) expect_all_crossings(e, i, j);
  expect_refines(e);
  const Arrangement a = located_points::arranged(e);
  located_points::expect_locates(e, a, 100, 7);
  expect_traces(e, a);
}

class AnalyticScene : public testing::TestWithParam<Scene> {};

TEST_P(AnalyticScene, IsCertifiedAndAllOfItIsProvedAgain) { expect_all(certified(GetParam())); }

std::string name_of(const testing::TestParamInfo<Scene>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all = analytic::simple_scenes();
  all.push_back(analytic::cosines());
  all.push_back(analytic::waves());
  for (Scene& scene : analytic::suite()) all.push_back(std::move(scene));
  return all;
}

INSTANTIATE_TEST_SUITE_P(Analytic, AnalyticScene, testing::ValuesIn(scenes()), name_of);

}  // namespace
}  // namespace encase
