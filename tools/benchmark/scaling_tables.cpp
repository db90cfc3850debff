// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tables.hpp"

namespace encase::benchmark {
namespace {

constexpr double kMicro = 1e6, kMilli = 1e3;

int highest_degree(const Request& request) {
  return request.degrees.empty()
             ? 0
             : *std::max_element(request.degrees.begin(), request.degrees.end());
}

/// Kilobytes that a process of its own needs at most while it calls `run`; -1 if there is none.
template <class Run>
long memory_of(Run run) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    run();
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) return -1;
  return usage.ru_maxrss;
}

struct SquareSeries {
  std::vector<double> sides;  ///< descending; the first is the whole of [-1,1]^2
  std::vector<TimedEncasement> encasements;
};

SquareSeries squares(int degree, std::uint64_t seed, const Request& request) {
  const auto pair = random_pair(degree, seed);
  const EncaseOptions options;
  const Point<2> center = central_crossing(encase(pair, unit_region(), options).value());
  SquareSeries series;
  for (double side = 2; side > 0.01; side /= 2) {
    series.sides.push_back(side);
    series.encasements.push_back(
        timed_encasement(pair, square_around(center, side), options, request.repetitions));
  }
  return series;
}

}  // namespace

Point<2> central_crossing(const Encasement& encasement) {
  Point<2> nearest{};
  double least = 0;
  for (const Crossing& crossing : encasement.crossings) {
    const double distance = std::hypot(crossing.point[0], crossing.point[1]);
    if (&crossing == encasement.crossings.data() || distance < least) {
      least = distance;
      nearest = crossing.point;
    }
  }
  return nearest;
}

Region square_around(const Point<2>& crossing, double side) {
  std::array<Rational, 2> lo;
  for (int i = 0; i < 2; ++i) {
    const double start = std::clamp(crossing[i] - side / 2, -1.0, 1.0 - side);
    lo[i] = Rational(std::ldexp(std::round(std::ldexp(start, 20)), -20));
  }
  const Rational width(side);
  return make_region(lo[0], lo[0] + width, lo[1], lo[1] + width).value();
}

PowerLaw fitted_power_law(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = std::log(x[k]), v = std::log(y[k]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  const double exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {std::exp((sy - exponent * sx) / n), exponent};
}

Table locality_table(const Request& request) {
  Table table{"locality",
              "Ever smaller squares around a crossing",
              {"degree", "side", "crossings", "cells", "ms", "part of the whole", "certified"},
              {}};
  for (const int degree : {10, 15}) {
    if (degree > highest_degree(request)) continue;
    std::vector<SquareSeries> all;
    for (const std::uint64_t seed : request.seeds) all.push_back(squares(degree, seed, request));
    for (std::size_t k = 0; k < all.front().sides.size(); ++k) {
      std::vector<int> crossings, cells;
      std::vector<double> seconds, parts;
      std::int64_t certified = 0;
      for (const SquareSeries& series : all) {
        const TimedEncasement& timed = series.encasements[k];
        crossings.push_back(static_cast<int>(timed.result.crossings.size()));
        cells.push_back(static_cast<int>(timed.result.cells.size()));
        seconds.push_back(timed.seconds);
        parts.push_back(timed.seconds / series.encasements.front().seconds);
        certified += timed.certified() ? 1 : 0;
      }
      table.add({std::int64_t{degree}, all.front().sides[k], span_of(crossings), span_of(cells),
                 kMilli * median(seconds), median(parts), certified});
    }
  }
  return table;
}

Table growth_table(RandomPairs& pairs, const Request& request) {
  Table table{"growth", "", {"degree", "us per crossing"}, {}};
  std::vector<double> degrees, costs;
  for (int degree = 5; degree <= std::min(20, highest_degree(request)); ++degree) {
    std::vector<double> values;
    for (const std::uint64_t seed : request.seeds) {
      const TimedEncasement& timed = pairs.ours(degree, seed).encasements.front();
      if (!timed.result.crossings.empty())
        values.push_back(timed.seconds / static_cast<double>(timed.result.crossings.size()));
    }
    degrees.push_back(degree);
    costs.push_back(kMicro * median(values));
    table.add({std::int64_t{degree}, costs.back()});
  }
  table.title = "The time per crossing";
  if (degrees.size() > 1)
    table.title += fmt::format(": it grows like the degree to the power of {:.2f}",
                               fitted_power_law(degrees, costs).exponent);
  return table;
}

Table memory_table(const Request& request) {
  Table table{"memory",
              "The most memory of a process that makes one encasement",
              {"degree", "MB", "MB without the encasement"},
              {}};
  const int degree = highest_degree(request);
  const auto pair = random_pair(degree, request.seeds.front());
  const long before = memory_of([] {});
  const long after = memory_of([&] { encase(pair, unit_region()).value(); });
  std::vector<Value> row{std::int64_t{degree}, {}, {}};
  if (after >= 0) row[1] = static_cast<double>(after) / 1024;
  if (before >= 0) row[2] = static_cast<double>(before) / 1024;
  table.add(std::move(row));
  return table;
}

}  // namespace encase::benchmark
