// SPDX-License-Identifier: MIT
#include "encase/space_arrangement.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "3d/patch_faces.hpp"
#include "3d/side_lines.hpp"
#include "common/union_find.hpp"

namespace encase {

std::vector<int> SpaceArrangement::neighbours(int region) const {
  std::set<int> found;
  for (const int face : regions[region].faces)
    for (const int other : faces[face].regions)
      if (other != region) found.insert(other);
  return {found.begin(), found.end()};
}

namespace {

constexpr Sign kSigns[] = {Sign::Negative, Sign::Positive};

/// Joins what lies in the same region: the faces of facets, and the two sides of the faces of
/// patches ("elements"). docs/space-arrangement.md says why that is all.
class SpaceGluer {
 public:
  explicit SpaceGluer(const SurfaceEncasement& encasement)
      : e_(encasement), tables_(encasement), regions_(0), faces_(0), patches_(0) {}

  Result<SpaceArrangement> run() {
    cut();
    if (fault_.empty()) number();
    if (fault_.empty()) join_in_cells();
    if (fault_.empty())
      for_neighbours_along_lines(
          e_, [&](int f, int a, int g, int b) { regions_.join(facet(f, a), facet(g, b)); },
          &fault_);
    if (fault_.empty()) join_across_facets();
    if (fault_.empty()) name_components();
    if (fault_.empty()) name_faces();
    if (fault_.empty()) name_regions();
    if (!open_.empty()) return Error{Error::Code::Undecided, open_};
    if (!fault_.empty())
      return Error{Error::Code::Internal, "the encasement's parts do not fit together: " + fault_};
    return std::move(result_);
  }

 private:
  void cut() {
    for (std::size_t c = 0; c < e_.cells.size() && fault_.empty(); ++c)
      cells_.push_back(cut_patches(e_, tables_, static_cast<int>(c), &fault_));
  }

  void number() {
    int next = 0;
    for (const Facet& facet : e_.facets) {
      first_of_facet_.push_back(next);
      next += faces_on(facet);
    }
    int faces = 0, patches = 0;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      first_face_.push_back(faces);
      first_patch_.push_back(patches);
      faces += static_cast<int>(cells_[c].patch_of.size());
      patches += static_cast<int>(e_.cells[c].patches.size());
    }
    first_side_ = next;
    regions_ = UnionFind(static_cast<std::size_t>(next + 2 * faces));
    faces_ = UnionFind(static_cast<std::size_t>(faces));
    patches_ = UnionFind(static_cast<std::size_t>(patches));
  }

  static int faces_on(const Facet& facet) {
    return facet.surfaces.empty() ? 1 : static_cast<int>(facet.arrangement.faces.size());
  }
  int facet(int index, int face) const { return first_of_facet_[index] + face; }
  int face(int cell, int face_of_cell) const { return first_face_[cell] + face_of_cell; }
  /// The side of a patch's face where its surface has the sign.
  int side(int cell, int face_of_cell, Sign sign) const {
    return first_side_ + 2 * face(cell, face_of_cell) + side_index(sign);
  }

  void join_in_cells() {
    for (std::size_t k = 0; k < e_.cells.size(); ++k) {
      const int c = static_cast<int>(k);
      const SpaceCell& cell = e_.cells[k];
      for (std::size_t p = 0; p < cell.patches.size(); ++p) {
        const SurfacePatch& patch = cell.patches[p];
        if (patch.loop.empty()) {
          join_around_sphere(c, static_cast<int>(p));
          continue;
        }
        for (std::size_t i = 0; i < patch.loop.size(); ++i)
          join_at(c, patch.surface, patch.loop[i], cells_[k].at_loop[p][i]);
      }
      for (std::size_t a = 0; a < cell.arcs.size(); ++a)
        for (const PatchFaces::ArcPiece& piece : cells_[k].arc_pieces[a])
          for (const Sign first : kSigns)
            for (const Sign second : kSigns)
              regions_.join(side(c, piece.sides[0][side_index(second)], first),
                            side(c, piece.sides[1][side_index(first)], second));
    }
  }

  /// Along a loop the facet's faces on either side lie in the regions on either side of the patch.
  void join_at(int cell, int surface, const FacetEdge& edge, int face_of_cell) {
    const Arrangement& a = e_.facets[edge.facet].arrangement;
    for (const int h : {edge.half_edge, Arrangement::twin(edge.half_edge)}) {
      const Sign sign = tables_.sign(edge.facet, a.half_edges[h].face, surface);
      if (sign == Sign::Zero) fault_ = "a surface has no sign beside its loop";
      regions_.join(facet(edge.facet, a.half_edges[h].face), side(cell, face_of_cell, sign));
    }
  }

