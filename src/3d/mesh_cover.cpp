// SPDX-License-Identifier: MIT
#include "3d/mesh_cover.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "3d/space_vectors.hpp"
#include "3d/triangles_apart.hpp"
#include "common/union_find.hpp"
#include "encase/surface_topology.hpp"

namespace encase {

namespace {

double determinant(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  return dot(cross(a, b), c);
}

using HalfEdge = std::pair<int, int>;

/// In order, each once.
std::vector<HalfEdge> half_edges_of(const SurfaceMesh& mesh) {
  std::vector<HalfEdge> all;
  all.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) all.emplace_back(t[i], t[(i + 1) % 3]);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool has_twin(const std::vector<HalfEdge>& all, const HalfEdge& edge) {
  return std::binary_search(all.begin(), all.end(), HalfEdge{edge.second, edge.first});
}

class Cover {
 public:
  Cover(const SurfaceMesh& mesh, const SurfaceEncasement& encasement, const MeshCorners& maker,
        const std::vector<Corner>& corners)
      : mesh_(mesh), encasement_(encasement), maker_(maker), corners_(corners) {}

  bool is_complete(double way) const {
    return within_region() && ends_in_sides() && turns_once() && meets_all_components(way);
  }

 private:
  bool within_region() const {
    return std::all_of(mesh_.points.begin(), mesh_.points.end(),
                       [&](const Point<3>& p) { return is_deep(p, -maker_.near()); });
  }

  /// Whether a point is farther than a distance from all sides of the region.
  bool is_deep(const Point<3>& point, double distance) const {
    for (int k = 0; k < maker_.side_count(); ++k)
      if (maker_.beyond(k, point) >= -distance) return false;
    return true;
  }

  /// Whether the boundary consists of closed lines within the sides that its points are said to lie
  /// in, and nothing else lies in them.
  bool ends_in_sides() const {
    const std::vector<HalfEdge> half_edges = half_edges_of(mesh_);
    std::vector<int> leaving(mesh_.points.size());
    for (const auto& [a, b] : half_edges) {
      const int side = common_side(corners_[a].sides, corners_[b].sides);
      const bool on_boundary = !has_twin(half_edges, {a, b});
      if (on_boundary != (side >= 0)) return false;
      if (!on_boundary) continue;
      if (++leaving[a] > 1 || !is_in(side, mesh_.points[a]) || !is_in(side, mesh_.points[b]))
        return false;
    }
    for (std::size_t k = 0; k < corners_.size(); ++k)
      if ((corners_[k].sides[0] >= 0) != (leaving[k] == 1)) return false;
    return true;
  }

  bool is_in(int side, const Point<3>& point) const {
    return std::fabs(maker_.beyond(side, point)) <= maker_.near();
  }

  /// Whether the triangles around every point go around its direction once.
  bool turns_once() const {
    std::vector<int> turns(mesh_.points.size());
    for (const auto& t : mesh_.triangles)
      for (int i = 0; i < 3; ++i) {
        const Point<3>& w = corners_[t[i]].direction;
        const Point<3> zero = across(w)[0];
        const auto beyond = [&](int p) {
          return determinant(zero, mesh_.points[p] - mesh_.points[t[i]], w) >= 0;
        };
        turns[t[i]] += !beyond(t[(i + 1) % 3]) && beyond(t[(i + 2) % 3]);
      }
    for (std::size_t k = 0; k < turns.size(); ++k)
      if (turns[k] > 1) return false;
    return true;
  }

  /// Whether the surface has as many components as the mesh, each with a point so deep in the
  /// region and so far from the others that these lead to different ones.
  bool meets_all_components(double distance) const {
    UnionFind joined(mesh_.points.size());
    for (const auto& [p, q, r] : mesh_.triangles) {
      joined.join(p, q);
      joined.join(q, r);
    }
    std::set<int> components;
    for (int k = 0; k < static_cast<int>(mesh_.points.size()); ++k)
      components.insert(joined.find(k));
    if (static_cast<int>(components.size()) !=
        surface_topology(encasement_)[mesh_.surface].components)
      return false;
    return std::all_of(components.begin(), components.end(),
                       [&](int component) { return has_witness(component, joined, distance); });
  }

  bool has_witness(int component, UnionFind& joined, double distance) const {
    constexpr int kMostTried = 64;
    const double apart = 1.01 * distance + maker_.moved();
    std::vector<Point<3>> deep;  // in the middles of triangles
    for (const auto& [p, q, r] : mesh_.triangles) {
      if (joined.find(p) != component) continue;
      const Point<3> middle = (1.0 / 3) * (mesh_.points[p] + mesh_.points[q] + mesh_.points[r]);
      if (is_deep(middle, apart)) deep.push_back(middle);
    }
    const std::size_t step = deep.size() / kMostTried + 1;
    for (std::size_t k = 0; k < deep.size(); k += step)
      if (far_from_others(deep[k], component, joined, 2 * apart)) return true;
    return false;
  }

  bool far_from_others(const Point<3>& p, int component, UnionFind& joined, double distance) const {
    return std::all_of(
        mesh_.triangles.begin(), mesh_.triangles.end(), [&](const std::array<int, 3>& t) {
          if (joined.find(t[0]) == component) return true;
          Point<3> gap{};
          for (int i = 0; i < 3; ++i) {
            const auto [lo, hi] =
                std::minmax({mesh_.points[t[0]][i], mesh_.points[t[1]][i], mesh_.points[t[2]][i]});
            gap[i] = std::max({0.0, lo - p[i], p[i] - hi});
          }
          return length(gap) > distance;
        });
  }

  const SurfaceMesh& mesh_;
  const SurfaceEncasement& encasement_;
  const MeshCorners& maker_;
  const std::vector<Corner>& corners_;
};

}  // namespace

std::optional<std::vector<PointSides>> sides_of_points(const SurfaceMesh& mesh,
                                                       const MeshCorners& corners) {
  std::vector<std::set<int>> found(mesh.points.size());
  const std::vector<HalfEdge> half_edges = half_edges_of(mesh);
  for (const auto& [a, b] : half_edges) {
    if (has_twin(half_edges, {a, b})) continue;
    bool any = false;
    for (int k = 0; k < corners.side_count(); ++k) {
      if (std::fabs(corners.beyond(k, mesh.points[a])) > corners.near() ||
          std::fabs(corners.beyond(k, mesh.points[b])) > corners.near())
        continue;
      any = true;
      found[a].insert(k);
      found[b].insert(k);
    }
    if (!any) return std::nullopt;
  }
  std::vector<PointSides> sides(mesh.points.size(), kWithin);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k].size() > 2) return std::nullopt;
    std::copy(found[k].begin(), found[k].end(), sides[k].begin());
  }
  return sides;
}

bool covers_surface(const SurfaceMesh& mesh, const SurfaceEncasement& encasement,
                    const MeshCorners& maker, const std::vector<Corner>& corners, double way) {
  return mesh.complete && std::isfinite(way) &&
         Cover(mesh, encasement, maker, corners).is_complete(way);
}

bool is_embedded(const SurfaceMesh& mesh, const MeshCorners& maker) {
  return near_triangles(mesh.points, mesh.triangles, maker.margin()).empty();
}

}  // namespace encase
