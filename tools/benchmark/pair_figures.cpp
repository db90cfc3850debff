// SPDX-License-Identifier: MIT
#include "pair_figures.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/isolate_roots.hpp"
#include "common/random_polynomials.hpp"
#include "newton_floor.hpp"

namespace encase::benchmark {
namespace {

/// How far the Newton steps start from a crossing.
constexpr double kOffset = 0x1p-20;

constexpr int kRounds = 4;
constexpr double kLong = 5;  // seconds: what takes longer is measured in one round

void measure_isolation(const std::vector<NamedCurve>& pair, const Repetitions& repetitions,
                       PairFigures* figures) {
  const Box<2> box = unit_region().bounding_box();
  const SubdivisionLimits limits;
  const auto isolate = [&](const FilteredFunction<2>& f, const FilteredFunction<2>& g) {
    Kernel kernel;
    return isolate_roots<2>({&f, &g}, box, {}, limits, kernel).roots.size();
  };
  figures->isolation_with_setup = time_of(repetitions, [&] {
    const FilteredFunction<2> f(pair[0].function.polynomial()), g(pair[1].function.polynomial());
    isolate(f, g);
  });
  const FilteredFunction<2> f(pair[0].function.polynomial()), g(pair[1].function.polynomial());
  figures->isolation = time_of(repetitions, [&] { isolate(f, g); });
}

void measure_floor(const std::vector<NamedCurve>& pair, const std::vector<Crossing>& crossings,
                   const Repetitions& repetitions, PairFigures* figures) {
  const int degree =
      std::max(pair[0].function.polynomial().degree(), pair[1].function.polynomial().degree());
  const PackedPolynomial f(pair[0].function.polynomial(), degree),
      g(pair[1].function.polynomial(), degree);
  std::vector<Point<2>> starts, points;
  for (const Crossing& c : crossings)
    starts.push_back({c.point[0] + kOffset, c.point[1] - kOffset});
  figures->floor = time_of(repetitions, [&] {
    points = starts;
    newton_steps(f, g, points);
  });
  for (std::size_t k = 0; k < points.size(); ++k)
    figures->newton_error = std::max(
        figures->newton_error,
        std::hypot(points[k][0] - crossings[k].point[0], points[k][1] - crossings[k].point[1]));
  figures->floor_together = time_of(repetitions, [&] {
    points = starts;
    newton_steps_together(f, g, points);
  });
}

/// Tells a person who waits at a terminal what takes so long.
void announce(const std::string& text) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "{}\n", text);
}

/// Of each time the lesser one.
void keep_least(const PairFigures& round, PairFigures* figures) {
  const auto keep = [](double seconds, double* least) { *least = std::min(*least, seconds); };
  for (std::size_t k = 0; k < figures->encasements.size(); ++k)
    keep(round.encasements[k].seconds, &figures->encasements[k].seconds);
  keep(round.isolation, &figures->isolation);
  keep(round.isolation_with_setup, &figures->isolation_with_setup);
  keep(round.floor, &figures->floor);
  keep(round.floor_together, &figures->floor_together);
}

CgalFigures median_of(const std::vector<CgalFigures>& runs) {
  CgalFigures result = runs.front();
  const auto middle = [&](double CgalFigures::*stage) {
    std::vector<double> values;
    for (const CgalFigures& run : runs) values.push_back(run.*stage);
    result.*stage = median(std::move(values));
  };
  middle(&CgalFigures::curves);
  middle(&CgalFigures::solve);
  middle(&CgalFigures::coordinates);
  return result;
}

}  // namespace

std::vector<Setting> settings() {
  EncaseOptions fast;
  fast.fast = true;
  return {{"default", {}}, {"fast", fast}};
}

std::vector<NamedCurve> random_pair(int degree, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.seed = seed;
  std::vector<NamedCurve> pair = random_curves(options);
  for (NamedCurve& curve : pair) {
    auto terms = curve.function.polynomial().terms();
    for (auto& term : terms) term.coefficient = Rational(nearest_double(term.coefficient));
    curve.function = Polynomial<2>::from_terms(std::move(terms));
  }
  return pair;
}

Region unit_region() { return make_region(-1, 1, -1, 1).value(); }

