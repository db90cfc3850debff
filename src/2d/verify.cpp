// SPDX-License-Identifier: MIT
#include "encase/verify.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>

#include "common/parallel.hpp"
#include "common/verify_functions.hpp"
#include "common/well_formed.hpp"
#include "verify_claims.hpp"

namespace encase {

namespace verification {

void for_each(Claims& claims, std::size_t count,
              const std::function<void(Claims& part, std::size_t i)>& check) {
  if (claims.full()) return;
  // Some hundreds of tasks, and as many for any number of threads.
  const std::size_t size = std::max<std::size_t>(1, count / 256), tasks = (count + size - 1) / size;
  std::vector<Verification> reports(tasks);
  std::atomic<std::size_t> enough = tasks;  // beyond this task's no objection will be kept
  parallel_for(static_cast<int>(tasks), claims.facts.options.threads, [&](int index) {
    const auto task = static_cast<std::size_t>(index);
    if (task > enough) return;
    Claims part(claims.facts);
    for (std::size_t i = task * size; i < std::min(count, (task + 1) * size) && !part.full(); ++i)
      check(part, i);
    std::size_t known = enough;
    while (part.full() && task < known && !enough.compare_exchange_weak(known, task)) {
    }
    reports[task] = std::move(part.report);
  });
  for (Verification& report : reports) {
    if (claims.full()) return;
    claims.report.claims += report.claims;
    for (std::string& objection : report.objections)
      if (!claims.full()) claims.report.objections.push_back(std::move(objection));
  }
}

namespace {

void check_function(Claims& claims, const char* name, std::size_t i, const Function<2>& function) {
  if (function.is_polynomial()) {
    claims.require(is_proper(function), name, " ", i, " is not a polynomial of degree 1 to ",
                   kMaxDegree, ".");
  } else {
    claims.require(is_proper(function), name, " ", i, " is not an expression in x and y.");
    claims.require(!claims.result.region.plane, name, " ", i,
                   " is no polynomial: nothing is proved of it in the whole plane.");
  }
}

bool is_line(const Line& line) {
  if (!finite(line.normal) || !finite(line.offset)) return false;
  if (line.normal[0] == 0 && line.normal[1] == 0) return false;
  if (!line.rational) return true;
  for (const Rational& c : *line.rational)
    if (!proper(c)) return false;
  const Line rounded = Line::from_rationals(*line.rational);
  // The sign of a rounded coefficient stands for that of the exact one: neither underflows.
  for (std::size_t i = 0; i < 2; ++i)
    if ((line.normal[i] == 0) != ((*line.rational)[i] == 0)) return false;
  return rounded.normal == line.normal && rounded.offset == line.offset;
}

bool is_region(const Region& region) {
  for (const auto& corner : region.corners)
    if (!proper(corner[0]) || !proper(corner[1])) return false;
  return region.corners.size() >= 3;
}

bool is_child(int child, const Encasement& e) {
  return child >= 0 ? in_range(child, e.history) : in_range(~child, e.cells);
}

void check_input_structure(Claims& claims) {
  const Encasement& e = claims.result;
  claims.require(finite(e.perturbation) && e.perturbation >= 0,
                 "The perturbation is not a number.");
  for (std::size_t i = 0; i < e.input.size(); ++i)
    check_function(claims, "Input curve", i, e.input[i].function);
  for (std::size_t i = 0; i < e.curves.size(); ++i) {
    const Curve& curve = e.curves[i];
    check_function(claims, "Curve", i, curve.function);
    claims.require(
        !curve.sources.empty() && ascending(curve.sources) && all_in_range(curve.sources, e.input),
        "Curve ", i, " does not name ascending indices of input curves.");
  }
  claims.require(e.region.plane ? e.region.corners.empty() : is_region(e.region),
                 "The region is not a polygon with rational corners.");
  claims.require(is_region(e.region_used),
                 "The region used is not a polygon with rational corners.");
  for (std::size_t i = 0; i < e.lines.size() && !claims.full(); ++i)
    claims.require(is_line(e.lines[i]), "Line ", i, " has no valid coefficients.");
  claims.require(e.lines.size() >= e.region_used.corners.size(),
                 "There are fewer lines than sides of the region used.");
}

void check_crossing_structure(Claims& claims) {
  const Encasement& e = claims.result;
  for (std::size_t i = 0; i < e.line_crossings.size() && !claims.full(); ++i) {
    const LineCrossing& c = e.line_crossings[i];
    claims.require(in_range(c.line, e.lines) && in_range(c.curve, e.curves) && finite(c.lo) &&
                       finite(c.hi) && c.lo < c.hi,
                   "Line crossing ", i, " has a bad index or interval.");
  }
  for (std::size_t i = 0; i < e.crossings.size() && !claims.full(); ++i) {
    const Crossing& c = e.crossings[i];
    claims.require(in_range(c.curves[0], e.curves) && in_range(c.curves[1], e.curves) &&
                       c.curves[0] < c.curves[1],
                   "Crossing ", i, " does not name two curves in ascending order.");
    claims.require(has_interior(c.box) && finite(c.point), "Crossing ", i,
                   " has a bad box or point.");
    claims.require(c.cell == -1 || in_range(c.cell, e.cells), "Crossing ", i,
                   " names a cell that does not exist.");
    claims.require(c.location == Location::Inside || c.location == Location::OnBoundary ||
                       c.location == Location::Outside,
                   "Crossing ", i, " has no valid location.");
  }
}

void check_cell_structure(Claims& claims) {
  const Encasement& e = claims.result;
  for (std::size_t i = 0; i < e.cells.size() && !claims.full(); ++i) {
    const Cell& cell = e.cells[i];
    bool vertices = cell.vertices.size() >= 3;
    for (const Vertex& v : cell.vertices)
      vertices = vertices && in_range(v.line_in, e.lines) && in_range(v.line_out, e.lines) &&
                 finite(v.parameter) && finite(v.point);
    claims.require(vertices, "Cell ", i, " has a vertex with a bad line or number.");
    bool word = true;
    for (int c : cell.word) word = word && in_range(c, e.line_crossings);
    claims.require(word, "The word of cell ", i, " names a line crossing that does not exist.");
    bool branches = true;
    for (const Branch& b : cell.branches)
      branches = branches && in_range(b.curve, e.curves) && in_range(b.from, e.line_crossings) &&
                 in_range(b.to, e.line_crossings);
    claims.require(branches, "A branch of cell ", i, " has a bad index.");
    claims.require(cell.crossing == -1 || in_range(cell.crossing, e.crossings), "Cell ", i,
                   " names a crossing that does not exist.");
    bool certificates = true;
    for (const LoopCertificate& c : cell.loop_certificates)
      certificates = certificates && in_range(c.critical_region, e.critical_regions) &&
                     finite(c.from) && finite(c.to);
    claims.require(certificates, "A loop certificate of cell ", i, " has a bad index or point.");
    claims.require(cell.state == CellState::Certified || cell.state == CellState::Relaxed ||
                       cell.state == CellState::Degenerate || cell.state == CellState::Undecided,
                   "Cell ", i, " has no valid state.");
  }
  for (std::size_t i = 0; i < e.history.size() && !claims.full(); ++i) {
    const Split& split = e.history[i];
    claims.require(
        in_range(split.line, e.lines) && is_child(split.negative, e) && is_child(split.positive, e),
        "Split ", i, " has a bad line or child.");
  }
}

template <class T>
bool are_tokens(const std::vector<int>& tokens, const std::vector<T>& items) {
  for (int token : tokens)
    if (token < cover::kUnresolved || token == cover::kSplitZ ||
        (token >= 0 && !in_range(token, items)))
      return false;
  return true;
}

void check_shared_structure(Claims& claims) {
  const Encasement& e = claims.result;
  const SharedCover& cover = e.shared_cover;
  if (cover.tokens.empty() && cover.alive.empty()) return;
  bool tokens = true;
  std::size_t next = 0;
  for (int token : cover.tokens) {
    if (token == cover::kSplitX || token == cover::kSplitY || token == cover::kOutside ||
        token == cover::kUnresolved)
      continue;
    tokens = tokens && token >= 0 && static_cast<std::size_t>(token) == next++;
  }
  claims.require(has_interior(cover.root) && tokens && next == cover.alive.size(),
                 "The shared cover has a bad root or token.");
  bool curves = true;
  for (const std::vector<int>& alive : cover.alive) {
    curves = curves && ascending(alive);
    for (int c : alive) curves = curves && in_range(c, e.curves);
  }
  claims.require(curves, "The shared cover does not name ascending indices of curves.");
}

void check_certificate_structure(Claims& claims) {
  const Encasement& e = claims.result;
  for (std::size_t i = 0; i < e.crossing_covers.size() && !claims.full(); ++i) {
    const CrossingCover& c = e.crossing_covers[i];
    claims.require(in_range(c.curves[0], e.curves) && in_range(c.curves[1], e.curves) &&
                       c.curves[0] < c.curves[1] && has_interior(c.root) &&
                       are_tokens(c.tokens, e.crossings),
                   "Crossing cover ", i, " has a bad index, root or token.");
  }
  for (std::size_t i = 0; i < e.critical_covers.size() && !claims.full(); ++i) {
    const CriticalCover& c = e.critical_covers[i];
    claims.require(in_range(c.curve, e.curves) && has_interior(c.root) &&
                       are_tokens(c.tokens, e.critical_regions),
                   "Critical cover ", i, " has a bad index, root or token.");
  }
  for (std::size_t i = 0; i < e.critical_regions.size() && !claims.full(); ++i) {
    const CriticalRegion& r = e.critical_regions[i];
    bool boxes = !r.boxes.empty();
    for (const Box<2>& box : r.boxes) boxes = boxes && ordered(box);
    claims.require(in_range(r.curve, e.curves) && boxes, "Critical region ", i,
                   " has a bad curve or box.");
    claims.require(r.sign == Sign::Negative || r.sign == Sign::Positive, "Critical region ", i,
                   " has no sign.");
  }
  using Kind = Unresolved::Kind;
  for (const auto* list : {&e.degenerate, &e.undecided})
    for (std::size_t i = 0; i < list->size() && !claims.full(); ++i) {
      const Unresolved& u = (*list)[i];
      const char* name = list == &e.degenerate ? "Degenerate" : "Undecided";
      const bool component = u.kind == Kind::SharedComponent || u.kind == Kind::RepeatedComponent;
      bool curves = ascending(u.curves);
      for (int c : u.curves)
        curves = curves && (component ? in_range(c, e.input) : in_range(c, e.curves));
      claims.require(curves, name, " entry ", i, " does not name ascending indices of curves.");
      claims.require(!u.has_box || ordered(u.box), name, " entry ", i, " has a bad box.");
      claims.require(component || u.kind == Kind::Contact || u.kind == Kind::SingularPoint ||
                         u.kind == Kind::Concurrency || u.kind == Kind::NotAnalytic ||
                         (u.kind == Kind::Infinity && e.region.plane) || u.kind == Kind::Budget,
                     name, " entry ", i, " has no valid kind.");
    }
}

}  // namespace

bool check_structure(Claims& claims) {
  check_input_structure(claims);
  check_crossing_structure(claims);
  check_cell_structure(claims);
  check_shared_structure(claims);
  check_certificate_structure(claims);
  return claims.report.ok();
}

}  // namespace verification

Verification verify(const Encasement& encasement, const VerifyOptions& options) {
  using namespace verification;
  Facts facts{encasement, options};
  Claims claims(facts);

  // Index errors and the like first, so that everything below may follow indices freely.
  if (!check_structure(claims)) return claims.report;
  claims.curves.reserve(encasement.curves.size());
  for (const Curve& curve : encasement.curves) claims.curves.emplace_back(curve.function);

  // The cheap statements that everything refers to.
  check_outcome(claims, encasement);
  check_curves(claims);
  if (!check_regions(claims) || claims.full()) return claims.report;

  // Where curves can be at all; the partition with all zeros on its lines; then what lies inside.
  check_shared_cover(claims);
  const Partition partition = replay_history(claims);
  if (partition.complete) {
    check_cell_boundaries(claims, partition);
    check_crossings(claims, partition);
    check_cells(claims, partition);
  }

  // No crossing and no loop is missing from the lists.
  check_crossing_covers(claims);
  check_critical_regions(claims);
  check_critical_covers(claims);

  // What all of this makes of the region.
  if (claims.report.ok() && encasement.outcome == Outcome::Certified) check_arrangement(claims);
  return claims.report;
}

}  // namespace encase
