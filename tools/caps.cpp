// SPDX-License-Identifier: MIT
#include "caps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "curves_input.hpp"
#include "encase/caps_output.hpp"
#include "io/names.hpp"
#include "output.hpp"
#include "progress.hpp"
#ifdef ENCASE_HAVE_VTK
#include "encase/caps_vtk.hpp"
#endif

namespace encase {
namespace {

/// A file's word as people write it.
std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string names_of(const CapsResult& r, const std::vector<int>& curves) {
  std::string names;
  for (const int c : curves)
    names += (names.empty() ? "" : " & ") + r.curves[static_cast<std::size_t>(c)].name;
  return names;
}

std::string vertex_table(const CapsResult& r) {
  constexpr std::size_t kMostShown = 60;
  if (r.vertices.empty()) return "";
  const std::size_t shown = std::min(r.vertices.size(), kMostShown);
  std::size_t width = 6;
  for (std::size_t v = 0; v < shown; ++v)
    width = std::max(width, names_of(r, r.vertices[v].curves).size());
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "\n{:>5}  {:<13}  {:<{}}  {:>14}  {:>14}  {:>8}\n", "id", "kind", "curves",
                 width, "x", "y", "width");
  for (std::size_t v = 0; v < shown; ++v) {
    const CapsVertex& vertex = r.vertices[v];
    const Point<2> center = vertex.box.center();
    fmt::format_to(out, "{:>5}  {:<13}  {:<{}}  {:>14.8g}  {:>14.8g}  {:>8.1e}\n", v,
                   words(name_of(kCapsVertexKinds, vertex.kind)), names_of(r, vertex.curves), width,
                   center[0], center[1], vertex.box.largest_width());
  }
  if (shown < r.vertices.size())
    fmt::format_to(out, "  and {} more: --json lists them all\n", r.vertices.size() - shown);
  return text;
}

std::string obstacle_list(const CapsResult& r) {
  const CapsObstacles& o = r.obstacles;
  std::string text;
  auto out = std::back_inserter(text);
  if (o.open_vertices)
    fmt::format_to(out, "  {} vertices are not proved to be a single crossing of two curves\n",
                   o.open_vertices);
  if (o.unexamined_leaves)
    fmt::format_to(out, "  in {} leaves the only curve may cross itself{}\n", o.unexamined_leaves,
                   r.self_crossings ? "" : ": --self-crossings looks");
  if (o.open_edges)
    fmt::format_to(out, "  {} edges are not proved to be a single arc\n", o.open_edges);
  if (o.indeterminate_leaves)
    fmt::format_to(out, "  {} leaves are larger than epsilon: a limit was reached\n",
                   o.indeterminate_leaves);
  return text.empty() ? "" : "\nnot exact:\n" + text;
}

std::string caps_report(const CapsResult& r) {
  std::string text;
  auto out = std::back_inserter(text);
  switch (r.answer) {
    case CapsClass::Exact:
      text = "exact: the graph is proved to be that of the arrangement";
      break;
    case CapsClass::DeltaWeak:
      fmt::format_to(out, "delta-weak, delta {}: of curves distorted by at most that", r.delta);
      break;
    case CapsClass::Undecided:
      text = "undecided: a limit on boxes or seconds, or a cancellation, ended the subdivision";
      break;
  }
  fmt::format_to(out, "\n{} curves, {} vertices, {} edges; quadtree of {} nodes, {} leaves\n",
                 r.curves.size(), r.vertices.size(), r.edges.size(), r.nodes, r.leaves.size());
  return text + vertex_table(r) + obstacle_list(r);
}

std::string statistics_report(const CapsResult& r) {
  std::array<int, 4> labels{};
  int depth = 0, apart = 0;
  for (const CapsLeaf& leaf : r.leaves) {
    ++labels[static_cast<std::size_t>(leaf.label)];
    depth = std::max(depth, leaf.depth);
  }
  for (const CapsRegion& region : r.regions) apart += region.apart;
  return fmt::format(
      "\n"
      "quadtree   nodes {}, depth {}; leaves empty {}, one curve {}, several {}, indeterminate {}\n"
      "regions    {}, of two curves that are proved to be apart {}\n"
      "CPU time   {:.3g} s, of them {:.3g} s for the quadtree; functions evaluated {} times\n",
      r.nodes, depth, labels[0], labels[1], labels[2], labels[3], r.regions.size(), apart,
      r.seconds, r.tree_seconds, r.evaluations);
}

Status write_files(const CapsRequest& r, const CapsResult& result) {
  if (!r.json.empty())
    if (const Status status = write_output(r.json, to_json(result))) return status;
  if (!r.svg.empty())
    if (const Status status = write_output(r.svg, to_svg(result))) return status;
#ifdef ENCASE_HAVE_VTK
  if (!r.vtk_directory.empty())
    if (const Status status = write_vtk(result, r.vtk_directory)) return status;
#endif
  return {};
}

Status write_report(const CapsRequest& r, const CapsResult& result) {
  return print_report(r, r.summary ? summary_json(result) : "",
                      caps_report(result) + (r.verbose ? statistics_report(result) : ""));
}

}  // namespace

ExitCode run_caps(CapsRequest request) {
  const double max_seconds = request.options.max_seconds;
  if (const Status status = check_request(request, "caps", "curves", max_seconds))
    return fail(*status);
  if (const Status status = check_outputs(request)) return fail(*status);
  const auto input = read_curves_input(request.file, request.expressions, request.region, true);
  if (!input) return fail(input.error());

  std::optional<Progress> progress(std::in_place, may_show_progress(request));
  request.options.progress = progress->callback();
  const auto result = caps(input.value().curves, *input.value().region, request.options);
  progress->begin("writing the result");
  Status status = result ? write_files(request, result.value()) : Status(result.error());
  progress.reset();
  if (!status) status = write_report(request, result.value());
  return status ? fail(*status) : exit_code(result.value().answer);
}

}  // namespace encase
