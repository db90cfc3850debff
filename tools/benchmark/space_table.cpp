// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include "3d/pair_critical_points.hpp"
#include "common/isolate_roots.hpp"
#include "common/random_polynomials.hpp"
#include "encase/intersection_curves.hpp"
#include "encase/space_arrangement.hpp"
#include "space_floor.hpp"
#include "tables.hpp"

namespace encase::benchmark {
namespace {

constexpr double kMicro = 1e6, kMilli = 1e3;
constexpr int kHighest = 6;
const Box<3> kCube{{-1, -1, -1}, {1, 1, 1}};
/// For the critical points.
const Point<3> kDirection{0.3, 0.5, 0.8};

/// As random_pair, three in space.
std::vector<Polynomial<3>> random_triple(int degree, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.count = 3;
  options.seed = seed;
  std::vector<Polynomial<3>> triple;
  for (const Polynomial<3>& f : random_polynomials<3>(options)) {
    auto terms = f.terms();
    for (auto& term : terms) term.coefficient = Rational(nearest_double(term.coefficient));
    triple.push_back(Polynomial<3>::from_terms(std::move(terms)));
  }
  return triple;
}

int points_in_cube(const RootIsolation<3>& isolation) {
  return static_cast<int>(std::count_if(isolation.roots.begin(), isolation.roots.end(),
                                        [](const Box<3>& b) { return kCube.contains(b); }));
}

/// What is measured of one triple.
struct TripleFigures {
  double floor = 0, isolation = 0, with_setup = 0, critical = 0;
  RootIsolation<3> points, critical_points;
};

TripleFigures measure(const std::vector<Polynomial<3>>& triple, const Repetitions& repetitions) {
  TripleFigures figures;
  const SubdivisionLimits limits;
  const auto isolate = [&](const std::vector<FilteredFunction<3>>& f) {
    Kernel kernel;
    figures.points = isolate_roots<3>({&f[0], &f[1], &f[2]}, kCube, {}, limits, kernel);
  };
  const auto make = [&] {
    std::vector<FilteredFunction<3>> functions;
    for (const Polynomial<3>& f : triple) functions.emplace_back(f);
    return functions;
  };
  figures.with_setup = time_of(repetitions, [&] { isolate(make()); });
  const std::vector<FilteredFunction<3>> functions = make();
  figures.isolation = time_of(repetitions, [&] { isolate(functions); });
  figures.critical = time_of(repetitions, [&] {
    Kernel kernel;
    figures.critical_points =
        pair_critical_points(functions[0], functions[1], kDirection, kCube, {}, limits, kernel)
            ->points;
  });
  std::vector<Point<3>> nearby;
  for (const Box<3>& root : figures.points.roots)
    if (kCube.contains(root)) {
      nearby.push_back(root.center());
      for (double& c : nearby.back()) c += 1e-3;
    }
  const std::array<PackedSpacePolynomial, 3> packed{PackedSpacePolynomial(triple[0]),
                                                    PackedSpacePolynomial(triple[1]),
                                                    PackedSpacePolynomial(triple[2])};
  figures.floor = time_of(repetitions, [&] {
    std::vector<Point<3>> points = nearby;
    newton_steps(packed, points);
  });
  return figures;
}

}  // namespace

Table space_table(const Request& request) {
  Table table{"space",
              "Random triples of surfaces in [-1,1]^3: their common points (a floor is four Newton "
              "steps at each), and the critical points of the first two",
              {"degree", "points", "boxes", "floor us", "ms", "floors", "with setup ms", "rounded",
               "unresolved", "critical points", "boxes for them", "ms for them"},
              {}};
  const int highest =
      request.degrees.empty()
          ? 0
          : std::min(kHighest, *std::max_element(request.degrees.begin(), request.degrees.end()));
  for (int degree = 2; degree <= highest; ++degree) {
    std::vector<int> points, boxes, critical, critical_boxes;
    std::vector<double> floor, ms, floors, with_setup, critical_ms;
    std::int64_t rounded = 0, all = 0, unresolved = 0;
    for (const std::uint64_t seed : request.seeds) {
      const TripleFigures f = measure(random_triple(degree, seed), request.repetitions);
      points.push_back(points_in_cube(f.points));
      boxes.push_back(f.points.boxes);
      critical.push_back(points_in_cube(f.critical_points));
      critical_boxes.push_back(f.critical_points.boxes);
      floor.push_back(kMicro * f.floor);
      ms.push_back(kMilli * f.isolation);
      with_setup.push_back(kMilli * f.with_setup);
      critical_ms.push_back(kMilli * f.critical);
      if (points.back() > 0) floors.push_back(f.isolation / f.floor);
      rounded += std::count(f.points.rounded.begin(), f.points.rounded.end(), true);
      all += static_cast<std::int64_t>(f.points.roots.size());
      unresolved += static_cast<std::int64_t>(f.points.unresolved.size() +
                                              f.critical_points.unresolved.size());
    }
    table.add({std::int64_t{degree}, span_of(points), span_of(boxes), median(floor), median(ms),
               median(floors), median(with_setup),
               std::string(rounded == all ? "all" : std::to_string(all - rounded) + " not"),
               unresolved, span_of(critical), span_of(critical_boxes), median(critical_ms)});
  }
  return table;
}

Table surfaces_table(const Request& request) {
  Table table{
      "surfaces",
      "Random triples of surfaces in [-1,1]^3: the whole encasement, and what is made of it",
      {"degree", "certified", "cells", "facets encased", "points", "curves", "closed", "regions",
       "encasement ms", "arrangement ms", "curves to 1e-3 ms", "verified", "verification ms"},
      {}};
  constexpr int kHighestEncased = 5;
  const Polyhedron cube = make_box({-1, -1, -1}, {1, 1, 1}).value();
  const int highest = request.degrees.empty()
                          ? 0
                          : std::min(kHighestEncased, *std::max_element(request.degrees.begin(),
                                                                        request.degrees.end()));
  for (int degree = 2; degree <= highest; ++degree) {
    std::vector<int> cells, facets, points, curves, closed, regions;
    std::vector<double> encasement_ms, arrangement_ms, curves_ms, verification_ms;
    std::int64_t certified = 0, verified = 0;
    for (const std::uint64_t seed : request.seeds) {
      std::vector<NamedSurface> surfaces;
      for (const Polynomial<3>& f : random_triple(degree, seed)) surfaces.push_back({"s", f});
      SurfaceEncasement e;
      encasement_ms.push_back(
          kMilli * time_of(request.repetitions, [&] { e = encase(surfaces, cube).value(); }));
      cells.push_back(static_cast<int>(e.cells.size()));
      facets.push_back(static_cast<int>(e.statistics.facets_encased));
      points.push_back(static_cast<int>(e.triple_points.size()));
      const auto found = intersection_curves(e);
      curves.push_back(static_cast<int>(found.size()));
      closed.push_back(static_cast<int>(std::count_if(
          found.begin(), found.end(), [](const IntersectionCurve& c) { return c.closed; })));
      bool proved = false;
      verification_ms.push_back(kMilli * time_of({1, 0}, [&] { proved = verify(e).ok(); }));
      verified += proved;
      if (e.outcome != Outcome::Certified) continue;
      ++certified;
      arrangement_ms.push_back(kMilli * time_of(request.repetitions, [&] {
                                 regions.resize(certified);
                                 regions.back() =
                                     static_cast<int>(arrange(e).value().regions.size());
                               }));
      curves_ms.push_back(kMilli * time_of(request.repetitions, [&] { trace(e).value(); }));
    }
    const auto count = static_cast<std::int64_t>(request.seeds.size());
    const auto of_all = [&](std::int64_t part) {
      return std::string(part == count ? "all" : std::to_string(part));
    };
    table.add({std::int64_t{degree}, of_all(certified), span_of(cells), span_of(facets),
               span_of(points), span_of(curves), span_of(closed), span_of(regions),
               median(encasement_ms), median(arrangement_ms), median(curves_ms), of_all(verified),
               median(verification_ms)});
  }
  return table;
}

}  // namespace encase::benchmark
