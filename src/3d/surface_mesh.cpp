// SPDX-License-Identifier: MIT
#include "encase/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "3d/facet_lines.hpp"
#include "3d/mesh_cover.hpp"
#include "3d/patch_mesh.hpp"
#include "3d/space_vectors.hpp"
#include "3d/triangles_apart.hpp"
#include "encase/surface_topology.hpp"

namespace encase {

namespace {

/// How often patches are refined for what is around them.
constexpr int kMaxRounds = 64;

class Mesher {
 public:
  Mesher(const SurfaceEncasement& encasement, const SurfaceMeshOptions& options)
      : encasement_(encasement), options_(options), left_(options.max_triangles) {
    const double size = encasement.region_used.bounding_box().largest_width();
    goal_.tolerance = options.tolerance;
    goal_.angle = options.angle;
    goal_.least_length = 0x1p-30 * size;
    functions_.reserve(encasement.surfaces.size());
    for (const Surface& surface : encasement.surfaces) functions_.emplace_back(surface.function);
    bounds_.reserve(functions_.size());
    for (const auto& function : functions_) {
      bounds_.emplace_back(function, size);
      models_.emplace_back(bounds_.back(), kernel_);
      corners_.emplace_back(encasement, bounds_.back());
    }
    lines_ = std::make_unique<FacetLines>(encasement, functions_, options.tolerance, options.angle,
                                          &points_);
    collect_patches();
  }

  Result<std::vector<SurfaceMesh>> meshes() {
    for (int round = 0; round < kMaxRounds; ++round) {
      apart_.assign(functions_.size(), false);  // until all patches are compared again
      for (std::size_t k = 0; k < patches_.size(); ++k) {
        if (!patches_[k].stale) continue;
        if (cancelled(static_cast<double>(k) / static_cast<double>(patches_.size())))
          return Error{Error::Code::Undecided, "the meshing was cancelled"};
        make(&patches_[k]);
      }
      if (!divide_lines() && !find_crossing_triangles()) break;
    }
    std::vector<SurfaceMesh> result;
    for (int s = 0; s < static_cast<int>(encasement_.surfaces.size()); ++s)
      result.push_back(assemble(s));
    return result;
  }

 private:
  struct Patch {
    int cell = -1;
    const SurfacePatch* patch = nullptr;
    const GraphCertificate* graph = nullptr;
    bool stale = true;
    bool failed = false;
    bool fresh = false;  ///< has new triangles, not yet compared with those of others
    std::unique_ptr<PatchMesh> mesh;
    /// Points to be put between two points of its boundary, which are given ascending.
    std::map<std::pair<int, int>, int> middles;
  };

  Box<3> box_of(const std::array<int, 3>& corners) const {
    const auto& [a, b, c] = corners;
    return hull(hull(Box<3>{points_[a], points_[a]}, {points_[b], points_[b]}),
                {points_[c], points_[c]});
  }

  bool cancelled(double done) const {
    return options_.progress && !options_.progress("meshing", done);
  }

  void collect_patches() {
    users_.resize(static_cast<std::size_t>(lines_->count()));
    for (std::size_t c = 0; c < encasement_.cells.size(); ++c) {
      const SpaceCell& cell = encasement_.cells[c];
      for (const SurfacePatch& patch : cell.patches) {
        Patch entry;
        entry.cell = static_cast<int>(c);
        entry.patch = &patch;
        for (const int g : cell.graphs)
          if (encasement_.graph_certificates[g].surface == patch.surface)
            entry.graph = &encasement_.graph_certificates[g];
        for (const FacetEdge& edge : patch.loop) {
          const int line = lines_->line(edge);
          if (line >= 0)
            users_[line].push_back(static_cast<int>(patches_.size()));
          else
            entry.failed = true;
        }
        entry.failed = entry.failed || !entry.graph;
        entry.stale = !entry.failed;
        patches_.push_back(std::move(entry));
      }
    }
  }

