// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "2d/least_cells.hpp"
#include "published.hpp"
#include "tables.hpp"

namespace encase::benchmark {
namespace {

constexpr double kMicro = 1e6, kMilli = 1e3;

/// The median over the seeds of what `figure` gives for one.
double over_seeds(const Request& request, const std::function<double(std::uint64_t)>& figure) {
  std::vector<double> values;
  for (const std::uint64_t seed : request.seeds) values.push_back(figure(seed));
  return median(std::move(values));
}

Value counts_over_seeds(const Request& request, const std::function<int(std::uint64_t)>& count) {
  std::vector<int> counts;
  for (const std::uint64_t seed : request.seeds) counts.push_back(count(seed));
  return span_of(counts);
}

int crossings_in_region(const Encasement& encasement) {
  return static_cast<int>(
      std::count_if(encasement.crossings.begin(), encasement.crossings.end(),
                    [](const Crossing& c) { return c.location != Location::Outside; }));
}

Value crossings_of(RandomPairs& pairs, const Request& request, int degree, std::size_t setting) {
  return counts_over_seeds(request, [&](std::uint64_t seed) {
    return crossings_in_region(pairs.ours(degree, seed).encasements[setting].result);
  });
}

/// "certified", or how many are not.
std::string outcomes_of(RandomPairs& pairs, const Request& request, int degree,
                        std::size_t setting) {
  std::string text;
  for (const std::uint64_t seed : request.seeds) {
    const TimedEncasement& timed = pairs.ours(degree, seed).encasements[setting];
    if (!timed.certified())
      text += fmt::format("{}seed {} {}", text.empty() ? "" : ", ", seed,
                          to_string(timed.result.outcome));
  }
  return text.empty() ? "certified" : text;
}

Value authors_cells(int degree) {
  for (const PublishedCells& cells : kAuthorsCells)
    if (cells.degree == degree) return span_of({cells.least, cells.most});
  return {};
}

using Count = std::int64_t Statistics::*;
const std::vector<std::pair<std::string, Count>> kCounts{
    {"root boxes", &Statistics::root_boxes},
    {"critical boxes", &Statistics::critical_boxes},
    {"restrictions", &Statistics::restrictions},
    {"expansions", &Statistics::expansions},
    {"in MPFR", &Statistics::mpfr_expansions},
    {"lines tried", &Statistics::candidate_lines},
    {"splits", &Statistics::splits},
    {"for loops", &Statistics::loop_splits}};
const std::vector<std::pair<std::string, std::int64_t DecisionCounts::*>> kRungs{
    {"by double", &DecisionCounts::by_double},
    {"by MPFR", &DecisionCounts::by_mpfr},
    {"exactly", &DecisionCounts::by_exact},
    {"not", &DecisionCounts::undecided}};

template <class List>
void add_names(const List& list, std::vector<std::string>* columns) {
  for (const auto& [name, member] : list) columns->push_back(name);
}

double ratio(RandomPairs& pairs, const Request& request, int degree, std::size_t setting,
             bool with_coordinates) {
  return over_seeds(request, [&](std::uint64_t seed) {
    const CgalFigures& cgal = pairs.cgal(degree, seed);
    return (cgal.total() - (with_coordinates ? 0 : cgal.coordinates)) /
           pairs.ours(degree, seed).encasements[setting].seconds;
  });
}

std::string agreement(RandomPairs& pairs, const Request& request, int degree) {
  for (const std::uint64_t seed : request.seeds)
    for (const TimedEncasement& timed : pairs.ours(degree, seed).encasements)
      if (crossings_in_region(timed.result) != pairs.cgal(degree, seed).roots_in_box)
        return fmt::format("no: seed {}", seed);
  return "yes";
}

}  // namespace

Table floors_table(RandomPairs& pairs, const Request& request) {
  pairs.measure(request.degrees, request.seeds, 0);
  Table table{
      "floors",
      "Random pairs in [-1,1]^2; a floor is four Newton steps at each crossing (together: "
      "eight crossings at a time)",
      {"degree", "crossings", "floor us", "together us", "isolation us", "floors", "with setup us",
       "floors with setup", "setting", "encasement ms", "floors of it", "outcome"},
      {}};
  const auto list = settings();
  for (const int degree : request.degrees)
    for (std::size_t s = 0; s < list.size(); ++s) {
      const auto figure = [&](const std::function<double(const PairFigures&)>& of) {
        return over_seeds(request,
                          [&](std::uint64_t seed) { return of(pairs.ours(degree, seed)); });
      };
      table.add({std::int64_t{degree}, crossings_of(pairs, request, degree, s),
                 kMicro * figure([](const PairFigures& p) { return p.floor; }),
                 kMicro * figure([](const PairFigures& p) { return p.floor_together; }),
                 kMicro * figure([](const PairFigures& p) { return p.isolation; }),
                 figure([](const PairFigures& p) { return p.isolation / p.floor; }),
                 kMicro * figure([](const PairFigures& p) { return p.isolation_with_setup; }),
                 figure([](const PairFigures& p) { return p.isolation_with_setup / p.floor; }),
                 list[s].name,
                 kMilli * figure([s](const PairFigures& p) { return p.encasements[s].seconds; }),
                 figure([s](const PairFigures& p) { return p.encasements[s].seconds / p.floor; }),
                 outcomes_of(pairs, request, degree, s)});
    }
  return table;
}

Table work_table(RandomPairs& pairs, const Request& request) {
  pairs.measure(request.degrees, request.seeds, 0);
  Table table{"work",
              "Random pairs: cells (least: what lines can hardly go below), boxes, local "
              "expansions, lines, and how questions were decided",
              {"degree", "setting", "crossings", "cells", "least", "authors' cells"},
              {}};
  add_names(kCounts, &table.columns);
  add_names(kRungs, &table.columns);
  const auto list = settings();
  for (const int degree : request.degrees)
    for (std::size_t s = 0; s < list.size(); ++s) {
      const auto result = [&](std::uint64_t seed) -> const Encasement& {
        return pairs.ours(degree, seed).encasements[s].result;
      };
      std::vector<Value> row{
          std::int64_t{degree},
          list[s].name,
          crossings_of(pairs, request, degree, s),
          counts_over_seeds(request,
                            [&](auto seed) { return static_cast<int>(result(seed).cells.size()); }),
          counts_over_seeds(request, [&](auto seed) { return least_cells(result(seed)); }),
          authors_cells(degree)};
      for (const auto& [name, count] : kCounts)
        row.push_back(over_seeds(request, [&, member = count](auto seed) {
          return static_cast<double>(result(seed).statistics.*member);
        }));
      for (const auto& [name, rung] : kRungs)
        row.push_back(over_seeds(request, [&, member = rung](auto seed) {
          return static_cast<double>(result(seed).statistics.decisions.*member);
        }));
      table.add(std::move(row));
    }
  return table;
}

Table cgal_table(RandomPairs& pairs, const Request& request) {
  pairs.measure(request.degrees, request.seeds, request.cgal_degrees);
  Table table{
      "cgal",
      "Random pairs in [-1,1]^2, ours and CGAL's Algebraic_kernel_d_2 with CORE",
      {"degree", "in the box", "CGAL's", "the same", "CGAL's in the plane", "CGAL ms",
       "without coordinates ms", "setting", "ours ms", "ratio", "ratio without coordinates"},
      {}};
  const auto list = settings();
  for (const int degree : request.degrees) {
    if (degree > request.cgal_degrees) continue;
    const auto cgal_ms = [&](const std::function<double(const CgalFigures&)>& of) {
      return kMilli *
             over_seeds(request, [&](std::uint64_t seed) { return of(pairs.cgal(degree, seed)); });
    };
    for (std::size_t s = 0; s < list.size(); ++s)
      table.add(
          {std::int64_t{degree}, crossings_of(pairs, request, degree, s),
           counts_over_seeds(request,
                             [&](auto seed) { return pairs.cgal(degree, seed).roots_in_box; }),
           agreement(pairs, request, degree),
           counts_over_seeds(request, [&](auto seed) { return pairs.cgal(degree, seed).roots; }),
           cgal_ms([](const CgalFigures& c) { return c.total(); }),
           cgal_ms([](const CgalFigures& c) { return c.total() - c.coordinates; }), list[s].name,
           kMilli * over_seeds(
                        request,
                        [&](auto seed) { return pairs.ours(degree, seed).encasements[s].seconds; }),
           ratio(pairs, request, degree, s, true), ratio(pairs, request, degree, s, false)});
  }
  return table;
}

Table every_pair_table(RandomPairs& pairs, const Request& request) {
  Table table{
      "pairs",
      "Every random pair; times in seconds",
      {"degree", "seed", "setting", "outcome", "crossings", "cells", "least cells", "encasement",
       "isolation", "isolation with setup", "floor", "floor together", "Newton error",
       "CGAL curves", "CGAL solve", "CGAL coordinates", "CGAL in the box", "CGAL in the plane"},
      {}};
  table.printed = false;
  const auto list = settings();
  for (const int degree : request.degrees)
    for (const std::uint64_t seed : request.seeds)
      for (std::size_t s = 0; s < list.size(); ++s) {
        const PairFigures& p = pairs.ours(degree, seed);
        const Encasement& result = p.encasements[s].result;
        std::vector<Value> row{std::int64_t{degree},
                               static_cast<std::int64_t>(seed),
                               list[s].name,
                               to_string(result.outcome),
                               std::int64_t{crossings_in_region(result)},
                               static_cast<std::int64_t>(result.cells.size()),
                               std::int64_t{least_cells(result)},
                               p.encasements[s].seconds,
                               p.isolation,
                               p.isolation_with_setup,
                               p.floor,
                               p.floor_together,
                               p.newton_error};
        if (const CgalFigures* c = pairs.measured_cgal(degree, seed))
          row.insert(row.end(), {c->curves, c->solve, c->coordinates, std::int64_t{c->roots_in_box},
                                 std::int64_t{c->roots}});
        row.resize(table.columns.size());
        table.add(std::move(row));
      }
  return table;
}

}  // namespace encase::benchmark
