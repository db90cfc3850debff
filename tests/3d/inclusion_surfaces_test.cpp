// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/filtered_function.hpp"
#include "encase/common_points.hpp"
#include "encase/intersection_curves.hpp"
#include "encase/space_arrangement.hpp"
#include "encase/surface_mesh.hpp"
#include "encase/surface_result_json.hpp"
#include "encase/surface_topology.hpp"
#include "inclusions.hpp"
#include "io/expression_parser.hpp"
#include "written.hpp"

namespace encase {
namespace {

const Polyhedron kCube = make_box({-2, -2, -2}, {2, 2, 2}).value();

Function<3> expression(const std::string& text) {
  return std::get<Expression>(parse_expression<3>(text));
}

const char* const kSphere = "x^2+y^2+z^2-1";
const char* const kTorus = "(x^2+y^2+z^2+3/4)^2-4*(x^2+y^2)";
const char* const kDrops = "exp(-4*((x-1/2)^2+y^2+z^2))+exp(-4*((x+1/2)^2+y^2+z^2))-3/8";

/// A certified and verified encasement.
SurfaceEncasement encased(const std::vector<Function<3>>& functions,
                          const Polyhedron& region = kCube) {
  std::vector<NamedSurface> surfaces;
  for (const Function<3>& f : functions)
    surfaces.push_back({"s" + std::to_string(surfaces.size()), f});
  auto result = encase(surfaces, region);
  EXPECT_TRUE(result) << result.error().message;
  EXPECT_EQ(result.value().outcome, Outcome::Certified);
  const Verification proof = verify(result.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return std::move(result).value();
}

/// What of two scenes has to agree: the shapes of the surfaces, their curves, and the regions.
void expect_same_topology(const SurfaceEncasement& a, const SurfaceEncasement& b) {
  const auto shapes = surface_topology(a), others = surface_topology(b);
  ASSERT_EQ(shapes.size(), others.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    EXPECT_EQ(shapes[k].components, others[k].components);
    EXPECT_EQ(shapes[k].euler, others[k].euler);
    EXPECT_EQ(shapes[k].boundary_loops, others[k].boundary_loops);
  }
  const auto closed = [](const SurfaceEncasement& e) {
    std::vector<bool> kinds;
    for (const IntersectionCurve& curve : intersection_curves(e)) kinds.push_back(curve.closed);
    return kinds;
  };
  EXPECT_EQ(closed(a), closed(b));
  EXPECT_EQ(a.triple_points.size(), b.triple_points.size());
  const auto of_a = arrange(a), of_b = arrange(b);
  ASSERT_TRUE(of_a && of_b);
  EXPECT_EQ(of_a.value().regions.size(), of_b.value().regions.size());
}

TEST(InclusionSurfaces, HaveTheShapeOfTheSameFunctionWritten) {
  const std::vector<std::pair<InclusionFunction<3>, Function<3>>> pairs{
      {inclusions::sphere(), written::polynomial<3>(kSphere)},
      {inclusions::torus(), written::polynomial<3>(kTorus)},
      {inclusions::drops(), expression(kDrops)}};
  for (const auto& [inclusion, function] : pairs)
    expect_same_topology(encased({inclusion}), encased({function}));
}

TEST(InclusionSurfaces, MeetPolynomialsAndExpressionsInTheSameCurves) {
  const Function<3> saddle = written::polynomial<3>("z-x*y-1/9"),
                    wave = expression("z-sin(2*x+1/5)/3");
  expect_same_topology(encased({inclusions::sphere(), saddle}),
                       encased({written::polynomial<3>(kSphere), saddle}));
  expect_same_topology(encased({inclusions::drops(), wave}), encased({expression(kDrops), wave}));
}

TEST(InclusionSurfaces, MeetOneAnotherInTheSamePointsAndRegions) {
  const Function<3> tilted = written::polynomial<3>("x+y/3-z/2-1/7");
  const SurfaceEncasement e = encased({inclusions::sphere(), inclusions::torus(), tilted});
  expect_same_topology(
      e, encased({written::polynomial<3>(kSphere), written::polynomial<3>(kTorus), tilted}));
  EXPECT_GT(e.triple_points.size(), 0u);
}

TEST(InclusionSurfaces, AreCutByPlanesThatAreNotParallelToAnAxis) {
  // The chain rule: facets of an oblique region, and slices.
  const Polyhedron wedge =
      make_polyhedron({{1, 2, 3, -2}, {-1, 0, 0, -2}, {0, -1, 0, -2}, {0, 0, -1, -2}}).value();
  expect_same_topology(encased({inclusions::drops()}, wedge), encased({expression(kDrops)}, wedge));
  const std::array<Rational, 4> plane{1, Rational(1, 3), Rational(1, 7), Rational(1, 11)};
  const auto of = [&](Function<3> f) {
    const auto result = slice({{"torus", std::move(f)}}, kCube, plane);
    EXPECT_TRUE(result) << result.error().message;
    EXPECT_EQ(result.value().encasement.outcome, Outcome::Certified);
    EXPECT_TRUE(verify(result.value()).ok());
    return arrange(result.value().encasement).value().faces.size();
  };
  EXPECT_EQ(of(inclusions::torus()), of(written::polynomial<3>(kTorus)));
}

TEST(InclusionSurfaces, AreMeshedAndTraced) {
  const SurfaceEncasement e =
      encased({inclusions::sphere(), written::polynomial<3>("z-x*y/3-1/9")});
  SurfaceMeshOptions options;
  options.tolerance = 0.02;
  const auto meshes = mesh(e, options);
  ASSERT_TRUE(meshes) << meshes.error().message;
  EXPECT_EQ(check(meshes.value()[0], e), "");
  EXPECT_EQ(meshes.value()[0].euler, 2);
  EXPECT_LE(meshes.value()[0].distance, 0.02);
  const auto traced = trace(e);
  ASSERT_TRUE(traced);
  EXPECT_TRUE(traced.value().within_tolerance);
}

TEST(InclusionSurfaces, CommonPointsAreFound) {
  const auto all = [](Function<3> f) {
    const auto result =
        common_points({NamedSurface{"a", std::move(f)},
                       NamedSurface{"b", written::polynomial<3>("x^2+2*y^2+3*z^2-3/2")},
                       NamedSurface{"c", written::polynomial<3>("3*x^2+y^2/2+z^2/3-2")}},
                      kCube);
    EXPECT_TRUE(result);
    EXPECT_EQ(result.value().outcome, Outcome::Certified);
    EXPECT_TRUE(verify(result.value()).ok());
    return result.value().points;
  };
  const auto points = all(inclusions::sphere()), others = all(written::polynomial<3>(kSphere));
  ASSERT_EQ(points.size(), others.size());
  EXPECT_EQ(points.size(), 8u);
  for (const CommonPoint& p : points)
    EXPECT_EQ(std::count_if(others.begin(), others.end(),
                            [&](const CommonPoint& q) { return p.box.meets(q.box); }),
              1);
}

TEST(InclusionSurfaces, ASingularPointStaysOpenWithItsBox) {
  const Function<3> cone = inclusions::of<3>([](const inclusions::Coordinates& x) {
    return square(x[0] - 0.25) + square(x[1]) - square(x[2]);
  });
  SurfaceOptions options;
  options.max_cells = 3000;
  const auto result = encase({{"cone", cone}}, kCube, options);
  ASSERT_TRUE(result);
  const SurfaceEncasement& e = result.value();
  EXPECT_NE(e.outcome, Outcome::Certified);
  bool found = false;
  for (const auto* list : {&e.degenerate, &e.undecided})
    for (const UnresolvedInSpace& u : *list)
      found = found || (u.has_box && u.box.contains(Point<3>{0.25, 0, 0}));
  EXPECT_TRUE(found);
  EXPECT_TRUE(verify(e).ok());
}

/// The sphere's, but for x > 1/2 what `change` makes of it.
template <class Change>
Function<3> spoiled(Change change) {
  return InclusionFunction<3>([inner = inclusions::sphere(), change](const Box<3>& box) {
    Enclosure<3> e = inner(box);
    if (box.hi[0] > 0.5) change(e);
    return e;
  });
}

TEST(InclusionSurfaces, WhatIsWrongEverywhereIsAnError) {
  const auto message = [](InclusionFunction<3> f) {
    const auto result = encase({{"bad", Function<3>(std::move(f))}}, kCube);
    EXPECT_FALSE(result);
    return result ? "" : result.error().message;
  };
  EXPECT_EQ(message([](const Box<3>&) -> Enclosure<3> { throw std::runtime_error("no licence"); }),
            "the inclusion function of surface 'bad' throws: no licence");
  EXPECT_EQ(message([](const Box<3>&) {
              Enclosure<3> e;
              e.value = {1, -1};
              return e;
            }),
            "the inclusion function of surface 'bad' gives an interval that is empty or has an end "
            "that is not a number");
  EXPECT_NE(message({}), "");
}

TEST(InclusionSurfaces, WhereNothingIsKnownNothingIsProved) {
  SurfaceOptions options;
  options.max_cells = 500;
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  const std::vector<Function<3>> all{
      spoiled([](Enclosure<3>& e) { e = Enclosure<3>{}; }),
      spoiled([&](Enclosure<3>& e) { e.hessian[0][1].lo = -infinite; }),
      spoiled([&](Enclosure<3>& e) {
        e.value = {-infinite, infinite};
      })};
  for (const Function<3>& f : all) {
    const auto result = encase({{"sphere", f}}, kCube, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result.value().outcome, Outcome::Undecided);
    EXPECT_TRUE(verify(result.value()).ok());
    for (const SpaceCell& cell : result.value().cells)
      EXPECT_FALSE(cell.state == CellState::Certified && cell.box.hi[0] > 0.75);
  }
  // What the first look does not meet.
  int calls = 0;
  const auto late = [&](Enclosure<3>& e) {
    if (++calls > 2) e.gradient[2] = {nan, 1};
  };
  const Function<3> throwing = spoiled([&](Enclosure<3>&) {
    if (++calls > 2) throw 1;
  });
  for (const Function<3>& f : {spoiled(late), throwing}) {
    calls = 0;
    const auto result = encase({{"sphere", f}}, kCube, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result.value().outcome, Outcome::Undecided);
  }
}

TEST(InclusionSurfaces, AFileSaysThatItCannotHoldThem) {
  const SurfaceEncasement e = encased({inclusions::sphere()});
  const auto read = surfaces_from_json(to_json(e), "sphere.json");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("given by an inclusion function"), std::string::npos)
      << read.error().message;
}

TEST(InclusionSurfaces, AnotherFunctionThanTheFacetsIsNoticed) {
  SurfaceEncasement e = encased({inclusions::sphere()});
  e.input[0].function = e.surfaces[0].function = inclusions::sphere();  // its own, not a copy
  EXPECT_FALSE(verify(e).ok());
}

TEST(InclusionSurfaces, NetsHoldTheFunctionAndItsDerivatives) {
  // Against the same polynomial, exactly, at random points of random boxes and on segments.
  std::mt19937_64 random(3);
  const auto uniform = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
  const FilteredFunction<3> f{Function<3>(inclusions::torus())};
  const Polynomial<3> exact = written::polynomial<3>(kTorus);
  Kernel kernel;
  for (int round = 0; round < 200; ++round) {
    Point<3> center{uniform(), uniform(), uniform()}, half;
    for (double& h : half) h = 0.25 + 0.2 * uniform();
    const auto& local = f.inclusion().local(center, half, kernel);
    const auto& model = local.model;
    ASSERT_TRUE(model.exists());
    Point<3> s{uniform(), uniform(), uniform()};
    if (round % 2 == 0)  // most is lacking at corners
      for (double& coordinate : s) coordinate = coordinate < 0 ? -1 : 1;
    RationalPoint<3> x;
    for (int i = 0; i < 3; ++i) x[i] = Rational(center[i]) + Rational(half[i]) * Rational(s[i]);
    const auto at = [&](int i, int j, int k) { return model.c[(i * 3 + j) * 3 + k]; };
    double value = at(0, 0, 0), slope = at(1, 0, 0) + 2 * at(2, 0, 0) * s[0];
    value += at(1, 0, 0) * s[0] + at(0, 1, 0) * s[1] + at(0, 0, 1) * s[2];
    value += at(2, 0, 0) * s[0] * s[0] + at(0, 2, 0) * s[1] * s[1] + at(0, 0, 2) * s[2] * s[2];
    value += at(1, 1, 0) * s[0] * s[1] + at(1, 0, 1) * s[0] * s[2] + at(0, 1, 1) * s[1] * s[2];
    slope += at(1, 1, 0) * s[1] + at(1, 0, 1) * s[2];
    EXPECT_LE(std::fabs(exact(x).get_d() - value), model.error * (1 + 1e-9));
    EXPECT_LE(std::fabs(exact.derivative(0)(x).get_d() * half[0] - slope),
              local.slope_error[0] * (1 + 1e-9));
    EXPECT_LE(std::fabs(exact.derivative(0).derivative(0)(x).get_d() * half[0] * half[0] -
                        2 * at(2, 0, 0)),
              2 * model.error * (1 + 1e-9));
  }
}

}  // namespace
}  // namespace encase