  void make(Patch* patch) {
    patch->stale = false;
    patch->fresh = true;
    const int before = patch->mesh ? static_cast<int>(patch->mesh->triangles().size()) : 0;
    if (!patch->mesh || !patch->mesh->divide_boundary(patch->middles)) begin(patch);
    patch->middles.clear();
    if (patch->failed) return;
    patch->mesh->refine(std::max(left_ + before, 0));
    left_ += before - static_cast<int>(patch->mesh->triangles().size());
  }

  /// Anew, between the points on its boundary.
  void begin(Patch* patch) {
    std::vector<int> boundary;
    std::vector<Point<3>> corners, normals;
    for (const FacetEdge& edge : patch->patch->loop)
      for (const int p : lines_->along(edge)) {
        boundary.push_back(p);
        corners.push_back(points_[p]);
        normals.push_back(unit(functions_[patch->patch->surface].gradient(points_[p])));
      }
    const FieldChart chart =
        boundary.empty() ? FieldChart(*patch->graph) : FieldChart(*patch->graph, corners, normals);
    const int s = patch->patch->surface;
    patch->mesh = std::make_unique<PatchMesh>(chart, *patch->graph, models_[s], corners_[s],
                                              *lines_, goal_, &points_);
    patch->failed = !(boundary.empty() ? patch->mesh->surround(encasement_.cells[patch->cell].box)
                                       : patch->mesh->fill(boundary));
  }

  /// Where a patch has edges of its boundary that are too long; false if none has.
  bool divide_lines() {
    std::set<std::pair<int, int>> segments;
    for (const Patch& patch : patches_) {
      if (patch.failed) continue;
      for (const auto& [a, b] : patch.mesh->too_long())
        if (length(points_[a] - points_[b]) >= goal_.least_length)
          segments.insert({std::min(a, b), std::max(a, b)});
    }
    bool divided = false;
    for (const auto& segment : segments) {
      const auto [line, middle] = lines_->divide(segment);
      if (line < 0) continue;
      divided = true;
      for (const int patch : users_[line]) {
        patches_[patch].stale = !patches_[patch].failed;
        patches_[patch].middles.emplace(segment, middle);
      }
    }
    return divided && left_ > 0;
  }

  /// Where patches that share no arc cross each other all the same; false if none do.
  bool find_crossing_triangles() {
    bool found = false;
    apart_.assign(functions_.size(), true);
    for (std::size_t begin = 0, end; begin < patches_.size(); begin = end) {
      for (end = begin; end < patches_.size() && patches_[end].cell == patches_[begin].cell;) ++end;
      const SpaceCell& cell = encasement_.cells[patches_[begin].cell];
      const auto meet = [&](const Patch& a, const Patch& b) {
        return std::any_of(cell.arcs.begin(), cell.arcs.end(), [&](const SurfaceArc& arc) {
          const auto lies_on = [&](const Patch& patch) {
            return &cell.patches[arc.patches[0]] == patch.patch ||
                   &cell.patches[arc.patches[1]] == patch.patch;
          };
          return lies_on(a) && lies_on(b);
        });
      };
      for (std::size_t a = begin; a < end; ++a)
        for (std::size_t b = a + 1; b < end; ++b)
          if (!meet(patches_[a], patches_[b]))
            found = keep_apart(&patches_[a], &patches_[b]) || found;
    }
    for (Patch& patch : patches_) patch.fresh = false;
    return found && left_ > 0;
  }

  /// Whether triangles of two patches are to be divided as they are not proved to be apart.
  bool keep_apart(Patch* a, Patch* b) {
    if (a->failed || b->failed || !(a->fresh || b->fresh)) return false;
    const double margin = corners_.front().margin();
    const Box<3> around = inflated(a->mesh->box(), margin),
                 other = inflated(b->mesh->box(), margin);
    if (!around.meets(other)) return false;
    std::vector<std::array<int, 3>> triangles;
    std::vector<std::pair<Patch*, int>> owners;
    int first = 0;
    for (Patch* patch : {a, b}) {
      const std::vector<PatchMesh::Triangle>& all = patch->mesh->triangles();
      for (std::size_t k = 0; k < all.size(); ++k) {
        std::array<int, 3> corners;
        for (int i = 0; i < 3; ++i) corners[i] = patch->mesh->point(all[k].corners[i]);
        const Box<3> box = box_of(corners);
        if (!box.meets(around) || !box.meets(other)) continue;
        triangles.push_back(corners);
        owners.emplace_back(patch, static_cast<int>(k));
      }
      if (patch == a) first = static_cast<int>(triangles.size());
    }
    const TrianglePairs near = near_triangles(points_, triangles, margin, first);
    for (const auto& [i, j] : near)
      for (const int t : {i, j}) {
        owners[t].first->mesh->find_too_large(owners[t].second);
        owners[t].first->stale = true;
        apart_[owners[t].first->patch->surface] = false;
      }
    return !near.empty();
  }

