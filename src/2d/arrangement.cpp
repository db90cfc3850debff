// SPDX-License-Identifier: MIT
#include "encase/arrangement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "2d/arrangement_faces.hpp"
#include "2d/cell_parts.hpp"
#include "common/filtered_function.hpp"
#include "common/segments.hpp"

namespace encase {
namespace {

/// A strand while edges are made of it.
struct RawStrand {
  Arrangement::Strand strand;
  int curve = -1;
  int left = -1;   ///< the region to its left, from its beginning to its end
  int right = -1;  ///< and to its right
  int along = -1;  ///< the half-edge that runs along it; -1 until it has an edge
};

/// A strand's beginning (end = 0) or end (end = 1).
struct StrandEnd {
  int strand = -1;
  int end = 0;
};

/// Where curves meet the region's boundary, in doubles that do not depend on how they are found.
class BoundaryPoints {
 public:
  explicit BoundaryPoints(const Encasement& encasement)
      : e_(encasement), polynomials_(encasement.curves.size()) {}

  Point<2> of(const LineCrossing& crossing) {
    auto& f = polynomials_[crossing.curve];
    if (!f) f.emplace(e_.curves[crossing.curve].function);
    const Line& line = e_.lines[crossing.line];
    const auto at = point_on_line(line, Rational(parameter(*f, line, crossing)));
    return {nearest_double(at[0]), nearest_double(at[1])};
  }

 private:
  /// The root's parameter rounded to nearest, ties to even.
  double parameter(const FilteredFunction<2>& f, const Line& line, const LineCrossing& crossing) {
    RootInterval root{crossing.lo, crossing.hi};
    if (const auto at = by_newton(f, line, root)) return *at;
    // Around zero halving would take as long as doubles get smaller.
    if (root.lo < 0 && root.hi > 0 && !narrow_on_line(f, line, 0, &root, kernel_)) return 0;
    while (refine_on_line(f, line, &root, kernel_)) continue;
    // What is left has no double inside but perhaps the root itself.
    const auto middle = [&] { return root.lo + 0.5 * (root.hi - root.lo); };
    for (double at = middle(); root.lo < at && at < root.hi; at = middle())
      if (!narrow_on_line(f, line, at, &root, kernel_)) return at;
    const Rational half = (Rational(root.lo) + Rational(root.hi)) / 2;
    const Sign here = f.sign_at(point_on_line(line, half), kernel_);
    if (here == Sign::Zero) return nearest_double(half);
    return here == sign_on_line(f, line, root.lo, kernel_) ? root.hi : root.lo;
  }

  /// The same by Newton's iteration, the last step with a more precise value: nothing unless f is
  /// proved to change its sign between the points halfway to both neighbours of what this leads to.
  std::optional<double> by_newton(const FilteredFunction<2>& f, const Line& line,
                                  const RootInterval& root) {
    constexpr int kSteps = 5;
    const int p = parameter_axis(line), q = 1 - p;
    const long double slope = -static_cast<long double>(line.normal[p]) / line.normal[q],
                      base = -static_cast<long double>(line.offset) / line.normal[q];
    double t = root.lo + 0.5 * (root.hi - root.lo);
    for (int k = 0; k < kSteps; ++k) {
      const long double across = base + slope * t;
      Point<2> at;
      at[p] = t;
      at[q] = static_cast<double>(across);
      const Point<2> gradient = f.gradient(at);
      double value = f.approximate(at);
      if (k + 1 == kSteps)
        value = f.evaluate(at, 2 * Kernel::kDoubleBits).value +
                gradient[q] * static_cast<double>(across - at[q]);
      t -= value / (gradient[p] + gradient[q] * static_cast<double>(slope));
      if (!(root.lo < t && t < root.hi)) return std::nullopt;
    }
    const Rational middle(t);
    std::array<Sign, 2> signs;
    for (int k = 0; k < 2; ++k) {
      const double neighbour = std::nextafter(t, k == 0 ? root.lo : root.hi);
      signs[k] = f.sign_at(point_on_line(line, (middle + Rational(neighbour)) / 2), kernel_);
    }
    const bool changes = signs[0] != Sign::Zero && signs[0] == -signs[1];
    return changes ? std::optional(t) : std::nullopt;
  }

  const Encasement& e_;
  std::vector<std::optional<FilteredFunction<2>>> polynomials_;
  Kernel kernel_;
};

/// Those at a line crossing: there is nothing else than one or two.
struct StrandEnds {
  std::array<StrandEnd, 2> ends;
  std::size_t count = 0;
  void add(const StrandEnd& end) {
    if (count < ends.size()) ends[count] = end;
    ++count;
  }
};

/// The half-edges that begin at a vertex, counter-clockwise.
struct Bundle {
  std::array<int, 4> half_edges{};
  std::size_t count = 0;
  void add(int half_edge) { half_edges[count++] = half_edge; }
};

class Builder {
 public:
  Builder(const Encasement& encasement, CellParts parts, const ArrangeOptions& options)
      : e_(encasement),
        parts_(std::move(parts)),
        options_(options),
        sides_(e_.region_used.side_count()) {}

