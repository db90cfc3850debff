// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "io/names.hpp"

namespace encase {
namespace {

/// A file's word as people write it.
std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// `count` things, in words: "1 crossing", "2 crossings".
std::string counted(std::int64_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// The largest distance, in a coordinate, from the point to what the box holds; rounded up.
double radius(const Crossing& crossing) {
  double r = 0;
  for (int i = 0; i < 2; ++i) {
    r = std::max(r, crossing.box.hi[i] - crossing.point[i]);
    r = std::max(r, crossing.point[i] - crossing.box.lo[i]);
  }
  return std::nextafter(r, INFINITY);
}

std::string crossing_table(const Encasement& encasement) {
  const auto& crossings = encasement.crossings;
  if (crossings.empty()) return "";
  const bool larger = std::any_of(crossings.begin(), crossings.end(),
                                  [](const Crossing& c) { return c.location != Location::Inside; });
  std::size_t width = 6;
  for (const Crossing& c : crossings)
    width = std::max(width, encasement.curves[c.curves[0]].name.size() +
                                encasement.curves[c.curves[1]].name.size() + 3);
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "\n{:>5}  {:<{}}  {:>23}  {:>23}  {:>8}  {:>5}{}\n", "id", "curves", width,
                 "x", "y", "radius", "cell", larger ? "  location" : "");
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const Crossing& c = crossings[i];
    const std::string pair =
        encasement.curves[c.curves[0]].name + " & " + encasement.curves[c.curves[1]].name;
    fmt::format_to(out, "{:>5}  {:<{}}  {:>23.17g}  {:>23.17g}  {:>8.1e}  {:>5}", i, pair, width,
                   c.point[0], c.point[1], radius(c),
                   c.cell >= 0 ? std::to_string(c.cell) : std::string("-"));
    if (c.location != Location::Inside)
      fmt::format_to(out, "  {}",
                     c.location == Location::OnBoundary ? "on the boundary" : "outside");
    text += '\n';
  }
  return text;
}

std::string unresolved_list(const Encasement& encasement, const std::vector<Unresolved>& list,
                            const char* title) {
  if (list.empty()) return "";
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "\n{}:\n", title);
  constexpr std::size_t kMostShown = 20;
  for (std::size_t i = 0; i < std::min(list.size(), kMostShown); ++i) {
    const Unresolved& u = list[i];
    const bool of_input = names_input_curves(u.kind);
    std::string curves;
    for (const int c : u.curves)
      curves += (curves.empty() ? "" : ", ") +
                (of_input ? encasement.input[c].name : encasement.curves[c].name);
    fmt::format_to(out, "  {}{}{}{}\n", words(name_of(kUnresolvedKinds, u.kind)),
                   curves.empty() ? "" : " of ", curves, u.proved ? " (proved)" : "");
    if (u.has_box)
      fmt::format_to(out, "    in [{}, {}] x [{}, {}]\n", u.box.lo[0], u.box.hi[0], u.box.lo[1],
                     u.box.hi[1]);
    if (!u.reason.empty()) fmt::format_to(out, "    {}\n", u.reason);
  }
  if (list.size() > kMostShown)
    fmt::format_to(out, "  and {} more: --json lists them all\n", list.size() - kMostShown);
  return text;
}

}  // namespace

std::string report(const Encasement& encasement) {
  std::string text;
  auto out = std::back_inserter(text);
  const auto outside =
      std::count_if(encasement.crossings.begin(), encasement.crossings.end(),
                    [](const Crossing& c) { return c.location == Location::Outside; });
  const auto in_state = [&](CellState state) {
    return std::count_if(encasement.cells.begin(), encasement.cells.end(),
                         [=](const Cell& c) { return c.state == state; });
  };
  fmt::format_to(
      out, "{}: {}, {} in {}", name_of(kOutcomes, encasement.outcome),
      counted(static_cast<std::int64_t>(encasement.curves.size()), "curve"),
      counted(static_cast<std::int64_t>(encasement.crossings.size()) - outside, "crossing"),
      counted(static_cast<std::int64_t>(encasement.cells.size()), "cell"));
  if (const auto n = in_state(CellState::Relaxed)) fmt::format_to(out, ", {} relaxed", n);
  if (const auto n = in_state(CellState::Degenerate)) fmt::format_to(out, ", {} degenerate", n);
  if (const auto n = in_state(CellState::Undecided)) fmt::format_to(out, ", {} undecided", n);
  text += '\n';
  if (encasement.perturbation > 0)
    fmt::format_to(out, "every coefficient is perturbed: delta {}, seed {}\n",
                   encasement.perturbation, encasement.seed);
  if (encasement.region.plane)
    fmt::format_to(out, "{} is proved to be simple outside of |x| <= {}, |y| <= {}\n",
                   encasement.infinity.empty() ? "not everything" : "everything",
                   -encasement.region_used.corners[0][0].get_d(),
                   -encasement.region_used.corners[0][1].get_d());
  else if (encasement.region_used.corners != encasement.region.corners)
    text +=
        "a side or corner of the region is not in generic position: a slightly larger polygon "
        "is encased\n";
  text += crossing_table(encasement);
  text += unresolved_list(encasement, encasement.degenerate, "degenerate");
  text += unresolved_list(encasement, encasement.undecided, "undecided");
  return text;
}

std::string statistics_report(const Encasement& encasement) {
  const Statistics& s = encasement.statistics;
  std::size_t rays = 0;
  int depth = 0;
  for (const Cell& cell : encasement.cells) {
    rays += cell.loop_certificates.size();
    depth = std::max(depth, cell.depth);
  }
  return fmt::format(
      "\n"
      "1. sanity            curves read {}, to encase {}\n"
      "2. crossings         found {}, boxes visited {}; pairs met {}, isolated {}, in vain {}\n"
      "3. critical regions  found {}, boxes visited {}\n"
      "4. split             candidate lines {}, splits {} ({} for loops), depth {}\n"
      "5. certify           cells {}, crossings on lines {}, rays {}\n"
      "decisions            double {}, MPFR {}, exact {}, undecided {}\n"
      "expansions           {} ({} in MPFR), restrictions {}\n"
      "CPU time             {:.3g} s\n",
      encasement.input.size(), encasement.curves.size(), encasement.crossings.size(), s.root_boxes,
      s.pairs_met, s.pairs_isolated, s.filter_failures, encasement.critical_regions.size(),
      s.critical_boxes, s.candidate_lines, s.splits, s.loop_splits, depth, encasement.cells.size(),
      encasement.line_crossings.size(), rays, s.decisions.by_double, s.decisions.by_mpfr,
      s.decisions.by_exact, s.decisions.undecided, s.expansions, s.mpfr_expansions, s.restrictions,
      encasement.seconds);
}

}  // namespace encase