  SurfaceMesh assemble(int surface) {
    SurfaceMesh mesh;
    mesh.surface = surface;
    mesh.tolerance = options_.tolerance;
    mesh.complete = surface_topology(encasement_)[surface].complete;
    std::vector<int> number(points_.size(), -1);
    std::vector<std::pair<int, int>> edges;
    std::vector<Corner> corners;
    double way = 0;
    for (const Patch& patch : patches_) {
      if (patch.patch->surface != surface) continue;
      mesh.complete = mesh.complete && !patch.failed;
      if (patch.failed) continue;
      for (const PatchMesh::Triangle& t : patch.mesh->triangles()) {
        std::array<int, 3> triangle;
        for (int i = 0; i < 3; ++i) {
          const int p = patch.mesh->point(t.corners[i]);
          if (number[p] < 0) {
            number[p] = static_cast<int>(mesh.points.size());
            mesh.points.push_back(points_[p]);
            mesh.normals.push_back(unit(functions_[surface].gradient(points_[p])));
            corners.push_back(patch.mesh->corner(t.corners[i]));
          }
          triangle[i] = number[p];
        }
        for (int i = 0; i < 3; ++i)
          edges.emplace_back(std::minmax(triangle[i], triangle[(i + 1) % 3]));
        mesh.triangles.push_back(triangle);
        mesh.cells.push_back(patch.cell);
        mesh.distances.push_back(t.bounds.distance);
        mesh.angles.push_back(t.bounds.angle);
        mesh.distance = std::max(mesh.distance, t.bounds.distance);
        mesh.angle = std::max(mesh.angle, t.bounds.angle);
        way = std::max(way, t.bounds.way);
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    mesh.euler = static_cast<int>(mesh.points.size()) - static_cast<int>(edges.size()) +
                 static_cast<int>(mesh.triangles.size());
    mesh.within_tolerance = mesh.distance <= options_.tolerance && mesh.angle <= options_.angle;
    mesh.apart = mesh.complete && apart_[surface];
    if (covers_surface(mesh, encasement_, corners_[surface], corners, way)) {
      mesh.distance_to_mesh = way;
      mesh.isotopic = is_embedded(mesh, corners_[surface]);
    }
    return mesh;
  }

  const SurfaceEncasement& encasement_;
  const SurfaceMeshOptions& options_;
  MeshGoal goal_;
  int left_;  ///< triangles that may still be made
  Kernel kernel_;
  std::vector<FilteredFunction<3>> functions_;
  std::vector<SurfaceBounds> bounds_;
  std::deque<SurfaceModels> models_;
  std::vector<MeshCorners> corners_;
  std::vector<Point<3>> points_;  ///< of all patches and lines
  std::unique_ptr<FacetLines> lines_;
  std::vector<Patch> patches_;
  std::vector<std::vector<int>> users_;  ///< the patches along every line
  std::vector<bool> apart_;              ///< of every surface
};

}  // namespace

Result<std::vector<SurfaceMesh>> mesh(const SurfaceEncasement& encasement,
                                      const SurfaceMeshOptions& options) {
  if (!(options.tolerance > 0) || !(options.angle > 0))
    return Error{Error::Code::BadInput, "a mesh's tolerance and angle must be positive numbers"};
  return Mesher(encasement, options).meshes();
}

}  // namespace encase
