// SPDX-License-Identifier: MIT
#include "surface_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "encase/intersection_curves.hpp"
#include "encase/surface_topology.hpp"
#include "io/names.hpp"

namespace encase {
namespace {

constexpr std::size_t kMostShown = 20;

std::string counted(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

template <std::size_t N>
std::string names(const SurfaceEncasement& e, const std::array<int, N>& surfaces) {
  std::string text;
  for (const int k : surfaces) text += (text.empty() ? "" : " & ") + e.surfaces[k].name;
  return text;
}

/// The largest distance, in a coordinate, from the point to what its box holds; rounded up.
double radius(const TriplePoint& t) {
  double r = 0;
  for (int i = 0; i < 3; ++i) r = std::max({r, t.box.hi[i] - t.point[i], t.point[i] - t.box.lo[i]});
  return std::nextafter(r, INFINITY);
}

std::string point_table(const SurfaceEncasement& e) {
  if (e.triple_points.empty()) return "";
  std::size_t width = 8;
  for (const TriplePoint& t : e.triple_points) width = std::max(width, names(e, t.surfaces).size());
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "\n{:>5}  {:<{}}  {:>23}  {:>23}  {:>23}  {:>8}  {:>5}\n", "id", "surfaces",
                 width, "x", "y", "z", "radius", "cell");
  for (std::size_t k = 0; k < e.triple_points.size(); ++k) {
    const TriplePoint& t = e.triple_points[k];
    fmt::format_to(out, "{:>5}  {:<{}}  {:>23.17g}  {:>23.17g}  {:>23.17g}  {:>8.1e}  {:>5}\n", k,
                   names(e, t.surfaces), width, t.point[0], t.point[1], t.point[2], radius(t),
                   t.cell >= 0 ? std::to_string(t.cell) : std::string("-"));
  }
  return text;
}

std::string curve_table(const SurfaceEncasement& e, const std::vector<IntersectionCurve>& curves) {
  if (curves.empty()) return "";
  std::string text = "\nintersection curves\n";
  auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const IntersectionCurve& c = curves[k];
    const bool cut = c.cut_off[0] || c.cut_off[1];
    std::size_t points = 0;
    for (const ArcUse& use : c.arcs) points += e.cells[use.cell].arcs[use.arc].triple_points.size();
    fmt::format_to(out, "{:>5}  {}: {}, {}, {}{}\n", k, names(e, c.surfaces),
                   c.closed ? "closed" : "open", counted(c.arcs.size(), "arc"),
                   counted(points, "point"), cut ? ", ends where nothing is proved" : "");
  }
  return text;
}

std::string surface_table(const SurfaceEncasement& e) {
  std::string text = "\nsurfaces\n";
  auto out = std::back_inserter(text);
  for (const SurfaceTopology& shape : surface_topology(e))
    fmt::format_to(out, "  {}: {}, Euler characteristic {}, {}{}\n", e.surfaces[shape.surface].name,
                   counted(static_cast<std::size_t>(shape.components), "component"), shape.euler,
                   counted(static_cast<std::size_t>(shape.boundary_loops), "boundary loop"),
                   shape.complete ? "" : ", in certified cells");
  return text;
}

std::string unresolved_list(const SurfaceEncasement& e, const std::vector<UnresolvedInSpace>& list,
                            const char* title) {
  if (list.empty()) return "";
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "\n{}:\n", title);
  for (std::size_t i = 0; i < std::min(list.size(), kMostShown); ++i) {
    const UnresolvedInSpace& u = list[i];
    const bool of_input = names_input_curves(u.kind);
    std::string kind = name_of(kUnresolvedKinds, u.kind), surfaces;
    std::replace(kind.begin(), kind.end(), '_', ' ');
    for (const int k : u.surfaces)
      surfaces +=
          (surfaces.empty() ? "" : ", ") + (of_input ? e.input[k].name : e.surfaces[k].name);
    fmt::format_to(out, "  {}{}{}{}\n", kind, surfaces.empty() ? "" : " of ", surfaces,
                   u.proved ? " (proved)" : "");
    if (u.has_box)
      fmt::format_to(out, "    in [{}, {}] x [{}, {}] x [{}, {}]\n", u.box.lo[0], u.box.hi[0],
                     u.box.lo[1], u.box.hi[1], u.box.lo[2], u.box.hi[2]);
    if (!u.reason.empty()) fmt::format_to(out, "    {}\n", u.reason);
  }
  if (list.size() > kMostShown)
    fmt::format_to(out, "  and {} more: --json lists them all\n", list.size() - kMostShown);
  return text;
}

}  // namespace

