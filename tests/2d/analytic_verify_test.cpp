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
#include "encased.hpp"
#include "located_points.hpp"
#include "mpfr_search.hpp"
#include "mutations.hpp"
#include "objections.hpp"

namespace encase {
namespace {

using encased::expect_verified;

using analytic::Scene;

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

/// The crossings of a pair in the region, a rectangle, are the common zeros that a search in MPFR
/// finds, one by one. (Both may find some just outside.)
void expect_all_crossings(const Encasement& e, int first, int second) {
  mpfr_search::System system(e.curves[first].function, e.curves[second].function);
  const auto zeros = system.common_zeros(exactly(e.region_used.bounding_box()));
  std::vector<int> hits(zeros.size(), 0);
  for (const Crossing& c : e.crossings) {
    if (c.curves != std::array{first, second}) continue;
    int boxes = 0;
    for (std::size_t k = 0; k < zeros.size(); ++k)
      if (inside(exactly(c.box), zeros[k])) ++hits[k], ++boxes;
    if (c.location == Location::Inside) {
      EXPECT_EQ(boxes, 1);
    }
  }
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
      EXPECT_LE(std::fabs(jet.value().mid()), 1e-8 * (1 + slope));
    }
  }
}

void expect_all(const Encasement& e) {
  expect_verified(e);
  for (int i = 0; i < static_cast<int>(e.curves.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(e.curves.size()); ++j) expect_all_crossings(e, i, j);
  expect_refines(e);
  if (e.outcome != Outcome::Certified) return;
  const Arrangement a = located_points::arranged(e);
  located_points::expect_locates(e, a, 100, 7);
  expect_traces(e, a);
}

class AnalyticScene : public testing::TestWithParam<Scene> {};

TEST_P(AnalyticScene, IsProvedAgainAndAgreesWithMpfr) {
  const Scene& scene = GetParam();
  const Encasement e = encase(scene.curves, scene.region).value();
  expect_all(e);
  // Curves that are singular in the region.
  const bool singular =
      scene.name == "chebsuite_5_1" || scene.name == "chebsuite_9_1" || scene.name == "wagon_siam";
  EXPECT_EQ(e.outcome, singular ? Outcome::Degenerate : Outcome::Certified);
  for (const Unresolved& u : e.degenerate) EXPECT_EQ(u.kind, Unresolved::Kind::SingularPoint);
}

std::string name_of(const testing::TestParamInfo<Scene>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all = analytic::simple_scenes();
  all.push_back(analytic::cosines());
  all.push_back(analytic::cosines());
  all.back().name = "more cosines";
  all.back().region =
      make_region(Rational(-5, 2), Rational(5, 2), Rational(-5, 2), Rational(5, 2)).value();
  all.push_back(analytic::waves());
  for (Scene& scene : analytic::suite()) all.push_back(std::move(scene));
  return all;
}

INSTANTIATE_TEST_SUITE_P(Analytic, AnalyticScene, testing::ValuesIn(scenes()), name_of);

/// Three and more curves share a cover.
Scene four_curves() {
  using namespace analytic;
  Scene scene = simple_scenes()[0];
  scene.name = "four curves";
  scene.curves.push_back({"exponential", exp(x()) + y() - c(2)});
  scene.curves.push_back({"cosine", cos(x()) - y()});
  scene.curves.push_back({"line", Polynomial<2>::variable(0) * Polynomial<2>::constant(2) +
                                      Polynomial<2>::variable(1) +
                                      Polynomial<2>::constant(Rational(1, 3))});
  return scene;
}

TEST(AnalyticVerify, CurvesOfBothKindsShareACover) {
  const Scene scene = four_curves();
  const Encasement e = encase(scene.curves, scene.region).value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  EXPECT_FALSE(e.shared_cover.tokens.empty());
  expect_all(e);
}

TEST(AnalyticVerify, CurvesAreAdded) {
  const Scene scene = four_curves();
  const std::vector<NamedCurve> first(scene.curves.begin(), scene.curves.begin() + 2),
      more(scene.curves.begin() + 2, scene.curves.end());
  const Encasement earlier = encase(first, scene.region).value();
  const Encasement e = add_curves(earlier, more).value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  expect_all(e);
  const Encasement at_once = encase(scene.curves, scene.region).value();
  EXPECT_EQ(canonical_topology(arrange(e).value()), canonical_topology(arrange(at_once).value()));
}

TEST(AnalyticVerify, EqualExpressionsAreOneCurve) {
  Scene scene = analytic::simple_scenes()[0];
  scene.curves.push_back({"again", scene.curves[0].function});
  const Encasement e = encase(scene.curves, scene.region).value();
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  ASSERT_EQ(e.curves.size(), 2u);
  EXPECT_EQ(e.curves[0].sources, (std::vector<int>{0, 2}));
  expect_verified(e);
  const auto refused = [&](const std::string& reason, auto mutate) {
    Encasement mutant = e;
    mutate(mutant);
    EXPECT_NE(text(verify(mutant)).find(reason), std::string::npos) << text(verify(mutant));
  };
  refused("is not reported", [](auto& m) { m.degenerate.clear(); });
  refused("is not the function of its sources", [](auto& m) { m.curves[0].sources = {0}; });
}

TEST(AnalyticVerify, OtherCurvesThanThoseOfTheInputAreRefused) {
  using namespace analytic;
  const Scene scene = simple_scenes()[1];
  const Encasement e = encase(scene.curves, scene.region).value();
  const auto refused = [&](const std::string& reason, auto mutate) {
    Encasement mutant = e;
    mutate(mutant);
    EXPECT_NE(text(verify(mutant)).find(reason), std::string::npos) << reason << "\n"
                                                                    << text(verify(mutant));
  };
  const Expression f = scene.curves[0].function.expression();
  refused("is not the function of its sources",
          [&](auto& m) { m.curves[0].function = f + c(1, 1000); });
  // The same curve, but who would know.
  refused("is not the function of its sources", [&](auto& m) { m.curves[0].function = c(2) * f; });
  refused("is not that of one curve", [&](auto& m) { m.input[0].function = f * c(2); });
  refused("is not that of one curve", [&](auto& m) {
    m.input.push_back({"more", x() + sin(y())});
  });
  refused("is in no curve", [&](auto& m) {
    m.input.push_back({"more", Polynomial<2>::variable(0)});
  });
  refused("is not a polynomial of degree",
          [&](auto& m) { m.curves[0].function = Polynomial<2>::constant(1); });
  refused("is not an expression in x and y", [&](auto& m) { m.curves[0].function = sin(c(1)); });
  refused("is not an expression in x and y",
          [&](auto& m) { m.input[0].function = f + Expression::variable(2); });
  refused("nothing is proved of it in the whole plane", [](auto& m) {
    m.region.plane = true;
    m.region.corners.clear();
  });
}

class MutatedAnalytic : public testing::TestWithParam<int> {};

TEST_P(MutatedAnalytic, IsRefused) {
  const int seed = GetParam();
  const std::vector<Scene> scenes{analytic::simple_scenes()[1], analytic::waves(), four_curves()};
  const Scene& scene = scenes[static_cast<std::size_t>(seed) % scenes.size()];
  const Encasement e = encase(scene.curves, scene.region).value();
  ASSERT_TRUE(verify(e).ok());
  mutations::Mutator mutator(static_cast<std::uint64_t>(seed));
  for (int round = 0; round < 80; ++round) {
    Encasement mutant = e;
    const mutations::Mutation mutation = mutator.apply(mutant);
    const Verification verification = verify(mutant, {848, 1});
    EXPECT_TRUE(mutation.may_hold || !verification.ok()) << scene.name << ": " << mutation.what;
  }
  for (int round = 0; round < 40; ++round) {
    Encasement mutant = e;
    mutator.corrupt(mutant, 1 + round % 3);
    verify(mutant, {848, 1});  // whatever it says, it returns
  }
}

INSTANTIATE_TEST_SUITE_P(Analytic, MutatedAnalytic, testing::Range(0, 6));

}  // namespace
}  // namespace encase