  Result<Arrangement> run() {
    make_vertices();
    if (make_strands() && make_curve_edges() && make_boundary_edges() && link_half_edges()) {
      make_faces();
      fault_ = complete(e_, &a_);
      if (fault_.empty()) return std::move(a_);
    }
    return Error{Error::Code::Internal, "the encasement's parts do not fit together: " + fault_};
  }

 private:
  bool fail(const std::string& fault) {
    fault_ = fault;
    return false;
  }

  int add_vertex(Arrangement::Vertex::Kind kind, int index, const Point<2>& point) {
    a_.vertices.push_back({kind, index, -1, point});
    out_.emplace_back();
    return static_cast<int>(a_.vertices.size()) - 1;
  }

  void make_vertices() {
    for (int k = 0; k < sides_; ++k) {
      const RationalPoint<2>& corner = e_.region_used.corners[k];
      add_vertex(Arrangement::Vertex::Kind::Corner, k,
                 {nearest_double(corner[0]), nearest_double(corner[1])});
    }
    BoundaryPoints points(e_);
    vertex_at_line_crossing_.assign(e_.line_crossings.size(), -1);
    for (int k = 0; k < sides_; ++k)
      for (const int c : parts_.on_line[k])
        vertex_at_line_crossing_[c] =
            add_vertex(Arrangement::Vertex::Kind::OnBoundary, c,
                       options_.boundary_points ? points.of(e_.line_crossings[c]) : Point<2>{});
    vertex_in_cell_.assign(e_.cells.size(), -1);
    for (std::size_t k = 0; k < e_.cells.size(); ++k)
      if (const int c = e_.cells[k].crossing; c >= 0)
        vertex_in_cell_[k] =
            add_vertex(Arrangement::Vertex::Kind::Crossing, c, e_.crossings[c].point);
  }

  void add_strand(int cell, int branch, int from, int to, int left, int right) {
    const int id = static_cast<int>(strands_.size());
    strands_.push_back({{cell, branch, from, to},
                        e_.cells[cell].branches[branch].curve,
                        parts_.region_of_piece[left],
                        parts_.region_of_piece[right],
                        -1});
    if (from >= 0) ends_at_[from].add({id, 0});
    ends_at_[to].add({id, 1});
  }

  /// The strands of all cells. The part of a cell behind a point on its boundary lies, seen from
  /// the inside, to the left of the strand that ends there.
  bool make_strands() {
    ends_at_.resize(e_.line_crossings.size());
    first_strand_.resize(e_.cells.size());
    for (std::size_t k = 0; k < e_.cells.size(); ++k) {
      const Cell& cell = e_.cells[k];
      const auto id = static_cast<int>(k);
      first_strand_[k] = static_cast<int>(strands_.size());
      const auto place = [&](int crossing) {
        return std::find(cell.word.begin(), cell.word.end(), crossing) - cell.word.begin();
      };
      const auto branch_at = [&](int crossing) {
        const auto ends = [&](const Branch& b) { return b.from == crossing || b.to == crossing; };
        return std::find_if(cell.branches.begin(), cell.branches.end(), ends) -
               cell.branches.begin();
      };
      if (cell.crossing >= 0) {
        for (std::size_t i = 0; i < 4; ++i)
          add_strand(id, static_cast<int>(branch_at(cell.word[i])), -1, cell.word[i],
                     parts_.piece(id, i), parts_.piece(id, (i + 3) % 4));
        continue;
      }
      for (std::size_t b = 0; b < cell.branches.size(); ++b) {
        const auto from = static_cast<std::size_t>(place(cell.branches[b].from)),
                   to = static_cast<std::size_t>(place(cell.branches[b].to));
        add_strand(id, static_cast<int>(b), cell.branches[b].from, cell.branches[b].to,
                   parts_.piece(id, to), parts_.piece(id, from));
      }
    }
    for (std::size_t c = 0; c < ends_at_.size(); ++c)
      if (ends_at_[c].count != (vertex_at_line_crossing_[c] >= 0 ? 1u : 2u))
        return fail("line crossing " + std::to_string(c) + " is not where branches go on");
    return true;
  }

  int vertex_at(const RawStrand& raw, int end) const {
    const int c = end == 0 ? raw.strand.from : raw.strand.to;
    return c < 0 ? vertex_in_cell_[raw.strand.cell] : vertex_at_line_crossing_[c];
  }

