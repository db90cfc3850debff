// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include "3d/pair_critical_points.hpp"
#include "common/isolate_roots.hpp"
#include "common/random_polynomials.hpp"
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

}  // namespace encase::benchmark