std::string report(const SurfaceEncasement& e) {
  const auto curves = intersection_curves(e);
  const auto in_state = [&](CellState state) {
    return std::count_if(e.cells.begin(), e.cells.end(),
                         [=](const SpaceCell& cell) { return cell.state == state; });
  };
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: {}, {}, {} in {}", name_of(kOutcomes, e.outcome),
                 counted(e.surfaces.size(), "surface"),
                 counted(curves.size(), "intersection curve"),
                 counted(e.triple_points.size(), "point"), counted(e.cells.size(), "cell"));
  if (const auto n = in_state(CellState::Degenerate)) fmt::format_to(out, ", {} degenerate", n);
  if (const auto n = in_state(CellState::Undecided)) fmt::format_to(out, ", {} undecided", n);
  text += '\n';
  if (e.perturbation > 0)
    fmt::format_to(out, "every coefficient is perturbed: delta {}, seed {}\n", e.perturbation,
                   e.seed);
  if (e.region_used.sides != e.region.sides)
    text +=
        "a slightly larger polyhedron is encased: the region's numbers are no doubles, or a side, "
        "edge or corner is not in generic position\n";
  text += surface_table(e) + curve_table(e, curves) + point_table(e);
  text += unresolved_list(e, e.degenerate, "degenerate");
  text += unresolved_list(e, e.undecided, "undecided");
  return text;
}

std::string mesh_report(const SurfaceEncasement& e, const std::vector<SurfaceMesh>& meshes) {
  std::string text = "\nmeshes\n";
  auto out = std::back_inserter(text);
  for (const SurfaceMesh& mesh : meshes) {
    fmt::format_to(out,
                   "  {}: {}, {}, Euler characteristic {}, within {:.2e} and {:.3g} radians{}{}",
                   e.surfaces[mesh.surface].name, counted(mesh.points.size(), "point"),
                   counted(mesh.triangles.size(), "triangle"), mesh.euler, mesh.distance,
                   mesh.angle, mesh.within_tolerance ? "" : ", which is not what was asked",
                   mesh.complete ? "" : ", incomplete");
    if (std::isfinite(mesh.distance_to_mesh))
      fmt::format_to(out, "; all of the surface within {:.2e} of it{}\n", mesh.distance_to_mesh,
                     mesh.isotopic ? ", to which it is isotopic" : "");
    else
      text += "; its distance from all of the surface is not proved\n";
  }
  return text;
}

std::string statistics_report(const SurfaceEncasement& e) {
  const SpaceStatistics& s = e.statistics;
  int depth = 0;
  std::size_t patches = 0, arcs = 0;
  for (const SpaceCell& cell : e.cells) {
    depth = std::max(depth, cell.depth);
    patches += cell.patches.size();
    arcs += cell.arcs.size();
  }
  return fmt::format(
      "\n"
      "surfaces read {}, to encase {}\n"
      "points: found {}, boxes visited {}\n"
      "critical points: boxes visited {}\n"
      "cells {}, depth {}, certificate tests {}\n"
      "facets {}, with curves {}; splits after reading {}\n"
      "patches {}, arcs {}\n"
      "decisions: double {}, MPFR {}, exact {}, undecided {}\n"
      "CPU time {:.3g} s\n",
      e.input.size(), e.surfaces.size(), e.triple_points.size(), s.point_boxes, s.critical_boxes,
      e.cells.size(), depth, s.certificate_tests, e.facets.size(), s.facets_encased,
      s.splits_after_reading, patches, arcs, s.decisions.by_double, s.decisions.by_mpfr,
      s.decisions.by_exact, s.decisions.undecided, e.seconds);
}

}  // namespace encase