  int add_edge(int from, int to, int left, int right) {
    const int edge = static_cast<int>(a_.edges.size());
    a_.edges.emplace_back();
    a_.half_edges.push_back({from, -1, -1, left});
    a_.half_edges.push_back({to, -1, -1, right});
    return edge;
  }

  /// The edge along the strand at hand and those that follow, up to a vertex or back to it.
  bool follow_strands(StrandEnd at) {
    const int first = at.strand;
    const bool backward = at.end == 1;
    const RawStrand& start = strands_[first];
    const int edge = add_edge(vertex_at(start, at.end), -1, backward ? start.right : start.left,
                              backward ? start.left : start.right);
    a_.edges[edge].curve = start.curve;
    a_.edges[edge].strands.reserve(kFewStrands);
    while (true) {
      RawStrand& raw = strands_[at.strand];
      raw.along = 2 * edge + at.end;
      Arrangement::Strand strand = raw.strand;
      if (at.end == 1) std::swap(strand.from, strand.to);
      a_.edges[edge].strands.push_back(strand);
      const int left = at.end == 1 ? raw.right : raw.left,
                right = at.end == 1 ? raw.left : raw.right;
      if (raw.curve != start.curve || left != a_.half_edges[2 * edge].face ||
          right != a_.half_edges[2 * edge + 1].face)
        return fail("the cells along an edge disagree about its faces");
      const int vertex = vertex_at(raw, 1 - at.end);
      if (vertex >= 0) {
        a_.half_edges[2 * edge + 1].origin = vertex;
        return true;
      }
      const std::array<StrandEnd, 2>& here = ends_at_[strand.to].ends;
      at = here[here[0].strand == at.strand ? 1 : 0];
      if (at.strand == first) {  // a closed loop
        for (const int h : {2 * edge, 2 * edge + 1})
          a_.half_edges[h].next = a_.half_edges[h].prev = h;
        return true;
      }
    }
  }

  bool make_curve_edges() {
    for (const bool loops : {false, true})
      for (int s = 0; s < static_cast<int>(strands_.size()); ++s)
        for (int end = 0; end < 2; ++end)
          if (strands_[s].along < 0 && (loops || vertex_at(strands_[s], end) >= 0) &&
              !follow_strands({s, end}))
            return false;
    return true;
  }

  /// The edges on the region's sides, and the order of half-edges around all vertices.
  bool make_boundary_edges() {
    std::vector<std::array<int, 2>> along_boundary(a_.vertices.size());
    for (int k = 0; k < sides_; ++k) {
      std::vector<int> stops;
      for (const int c : parts_.on_line[k]) stops.push_back(vertex_at_line_crossing_[c]);
      std::vector<int> gaps = parts_.region_of_gap[k];
      if (!parameter_grows(e_.lines[k], false)) {
        std::reverse(stops.begin(), stops.end());
        std::reverse(gaps.begin(), gaps.end());
      }
      stops.push_back((k + 1) % sides_);
      int from = k;
      for (std::size_t i = 0; i < stops.size(); ++i) {
        if (gaps[i] < 0) return fail("no cell lies along a part of the boundary");
        const int edge = add_edge(from, stops[i], gaps[i], kOutside);
        a_.edges[edge].side = k;
        along_boundary[from][0] = 2 * edge;
        along_boundary[stops[i]][1] = 2 * edge + 1;
        from = stops[i];
      }
    }
    for (std::size_t v = 0; v < a_.vertices.size(); ++v) {
      const Arrangement::Vertex& vertex = a_.vertices[v];
      if (vertex.kind == Arrangement::Vertex::Kind::Crossing) continue;
      out_[v].add(along_boundary[v][0]);
      if (vertex.kind == Arrangement::Vertex::Kind::OnBoundary) {
        const StrandEnd end = ends_at_[vertex.index].ends[0];
        out_[v].add(strands_[end.strand].along ^ end.end);
      }
      out_[v].add(along_boundary[v][1]);
    }
    for (std::size_t k = 0; k < e_.cells.size(); ++k)
      for (int i = 0; vertex_in_cell_[k] >= 0 && i < 4; ++i)
        out_[vertex_in_cell_[k]].add(strands_[first_strand_[k] + i].along);
    return true;
  }

  /// Around a face to the left, what follows a half-edge is the next one clockwise at its end.
  bool link_half_edges() {
    for (std::size_t v = 0; v < out_.size(); ++v) {
      const auto& [out, count] = out_[v];
      a_.vertices[v].half_edge = out[0];
      for (std::size_t i = 0; i < count; ++i) {
        const int arriving = Arrangement::twin(out[(i + 1) % count]), leaving = out[i];
        a_.half_edges[arriving].next = leaving;
        a_.half_edges[leaving].prev = arriving;
        if (a_.half_edges[arriving].face != a_.half_edges[leaving].face ||
            a_.half_edges[leaving].origin != static_cast<int>(v))
          return fail("the edges around a vertex disagree about its faces");
      }
    }
    return true;
  }

