// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "2d/least_cells.hpp"
#include "encase/curves_file.hpp"
#include "tables.hpp"

namespace encase::benchmark {
namespace {

constexpr double kMilli = 1e3;

struct Example {
  std::string name;
  std::vector<std::string> curves;
  std::string region;
  bool relaxed = false;
};

const std::vector<std::string> kColumns{"curves",     "setting",        "outcome", "ms",
                                        "crossings",  "cells",          "least",   "relaxed",
                                        "degenerate", "MPFR expansions"};

std::vector<Value> row_of(const std::string& name, const std::string& setting,
                          const TimedEncasement& timed) {
  const Encasement& r = timed.result;
  const auto relaxed = std::count_if(r.cells.begin(), r.cells.end(), [](const Cell& cell) {
    return cell.state == CellState::Relaxed;
  });
  // Those in the region; results list those outside too, if the region used is larger.
  const auto crossings = std::count_if(
      r.crossings.begin(), r.crossings.end(),
      [](const Crossing& crossing) { return crossing.location != Location::Outside; });
  Value least;
  if (timed.certified()) least = std::int64_t{least_cells(r)};
  return {name,
          setting,
          to_string(r.outcome),
          kMilli * timed.seconds,
          static_cast<std::int64_t>(crossings),
          static_cast<std::int64_t>(r.cells.size()),
          std::move(least),
          static_cast<std::int64_t>(relaxed),
          static_cast<std::int64_t>(r.degenerate.size()),
          r.statistics.mpfr_expansions};
}

/// A circle and a curve above it at (0, 1), `gap` away; below by as much for a negative gap: then
/// they meet in two points close to each other.
std::vector<Example> touching_pairs() {
  std::vector<Example> list;
  for (const char* size : {"1e-4", "1e-8", "1e-12"})
    for (const bool overlap : {false, true}) {
      const std::string end = fmt::format("{} {}", overlap ? "-" : "+", size);
      const std::string kind = fmt::format("{} {}", overlap ? "overlap" : "gap", size);
      list.push_back({"circle and line, " + kind, {"x^2 + y^2 = 1", "y = 1 " + end}, "-2 2 -2 2"});
      list.push_back(
          {"circle and parabola, " + kind, {"x^2 + y^2 = 1", "y = 1 - x^2/4 " + end}, "-2 2 -2 2"});
    }
  return list;
}

}  // namespace

Table files_table(const Request& request) {
  Table table{"files", "The curves of tests/data/curves", kColumns, {}};
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(request.curves_directory))
    if (entry.path().extension() == ".curves") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    const CurvesFile file = load_curves(path.string()).value();
    for (const Setting& setting : settings())
      table.add(row_of(path.stem().string(), setting.name,
                       timed_encasement(file.curves, file.region ? *file.region : unit_region(),
                                        setting.options, request.repetitions)));
  }
  return table;
}

Table near_tangency_table(const Request& request) {
  Table table{"near tangencies", "Curves that nearly touch", kColumns, {}};
  std::vector<Example> examples = touching_pairs();
  examples.push_back({"parabolas 1e-6 apart", {"y = x^2", "y = x^2 + 1e-6"}, "-1 1 -1 2", true});
  for (const Example& example : examples) {
    std::vector<NamedCurve> curves;
    for (const std::string& text : example.curves)
      curves.push_back({text, parse_polynomial(text).value()});
    for (Setting setting : settings()) {
      setting.options.relaxed = example.relaxed;
      table.add(row_of(example.name + (example.relaxed ? ", relaxed" : ""), setting.name,
                       timed_encasement(curves, parse_region(example.region).value(),
                                        setting.options, request.repetitions)));
    }
  }
  return table;
}

}  // namespace encase::benchmark