TimedEncasement timed_encasement(const std::vector<NamedCurve>& curves, const Region& region,
                                 const EncaseOptions& options, const Repetitions& repetitions) {
  TimedEncasement timed;
  timed.seconds =
      time_of(repetitions, [&] { timed.result = encase(curves, region, options).value(); });
  return timed;
}

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::Certified:
      return "certified";
    case Outcome::Degenerate:
      return "degenerate";
    case Outcome::Undecided:
      break;
  }
  return "undecided";
}

int RandomPairs::rounds() const { return repetitions_.count == 0 ? kRounds : 1; }

void RandomPairs::measure(const std::vector<int>& degrees, const std::vector<std::uint64_t>& seeds,
                          int cgal_degrees) {
  std::vector<Key> ours, cgal;
  for (const int degree : degrees)
    for (const std::uint64_t seed : seeds) {
      const Key key{degree, seed};
      if (!ours_.contains(key)) ours.push_back(key);
      if (degree <= cgal_degrees && !cgal_.contains(key)) cgal.push_back(key);
    }
  measure_ours(ours);
  measure_cgal(cgal);
}

void RandomPairs::measure_ours(const std::vector<Key>& pairs) {
  for (int round = 0; round < rounds(); ++round)
    for (const Key& key : pairs) {
      const auto pair = random_pair(key.first, key.second);
      PairFigures figures;
      for (const Setting& setting : settings())
        figures.encasements.push_back(
            timed_encasement(pair, unit_region(), setting.options, repetitions_));
      measure_isolation(pair, repetitions_, &figures);
      measure_floor(pair, figures.encasements.front().result.crossings, repetitions_, &figures);
      const auto [place, is_new] = ours_.try_emplace(key, figures);
      if (!is_new) keep_least(figures, &place->second);
    }
}

void RandomPairs::measure_cgal(const std::vector<Key>& pairs) {
  for (int round = 0; round < rounds(); ++round)
    for (const Key& key : pairs) {
      const auto known = cgal_.find(key);
      if (known != cgal_.end() && known->second.total() > kLong) continue;
      const CgalFigures figures = cgal_once(key);
      if (known == cgal_.end() || figures.total() < known->second.total()) cgal_[key] = figures;
    }
}

const PairFigures& RandomPairs::ours(int degree, std::uint64_t seed) {
  measure({degree}, {seed}, 0);
  return ours_.at({degree, seed});
}

const Stages& RandomPairs::stages(int degree, std::uint64_t seed) {
  const auto [place, is_new] = stages_.try_emplace({degree, seed});
  if (is_new) place->second = stages_of(random_pair(degree, seed), unit_region(), repetitions_);
  return place->second;
}

const CgalFigures& RandomPairs::cgal(int degree, std::uint64_t seed) {
  if (!cgal_.contains({degree, seed})) measure_cgal({{degree, seed}});
  return cgal_.at({degree, seed});
}

/// The medians of some runs.
CgalFigures RandomPairs::cgal_once(const Key& key) const {
  const auto [degree, seed] = key;
  const auto pair = random_pair(degree, seed);
  const Box<2> box = unit_region().bounding_box();
  announce(fmt::format("CGAL, degree {}, seed {}", degree, seed));
  std::vector<CgalFigures> runs;
  const auto run = [&] {
    runs.push_back(run_cgal(pair[0].function.polynomial(), pair[1].function.polynomial(), box));
  };
  run();
  // A first run that fills caches counts only where it is the only one.
  if (repetitions_.count > 1 || (repetitions_.count == 0 && runs.front().total() < 1)) {
    runs.clear();
    Stopwatch watch;
    double spent = 0;
    do {
      run();
      spent += watch.lap();
    } while (repetitions_.count > 0 ? static_cast<int>(runs.size()) < repetitions_.count
                                    : runs.size() < 3 && spent < 1);
  }
  return median_of(runs);
}

const CgalFigures* RandomPairs::measured_cgal(int degree, std::uint64_t seed) const {
  const auto place = cgal_.find({degree, seed});
  return place == cgal_.end() ? nullptr : &place->second;
}

}  // namespace encase::benchmark
