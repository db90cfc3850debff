// SPDX-License-Identifier: MIT
#include "3d/mesh_cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "3d/space_vectors.hpp"
#include "3d/triangle_bounds.hpp"
#include "common/union_find.hpp"
#include "encase/surface_topology.hpp"

namespace encase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double determinant(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  return dot(cross(a, b), c);
}

/// A side of the region with a unit normal that points outward.
struct Side {
  Point<3> normal;
  double offset;
  double beyond(const Point<3>& p) const { return dot(normal, p) + offset; }
};

class Cover {
 public:
  Cover(const SurfaceMesh& mesh, const SurfaceEncasement& encasement, SurfaceModels& models)
      : mesh_(mesh), encasement_(encasement), models_(models) {
    const double size = encasement.region_used.bounding_box().largest_width();
    near_ = 0x1p-44 * size;
    moved_ = 0x1p-40 * size;
    Point<3> middle{};
    for (const Point<3>& p : mesh.points)
      middle = middle + 1.0 / static_cast<double>(mesh.points.size()) * p;
    for (std::size_t k = 0; k < encasement.region_used.sides.size(); ++k) {
      const Plane& plane = encasement.planes[k];
      // The middle of the mesh's points is within the region.
      const double sum = dot(plane.normal, middle) + plane.offset;
      const double scale = (sum > 0 ? -1 : 1) / length(plane.normal);
      sides_.push_back({scale * plane.normal, scale * plane.offset});
    }
  }

  double distance() {
    if (!mesh_.complete || !std::isfinite(mesh_.distance) || !find_boundary() || !find_directions())
      return kInfinity;
    std::vector<double> sizes;
    for (const Point<3>& point : mesh_.points) sizes.push_back(size_at(models_.surface(), point));
    double largest = 0;
    for (const auto& [p, q, r] : mesh_.triangles) {
      const Corners corners{{mesh_.points[p], mesh_.points[q], mesh_.points[r]},
                            {sizes[p], sizes[q], sizes[r]}};
      const std::array<Point<3>, 3> w{directions_[p], directions_[q], directions_[r]};
      const double way = way_from(corners, w);
      if (!unfolded(corners.points, w, way)) return kInfinity;
      largest = std::max(largest, way);
    }
    return turns_once() && meets_all_components(largest) ? largest : kInfinity;
  }

 private:
  /// The sides of the region in which the points on the boundary lie.
  bool find_boundary() {
    std::set<std::pair<int, int>> half_edges;
    for (const auto& t : mesh_.triangles)
      for (int i = 0; i < 3; ++i) half_edges.emplace(t[i], t[(i + 1) % 3]);
    on_sides_.resize(mesh_.points.size());
    std::vector<int> leaving(mesh_.points.size());
    for (const auto& [a, b] : half_edges) {
      if (half_edges.contains({b, a})) continue;
      bool found = false;
      for (int k = 0; k < static_cast<int>(sides_.size()); ++k) {
        if (std::fabs(sides_[k].beyond(mesh_.points[a])) > near_ ||
            std::fabs(sides_[k].beyond(mesh_.points[b])) > near_)
          continue;
        found = true;
        on_sides_[a].insert(k);
        on_sides_[b].insert(k);
      }
      if (!found || ++leaving[a] > 1) return false;
    }
    for (const Point<3>& point : mesh_.points)
      for (const Side& side : sides_)
        if (side.beyond(point) > near_) return false;
    return true;
  }

  /// At every point the gradient's direction, within the sides of the region that it lies in.
  bool find_directions() {
    for (std::size_t k = 0; k < mesh_.points.size(); ++k) {
      Point<3> w = models_.surface().function().gradient(mesh_.points[k]);
      const std::vector<int> sides(on_sides_[k].begin(), on_sides_[k].end());
      if (sides.size() > 2) return false;
      if (sides.size() == 1) {
        const Point<3>& n = sides_[sides[0]].normal;
        w = w - dot(w, n) * n;
      } else if (sides.size() == 2) {
        const Point<3> line = cross(sides_[sides[0]].normal, sides_[sides[1]].normal);
        if (length(line) < 0.125) return false;
        w = dot(w, unit(line)) * unit(line);
      }
      directions_.push_back(unit(w));
    }
    return true;
  }

  /// How far from a triangle the surface is along directions at its corners.
  double way_from(const Corners& corners, const std::array<Point<3>, 3>& w) {
    // Directions within steep sides lead to it on long ways.
    double way = kInfinity;
    for (double times = 1.1; times < 30 && !std::isfinite(way); times *= 1.5)
      way = bound_along(models_, corners, w, times * mesh_.distance + 8 * moved_, moved_);
    return way;
  }

  /// Whether (x, s) -> x + s W(x) has a positive Jacobian on the triangle, for |s| <= way, also if
  /// the corners are moved a little.
  bool unfolded(const std::array<Point<3>, 3>& p, const std::array<Point<3>, 3>& w,
                double way) const {
    const Point<3> e1 = p[1] - p[0], e2 = p[2] - p[0], w1 = w[1] - w[0], w2 = w[2] - w[0];
    const double long1 = length(e1) + way * length(w1), long2 = length(e2) + way * length(w2);
    const double slack = 0x1p-40 * long1 * long2 + 8 * moved_ * (long1 + long2 + moved_);
    return std::all_of(w.begin(), w.end(), [&](const Point<3>& at) {
      return determinant(e1, e2, at) -
                 way * std::fabs(determinant(w1, e2, at) + determinant(e1, w2, at)) -
                 way * way * std::fabs(determinant(w1, w2, at)) >
             slack;
    });
  }

  /// Whether the triangles around every point go around its direction once.
  bool turns_once() const {
    std::vector<int> turns(mesh_.points.size());
    for (const auto& t : mesh_.triangles)
      for (int i = 0; i < 3; ++i) {
        const Point<3>& w = directions_[t[i]];
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
    const double apart = 1.01 * distance + moved_;
    std::vector<int> deep;
    for (int k = 0; k < static_cast<int>(mesh_.points.size()); ++k)
      if (joined.find(k) == component &&
          std::all_of(sides_.begin(), sides_.end(),
                      [&](const Side& side) { return side.beyond(mesh_.points[k]) < -apart; }))
        deep.push_back(k);
    const std::size_t step = deep.size() / kMostTried + 1;
    for (std::size_t k = 0; k < deep.size(); k += step)
      if (far_from_others(deep[k], joined, 2 * apart)) return true;
    return false;
  }

  bool far_from_others(int point, UnionFind& joined, double distance) const {
    const Point<3>& p = mesh_.points[point];
    const int own = joined.find(point);
    return std::all_of(
        mesh_.triangles.begin(), mesh_.triangles.end(), [&](const std::array<int, 3>& t) {
          if (joined.find(t[0]) == own) return true;
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
  SurfaceModels& models_;
  double near_ = 0;   ///< points nearer than this to a side count as lying in it
  double moved_ = 0;  ///< from such points to where they would lie exactly, at most
  std::vector<Side> sides_;
  std::vector<std::set<int>> on_sides_;  ///< of every point
  std::vector<Point<3>> directions_;     ///< of every point
};

}  // namespace

double cover_distance(const SurfaceMesh& mesh, const SurfaceEncasement& encasement,
                      SurfaceModels& models) {
  return Cover(mesh, encasement, models).distance();
}

}  // namespace encase