  /// A closed sphere is the only patch of its cell: the cell's whole boundary lies outside of it.
  void join_around_sphere(int c, int p) {
    const SpaceCell& cell = e_.cells[c];
    if (cell.patches.size() > 1) {
      fault_ = "a closed sphere shares its cell with another piece of a surface";
      return;
    }
    const int surface = cell.patches[p].surface;
    const Facet& any = e_.facets[cell.facets[0]];
    int inside = 0;
    if (!any.surfaces.empty()) inside = any.arrangement.outside == 0 ? 1 : 0;
    const Sign sign = tables_.sign(cell.facets[0], inside, surface);
    if (sign == Sign::Zero) {
      fault_ = "a closed sphere's surface has no sign around it";
      return;
    }
    regions_.join(facet(cell.facets[0], inside), side(c, cells_[c].of_sphere[p], sign));
  }

  void join_across_facets() {
    std::map<std::array<int, 2>, std::array<int, 2>> first;  // (facet, edge): face and patch
    for (std::size_t k = 0; k < e_.cells.size(); ++k)
      for (std::size_t p = 0; p < e_.cells[k].patches.size(); ++p) {
        const auto& loop = e_.cells[k].patches[p].loop;
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const int own = face(static_cast<int>(k), cells_[k].at_loop[p][i]);
          const int patch = first_patch_[k] + static_cast<int>(p);
          const auto [at, fresh] =
              first.emplace(std::array{loop[i].facet, Arrangement::edge_of(loop[i].half_edge)},
                            std::array{own, patch});
          if (fresh) continue;
          faces_.join(own, at->second[0]);
          patches_.join(patch, at->second[1]);
        }
      }
  }

  void name_components() {
    std::map<int, int> names;
    for (std::size_t surface = 0; surface < e_.surfaces.size(); ++surface)
      for (std::size_t k = 0; k < e_.cells.size(); ++k)
        for (std::size_t p = 0; p < e_.cells[k].patches.size(); ++p) {
          if (e_.cells[k].patches[p].surface != static_cast<int>(surface)) continue;
          const int set = patches_.find(first_patch_[k] + static_cast<int>(p));
          const auto [at, fresh] = names.emplace(set, static_cast<int>(result_.components.size()));
          if (fresh) result_.components.push_back({static_cast<int>(surface), true, 0, {}});
          result_.components[at->second].patches.push_back(
              {static_cast<int>(k), static_cast<int>(p)});
        }
    for (auto& component : result_.components) measure(&component);
    component_names_ = std::move(names);
  }

  /// Vertices minus edges plus patches: discs, and spheres, which count 2. The vertices and edges
  /// are those of the facets; a loop within a facet has as many of the one as of the other.
  void measure(SpaceArrangement::Component* component) {
    std::set<int> vertices;
    std::set<std::array<int, 2>> edges;
    int patches = 0;
    for (const auto& [cell, p] : component->patches) {
      const SurfacePatch& patch = e_.cells[cell].patches[p];
      patches += patch.loop.empty() ? 2 : 1;
      for (const FacetEdge& edge : patch.loop) {
        const Facet& facet = e_.facets[edge.facet];
        if (facet.cells[0] < 0 || facet.cells[1] < 0) component->closed = false;
        const auto ends = tables_.ends(edge);
        if (ends[0] < 0) continue;
        edges.insert({edge.facet, Arrangement::edge_of(edge.half_edge)});
        vertices.insert(ends.begin(), ends.end());
      }
    }
    component->euler = static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + patches;
  }

  void name_faces() {
    std::map<int, int> names;
    for (std::size_t k = 0; k < cells_.size(); ++k)
      for (std::size_t i = 0; i < cells_[k].patch_of.size(); ++i) {
        const int index = face(static_cast<int>(k), static_cast<int>(i));
        const auto [at, fresh] =
            names.emplace(faces_.find(index), static_cast<int>(result_.faces.size()));
        face_names_.push_back(at->second);
        if (!fresh) continue;
        const int patch = cells_[k].patch_of[i];
        result_.faces.push_back({e_.cells[k].patches[patch].surface,
                                 component_names_[patches_.find(first_patch_[k] + patch)],
                                 {-1, -1}});
      }
  }

