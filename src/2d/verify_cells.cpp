// SPDX-License-Identifier: MIT
#include <algorithm>

#include "common/segments.hpp"
#include "verify_claims.hpp"

namespace encase::verification {

namespace {

/// A cell's certificate about a critical region: every loop of the curve inside the cell that
/// surrounds the region bounds a disc D in the cell's interior. The region is connected and f is
/// not zero on it, so all of it lies in D, with `from`. A point `to` that is not in the cell's
/// interior is not in D, and so the segment meets the loop; but it has no root of f.
void check_loop_certificates(Claims& claims, const Partition& partition, std::size_t i) {
  const Encasement& e = claims.result;
  for (const LoopCertificate& certificate : e.cells[i].loop_certificates) {
    if (claims.full()) return;
    const auto& region = e.critical_regions[static_cast<std::size_t>(certificate.critical_region)];
    const auto holds = [&](const Box<2>& box) { return box.contains(certificate.from); };
    const auto leaves = [&](const Edge& edge) {
      return side(e.lines[static_cast<std::size_t>(edge.line)], certificate.to, claims.kernel) !=
             edge.interior;
    };
    const bool starts = std::any_of(region.boxes.begin(), region.boxes.end(), holds);
    const Polygon& polygon = partition.cells[i];
    const bool ends = std::any_of(polygon.begin(), polygon.end(), leaves);
    const auto& f = claims.curves[static_cast<std::size_t>(region.curve)];
    claims.require(
        starts && ends && no_root_on_segment(f, certificate.from, certificate.to, claims.kernel),
        "The certificate of cell ", i, " that no loop of curve ", region.curve,
        " surrounds critical region ", certificate.critical_region, " does not hold.");
  }
}

/// The two places of every curve in a word; false if a curve has one or more than two.
bool paired(const Encasement& e, const std::vector<int>& word,
            std::vector<std::pair<int, std::array<std::size_t, 2>>>* places) {
  std::vector<std::pair<int, std::size_t>> sorted;
  for (std::size_t k = 0; k < word.size(); ++k)
    sorted.emplace_back(e.line_crossings[static_cast<std::size_t>(word[k])].curve, k);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < sorted.size(); k += 2) {
    if (k + 1 == sorted.size() || sorted[k].first != sorted[k + 1].first) return false;
    if (k > 0 && sorted[k - 1].first == sorted[k].first) return false;
    places->push_back({sorted[k].first, {sorted[k].second, sorted[k + 1].second}});
  }
  return true;
}

/// The definition. No curve has a loop in the cell (certificates), all are smooth there (critical
/// covers), transversal to the edges and not through a corner (line crossings): a curve is one
/// branch for each pair of its crossings in the word, and absent if it has none. The crossings
/// inside are those listed (crossing covers).
void check_definition(Claims& claims, std::size_t i, const std::vector<int>& inside) {
  const Encasement& e = claims.result;
  const Cell& cell = e.cells[i];
  std::vector<std::pair<int, std::array<std::size_t, 2>>> places;
  if (!claims.require(paired(e, cell.word, &places) && places.size() <= 2, "Cell ", i,
                      " has more than two curves or a curve without exactly one branch."))
    return;
  bool alternates = false;
  if (places.size() == 2) {
    const auto [a, b] = places[0].second;
    const auto within = [&](std::size_t k) { return a < k && k < b; };
    alternates = within(places[1].second[0]) != within(places[1].second[1]);
  }
  if (cell.state == CellState::Relaxed)
    claims.require(places.size() == 2 && !alternates, "The relaxed cell ", i,
                   " has no two branches that do not cross.");
  else
    claims.require(places.size() < 2 || alternates, "Cell ", i,
                   " has two branches that do not cross, but is not relaxed.");
  if (alternates) {
    const bool one = inside.size() == 1 && cell.crossing == inside[0] &&
                     e.crossings[static_cast<std::size_t>(inside[0])].curves ==
                         std::array{places[0].first, places[1].first};
    claims.require(one, "Cell ", i, " does not name the only crossing of its two curves inside.");
  } else {
    claims.require(inside.empty() && cell.crossing == -1, "Cell ", i,
                   " has or names a crossing, but no two branches that cross.");
  }

  bool branches = cell.branches.size() == places.size();
  for (const auto& [curve, at] : places) {
    const int first = cell.word[at[0]], second = cell.word[at[1]];
    branches =
        branches &&
        std::any_of(cell.branches.begin(), cell.branches.end(), [&, c = curve](const Branch& b) {
          return b.curve == c &&
                 ((b.from == first && b.to == second) || (b.from == second && b.to == first));
        });
  }
  claims.require(branches, "The branches of cell ", i, " are not those of its word.");
}

/// Every critical region in the interior of a certified cell has a certificate there. One that is
/// not in the interior of any cell is surrounded by no loop inside a cell.
void check_loops_are_excluded(Claims& claims) {
  const Encasement& e = claims.result;
  for (std::size_t k = 0; k < e.critical_regions.size() && !claims.full(); ++k) {
    const int c = cell_around(claims, e.critical_regions[k].boxes);
    if (c < 0) continue;
    const Cell& cell = e.cells[static_cast<std::size_t>(c)];
    if (!certified(cell)) continue;
    const bool has = std::any_of(cell.loop_certificates.begin(), cell.loop_certificates.end(),
                                 [&](const LoopCertificate& certificate) {
                                   return certificate.critical_region == static_cast<int>(k);
                                 });
    claims.require(has, "Cell ", c, " has no certificate that no loop of curve ",
                   e.critical_regions[k].curve, " surrounds critical region ", k, ".");
  }
}

/// No unresolved box meets a certified cell, and every degenerate cell meets a degenerate box.
void check_states(Claims& claims, const Partition& partition) {
  const Encasement& e = claims.result;
  std::vector<bool> degenerate(e.cells.size(), false);
  for (const auto* list : {&e.degenerate, &e.undecided})
    for (std::size_t k = 0; k < list->size() && !claims.full(); ++k) {
      const Unresolved& u = (*list)[k];
      const bool component = u.kind == Unresolved::Kind::SharedComponent ||
                             u.kind == Unresolved::Kind::RepeatedComponent;
      const char* name = list == &e.degenerate ? "degenerate" : "undecided";
      claims.require(!u.proved || component, "The diagnosis of ", name, " entry ", k,
                     " is said to be proved, but there is no proof.");
      if (!u.has_box || component) continue;
      for (int c : cells_near(claims, partition, u.box)) {
        if (list == &e.degenerate) degenerate[static_cast<std::size_t>(c)] = true;
        claims.require(!certified(e.cells[static_cast<std::size_t>(c)]), "The certified cell ", c,
                       " meets the box of ", name, " entry ", k, ".");
      }
    }
  for (std::size_t i = 0; i < e.cells.size() && !claims.full(); ++i)
    if (e.cells[i].state == CellState::Degenerate)
      claims.require(degenerate[i], "The degenerate cell ", i, " meets no degenerate box.");
}

}  // namespace

void check_cells(Claims& claims, const Partition& partition) {
  const Encasement& e = claims.result;
  std::vector<std::vector<int>> inside(e.cells.size());
  for (std::size_t k = 0; k < e.crossings.size(); ++k)
    if (e.crossings[k].cell >= 0)
      inside[static_cast<std::size_t>(e.crossings[k].cell)].push_back(static_cast<int>(k));
  for (std::size_t i = 0; i < e.cells.size() && !claims.full(); ++i) {
    const Cell& cell = e.cells[i];
    check_loop_certificates(claims, partition, i);
    if (certified(cell)) {
      check_definition(claims, i, inside[i]);
      continue;
    }
    claims.require(cell.branches.empty(), "Cell ", i, " is not certified but has branches.");
    claims.require(cell.crossing < 0 || e.crossings[static_cast<std::size_t>(cell.crossing)].cell ==
                                            static_cast<int>(i),
                   "Cell ", i, " names a crossing that names another cell.");
  }
  check_loops_are_excluded(claims);
  check_states(claims, partition);
}

}  // namespace encase::verification
