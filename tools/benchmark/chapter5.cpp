// SPDX-License-Identifier: MIT
#include "chapter5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "encase/atomic_file.hpp"
#include "line_plot.hpp"

namespace encase::benchmark {
namespace {

/// A stage of both: how long it takes ours and CGAL for one pair.
struct Stage {
  std::string name;
  std::function<double(const Stages&)> ours;
  std::function<double(const CgalFigures&)> cgal;
};

const std::vector<Stage> kStages{
    {"Individual curve isolation", [](const Stages& s) { return s.curves; },
     [](const CgalFigures& c) { return c.curves; }},
    {"Root isolation", [](const Stages& s) { return s.roots; },
     [](const CgalFigures& c) { return c.solve; }},
    {"Coordinates to 2^-53", [](const Stages& s) { return s.coordinates; },
     [](const CgalFigures& c) { return c.coordinates; }},
    {"Total running time", [](const Stages& s) { return s.total(); },
     [](const CgalFigures& c) { return c.total(); }}};

double over_seeds(const Request& request, const std::function<double(std::uint64_t)>& figure) {
  std::vector<double> values;
  for (const std::uint64_t seed : request.seeds) values.push_back(figure(seed));
  return median(std::move(values));
}

void add_point(Series* series, double x, double y) {
  if (y > 0) series->points.emplace_back(x, y);
}

LinePlot times_of(RandomPairs& pairs, const Request& request, const Stage& stage) {
  LinePlot plot{stage.name, "degree", "CPU time", LinePlot::Unit::Seconds, false, {}};
  plot.series = {{"encasement", {}}, {"CGAL", {}}};
  for (const int degree : request.degrees) {
    add_point(&plot.series[0], degree, over_seeds(request, [&](std::uint64_t seed) {
      return stage.ours(pairs.stages(degree, seed));
    }));
    if (degree <= request.cgal_degrees)
      add_point(&plot.series[1], degree, over_seeds(request, [&](std::uint64_t seed) {
        return stage.cgal(pairs.cgal(degree, seed));
      }));
  }
  return plot;
}

LinePlot ratios_of(RandomPairs& pairs, const Request& request, const Stage& stage) {
  LinePlot plot{stage.name + ": ratio", "degree", "times faster than CGAL",
                LinePlot::Unit::None,   false,    {{"CGAL / encasement", {}}}};
  for (const int degree : request.degrees)
    if (degree <= request.cgal_degrees)
      add_point(&plot.series[0], degree, over_seeds(request, [&](std::uint64_t seed) {
        const double ours = stage.ours(pairs.stages(degree, seed));
        return ours > 0 ? stage.cgal(pairs.cgal(degree, seed)) / ours : 0;
      }));
  return plot;
}

/// Times against the degree, a line for each side of a square around a crossing.
LinePlot times_in_squares(const Request& request, const std::string& title, int highest_degree,
                          const std::vector<double>& sides,
                          const std::function<double(int, std::uint64_t, const Region&)>& time) {
  LinePlot plot{title, "degree", "CPU time", LinePlot::Unit::Seconds, false, {}};
  for (const double side : sides) {
    Series series{fmt::format("side {:g}", side), {}};
    for (const int degree : request.degrees) {
      if (degree > highest_degree) continue;
      add_point(&series, degree, over_seeds(request, [&](std::uint64_t seed) {
        const Encasement whole = encase(random_pair(degree, seed), unit_region()).value();
        return time(degree, seed, square_around(central_crossing(whole), side));
      }));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

LinePlot cgal_in_squares(Request request) {
  constexpr int kHighestDegree = 8;
  request.seeds.resize(1);
  return times_in_squares(
      request, "CGAL in squares around a crossing", std::min(kHighestDegree, request.cgal_degrees),
      {2, 1, 0.5, 0.25}, [](int degree, std::uint64_t seed, const Region& square) {
        const auto pair = random_pair(degree, seed);
        return run_cgal_in_box(pair[0].function.polynomial(), pair[1].function.polynomial(),
                               square.bounding_box())
            .total();
      });
}

LinePlot ours_in_squares(const Request& request) {
  return times_in_squares(
      request, "Encasement in squares around a crossing", kMaxDegree, {2, 1, 0.5, 0.25, 0.125},
      [&](int degree, std::uint64_t seed, const Region& square) {
        return timed_encasement(random_pair(degree, seed), square, {}, request.repetitions).seconds;
      });
}

LinePlot growth(RandomPairs& pairs, const Request& request) {
  LinePlot plot{"Time per crossing", "degree", "CPU time", LinePlot::Unit::Seconds, true, {}};
  std::vector<double> degrees, costs;
  const Table table = growth_table(pairs, request);
  for (const auto& row : table.rows) {
    degrees.push_back(static_cast<double>(std::get<std::int64_t>(row[0])));
    costs.push_back(1e-6 * std::get<double>(row[1]));
  }
  if (degrees.size() < 2) return plot;
  Series measured{"measured", {}};
  for (std::size_t k = 0; k < degrees.size(); ++k) add_point(&measured, degrees[k], costs[k]);
  const PowerLaw law = fitted_power_law(degrees, costs);
  Series fit{fmt::format("degree^{:.2f}", law.exponent), {}};
  for (const double degree : {degrees.front(), degrees.back()})
    add_point(&fit, degree, law.factor * std::pow(degree, law.exponent));
  plot.series = {std::move(measured), std::move(fit)};
  return plot;
}

Status write_plot(const std::string& directory, const std::string& name, LinePlot plot) {
  const bool empty = std::all_of(plot.series.begin(), plot.series.end(),
                                 [](const Series& series) { return series.points.empty(); });
  if (empty) return {};
  const std::string path = (std::filesystem::path(directory) / name).string();
  if (auto status = write_file(path + ".csv", to_csv(plot))) return status;
  return write_file(path + ".svg", to_svg(plot));
}

}  // namespace

Status write_chapter5(RandomPairs& pairs, const Request& request, const std::string& directory) {
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  if (failed) return Error{Error::Code::Io, "cannot make " + directory + ": " + failed.message()};
  int figure = 3;
  const auto write = [&](LinePlot plot) {
    const std::string number = fmt::format("5.{}", figure++);
    plot.title = fmt::format("{} ({})", plot.title, number);
    fmt::print("figure {}\n", plot.title);
    std::fflush(stdout);
    return write_plot(directory, "figure-" + number, std::move(plot));
  };
  for (const Stage& stage : kStages) {
    if (auto status = write(times_of(pairs, request, stage))) return status;
    if (auto status = write(ratios_of(pairs, request, stage))) return status;
  }
  if (auto status = write(cgal_in_squares(request))) return status;
  if (auto status = write(ours_in_squares(request))) return status;
  return write_plot(directory, "growth", growth(pairs, request));
}

}  // namespace encase::benchmark