  void name_regions() {
    std::map<int, int> names;
    std::vector<std::set<int>> cells, faces;
    const auto name = [&](int element) {
      const auto [at, fresh] =
          names.emplace(regions_.find(element), static_cast<int>(result_.regions.size()));
      if (fresh) {
        result_.regions.emplace_back();
        cells.emplace_back();
        faces.emplace_back();
      }
      return at->second;
    };
    const auto set_signs = [&](int region, const std::vector<Sign>& signs) {
      auto& known = result_.regions[region].signs;
      if (known.empty()) known = signs;
      if (known != signs) fault_ = "a region has two signs of a surface";
    };
    for (std::size_t f = 0; f < e_.facets.size(); ++f) {
      const Facet& facet_here = e_.facets[f];
      result_.region_of_facet.emplace_back();
      for (int i = 0; i < faces_on(facet_here); ++i) {
        if (!facet_here.surfaces.empty() && i == facet_here.arrangement.outside) {
          result_.region_of_facet.back().push_back(-1);
          continue;
        }
        const int region = name(facet(static_cast<int>(f), i));
        result_.region_of_facet.back().push_back(region);
        const std::vector<Sign> signs = signs_on_facet(static_cast<int>(f), i);
        if (std::count(signs.begin(), signs.end(), Sign::Zero) > 0)
          open_ = "the sign of a surface on a facet is not proved";
        set_signs(region, signs);
        for (const int cell : facet_here.cells)
          if (cell < 0)
            result_.regions[region].touches_boundary = true;
          else
            cells[region].insert(cell);
      }
    }
    for (std::size_t k = 0; k < cells_.size(); ++k)
      for (std::size_t i = 0; i < cells_[k].patch_of.size(); ++i)
        for (const Sign sign : kSigns) {
          const int cell = static_cast<int>(k), of_cell = static_cast<int>(i);
          const int region = name(side(cell, of_cell, sign));
          const int face_here = face_names_[face(cell, of_cell)];
          int& beside = result_.faces[face_here].regions[side_index(sign)];
          if (beside >= 0 && beside != region) fault_ = "a face borders on two regions on one side";
          beside = region;
          cells[region].insert(cell);
          faces[region].insert(face_here);
        }
    for (std::size_t k = 0; k < cells_.size(); ++k)
      set_signs_at_arcs(static_cast<int>(k), name, set_signs);
    for (std::size_t r = 0; r < result_.regions.size(); ++r) {
      result_.regions[r].cells.assign(cells[r].begin(), cells[r].end());
      result_.regions[r].faces.assign(faces[r].begin(), faces[r].end());
    }
    set_signs_in_spheres();
  }

  std::vector<Sign> signs_on_facet(int f, int face_on_facet) const {
    std::vector<Sign> signs;
    for (std::size_t s = 0; s < e_.surfaces.size(); ++s)
      signs.push_back(tables_.sign(f, face_on_facet, static_cast<int>(s)));
    return signs;
  }

  template <class Name, class SetSigns>
  void set_signs_at_arcs(int cell, const Name& name, const SetSigns& set_signs) {
    for (std::size_t a = 0; a < e_.cells[cell].arcs.size(); ++a)
      for (const PatchFaces::ArcPiece& piece : cells_[cell].arc_pieces[a])
        for (const Sign first : kSigns)
          for (const Sign second : kSigns) {
            std::vector<Sign> signs = piece.signs;
            signs[e_.cells[cell].arcs[a].surfaces[0]] = first;
            signs[e_.cells[cell].arcs[a].surfaces[1]] = second;
            set_signs(name(side(cell, piece.sides[0][side_index(second)], first)), signs);
          }
  }

  /// The inside of a closed sphere: as outside, but for the sphere's surface.
  void set_signs_in_spheres() {
    for (auto& face_here : result_.faces)
      for (int i = 0; i < 2; ++i) {
        auto& region = result_.regions[face_here.regions[i]];
        const auto& beyond = result_.regions[face_here.regions[1 - i]];
        if (!region.signs.empty() || beyond.signs.empty()) continue;
        region.signs = beyond.signs;
        region.signs[face_here.surface] = kSigns[i];
      }
  }

  const SurfaceEncasement& e_;
  FacetTables tables_;
  std::vector<PatchFaces> cells_;
  UnionFind regions_, faces_, patches_;
  std::vector<int> first_of_facet_, first_face_, first_patch_, face_names_;
  std::map<int, int> component_names_;
  int first_side_ = 0;
  SpaceArrangement result_;
  std::string fault_;  ///< what does not fit together
  std::string open_;   ///< what cannot be told
};

}  // namespace

Result<SpaceArrangement> arrange(const SurfaceEncasement& encasement) {
  if (encasement.outcome == Outcome::Degenerate)
    return Error{Error::Code::Degenerate, "surfaces that are degenerate have no arrangement"};
  if (encasement.outcome == Outcome::Undecided)
    return Error{Error::Code::Undecided, "the encasement is not decided"};
  return SpaceGluer(encasement).run();
}

Verification verify(const SurfaceEncasement& encasement, const SpaceArrangement& arrangement,
                    const VerifyOptions& options) {
  Verification result = verify(encasement, options);
  // What does not hold together is not read.
  if (!result.ok()) return result;
  const auto expected = arrange(encasement);
  const auto require = [&](bool holds, const char* objection) {
    if (holds)
      ++result.claims;
    else
      result.objections.emplace_back(objection);
  };
  require(expected.ok(), "The encasement has no arrangement of space.");
  if (!expected) return result;
  const SpaceArrangement& a = expected.value();
  require(a.components == arrangement.components,
          "The components of the surfaces are not those of the encasement.");
  require(a.faces == arrangement.faces,
          "The faces of the surfaces are not those of the encasement.");
  require(a.regions == arrangement.regions, "The regions are not those of the encasement.");
  require(a.region_of_facet == arrangement.region_of_facet,
          "The facets do not lie in the regions in which they lie.");
  return result;
}

}  // namespace encase