  /// Faces in the order of their first pieces; until here half-edges named regions of parts.
  void make_faces() {
    std::vector<int> face_of(parts_.regions, -1);
    std::vector<std::size_t> pieces_of(parts_.regions, 0);
    for (const int region : parts_.region_of_piece) ++pieces_of[region];
    a_.outside = 0;
    a_.faces.emplace_back();
    a_.pieces = std::move(parts_.pieces);
    for (std::size_t k = 0; k < a_.pieces.size(); ++k) {
      int& face = face_of[parts_.region_of_piece[k]];
      if (face < 0) {
        face = static_cast<int>(a_.faces.size());
        a_.faces.emplace_back().pieces.reserve(pieces_of[parts_.region_of_piece[k]]);
      }
      a_.pieces[k].face = face;
      a_.faces[face].pieces.push_back(static_cast<int>(k));
    }
    for (Arrangement::HalfEdge& h : a_.half_edges)
      h.face = h.face == kOutside ? a_.outside : face_of[h.face];
  }

  static constexpr int kOutside = -2;            ///< in place of a region of parts
  static constexpr std::size_t kFewStrands = 4;  ///< that most edges have at most

  const Encasement& e_;
  CellParts parts_;
  ArrangeOptions options_;
  int sides_;
  Arrangement a_;
  std::vector<int> vertex_at_line_crossing_;  ///< -1 inside the region
  std::vector<int> vertex_in_cell_;
  std::vector<RawStrand> strands_;
  std::vector<int> first_strand_;    ///< of every cell
  std::vector<StrandEnds> ends_at_;  ///< by line crossing
  std::vector<Bundle> out_;          ///< by vertex
  std::string fault_;
};

}  // namespace

Result<Arrangement> arrange(const Encasement& encasement, const ArrangeOptions& options) {
  if (encasement.outcome == Outcome::Degenerate)
    return Error{Error::Code::Degenerate,
                 "the encasement is degenerate: its list of degenerate places says why its "
                 "arrangement is not known"};
  const auto settled = [](const Cell& cell) {
    return cell.state == CellState::Certified || cell.state == CellState::Relaxed;
  };
  if (encasement.outcome != Outcome::Certified ||
      !std::all_of(encasement.cells.begin(), encasement.cells.end(), settled))
    return Error{Error::Code::Undecided,
                 "the encasement is undecided: with larger budgets its arrangement may be known"};
  Result<CellParts> parts = make_cell_parts(encasement);
  if (!parts) return parts.error();
  return Builder(encasement, std::move(parts).value(), options).run();
}

std::vector<int> Arrangement::around(int vertex) const {
  std::vector<int> out;
  int h = vertices[vertex].half_edge;
  do {
    out.push_back(h);
    h = twin(half_edges[h].prev);
  } while (h != vertices[vertex].half_edge);
  return out;
}

std::vector<int> Arrangement::faces_around(int vertex) const {
  std::vector<int> result;
  for (const int h : around(vertex)) result.push_back(half_edges[h].face);
  return result;
}

std::vector<int> Arrangement::boundaries(int face) const {
  std::vector<int> result = faces[face].holes;
  if (faces[face].outer >= 0) result.insert(result.begin(), faces[face].outer);
  return result;
}

std::vector<int> Arrangement::neighbours(int face) const {
  std::vector<int> result;
  for (const int first : boundaries(face))
    for (const int h : cycle(first)) result.push_back(across(h));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<int> Arrangement::cycle(int half_edge) const {
  std::vector<int> result;
  int h = half_edge;
  do {
    result.push_back(h);
    h = half_edges[h].next;
  } while (h != half_edge);
  return result;
}

bool Arrangement::touches_boundary(int face) const {
  if (face == outside) return true;
  const std::vector<int> boundary = cycle(faces[face].outer);
  return std::any_of(boundary.begin(), boundary.end(),
                     [&](int half_edge) { return edges[edge_of(half_edge)].curve < 0; });
}

std::vector<int> Arrangement::crossings_of(int first, int second) const {
  std::vector<int> result;
  for (int v = 0; v < static_cast<int>(vertices.size()); ++v) {
    if (vertices[v].kind != Vertex::Kind::Crossing) continue;
    const int h = vertices[v].half_edge;
    const int a = edges[edge_of(h)].curve, b = edges[edge_of(half_edges[h].prev)].curve;
    if ((a == first && b == second) || (a == second && b == first)) result.push_back(v);
  }
  return result;
}

}  // namespace encase
