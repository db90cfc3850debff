// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "3d/arc_tracer.hpp"
#include "3d/known_points.hpp"
#include "3d/space_vectors.hpp"
#include "encase/intersection_curves.hpp"

namespace encase {

namespace {

/// What is traced of one encasement.
class Tracer {
 public:
  Tracer(const SurfaceEncasement& encasement, const IntersectionTraceOptions& options)
      : encasement_(encasement),
        options_(options),
        size_(encasement.region_used.bounding_box().largest_width()),
        known_(encasement),
        left_(options.max_points) {
    functions_.reserve(encasement.surfaces.size());
    for (const Surface& surface : encasement.surfaces) functions_.emplace_back(surface.function);
    for (const auto& function : functions_) bounds_.emplace_back(function, size_);
  }

  TracedIntersection trace(IntersectionCurve curve) {
    TracedIntersection traced;
    ArcTracer tracer(bounds_[curve.surfaces[0]], bounds_[curve.surfaces[1]], size_, kernel_);
    if (sense_of(curve.arcs.front(), tracer) == Sign::Negative) turn(&curve);
    for (const ArcUse& use : curve.arcs) append(use, tracer, &traced);
    // The polyline's last point stands for the same point of the curve as its first.
    for (std::size_t k = 0; k < traced.points.size(); ++k) {
      traced.tangents.push_back(tracer.tangent(traced.points[k]));
      std::array<Point<3>, 2> normals;
      for (int i = 0; i < 2; ++i)
        normals[i] = unit(functions_[curve.surfaces[i]].gradient(traced.points[k]));
      traced.normals.push_back(normals);
    }
    traced.curve = std::move(curve);
    return traced;
  }

 private:
  const SurfaceArc& arc_of(const ArcUse& use) const {
    return encasement_.cells[use.cell].arcs[use.arc];
  }

  /// Whether the arc, in the direction of its use, runs along grad f x grad g.
  Sign sense_of(const ArcUse& use, ArcTracer& tracer) const {
    const SurfaceArc& arc = arc_of(use);
    const Point<3>& w = encasement_.pair_certificates[arc.certificate].direction;
    const Sign sign = tracer.sense(known_.facet_point(arc.ends[0]).box, w);
    return use.forward ? sign : -sign;
  }

  static void turn(IntersectionCurve* curve) {
    std::reverse(curve->arcs.begin(), curve->arcs.end());
    for (ArcUse& use : curve->arcs) use.forward = !use.forward;
    std::reverse(curve->facet_points.begin(), curve->facet_points.end());
    std::swap(curve->cut_off[0], curve->cut_off[1]);
  }

  /// The arc from one known point to the next.
  void append(const ArcUse& use, ArcTracer& tracer, TracedIntersection* traced) {
    const SurfaceArc& arc = arc_of(use);
    std::vector<std::pair<SpacePoint, int>> stops{{known_.facet_point(arc.ends[0]), -1}};
    for (const int t : arc.triple_points) stops.emplace_back(known_.triple_point(t), t);
    stops.emplace_back(known_.facet_point(arc.ends[1]), -1);
    if (!use.forward) std::reverse(stops.begin(), stops.end());
    if (traced->points.empty()) push(stops[0].first, -1, traced);
    const Sign sense = sense_of(use, tracer);
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
      const SpacePath path =
          tracer.trace(stops[k].first, stops[k + 1].first, static_cast<int>(sense),
                       options_.tolerance, std::max(left_, 0));
      left_ -= static_cast<int>(path.points.size()) - 1;
      for (std::size_t i = 1; i < path.points.size(); ++i) {
        const bool last = i + 1 == path.points.size();
        push(path.points[i], last ? stops[k + 1].second : -1, traced);
        traced->distances.push_back(path.distances[i - 1]);
        traced->cells.push_back(use.cell);
      }
    }
  }

  static void push(const SpacePoint& p, int triple_point, TracedIntersection* traced) {
    traced->points.push_back(p.point);
    traced->boxes.push_back(p.box);
    traced->triple_points.push_back(triple_point);
  }

  const SurfaceEncasement& encasement_;
  const IntersectionTraceOptions& options_;
  double size_;
  KnownPoints known_;
  Kernel kernel_;
  std::vector<FilteredFunction<3>> functions_;
  std::vector<SurfaceBounds> bounds_;
  int left_;  ///< points that may still be made
};

}  // namespace

Result<IntersectionTracing> trace(const SurfaceEncasement& encasement,
                                  const IntersectionTraceOptions& options) {
  if (!(options.tolerance > 0))
    return Error{Error::Code::BadInput, "the tolerance must be a positive number"};
  Tracer tracer(encasement, options);
  const std::vector<IntersectionCurve> curves = intersection_curves(encasement);
  IntersectionTracing tracing;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (options.progress &&
        !options.progress("tracing intersection curves",
                          static_cast<double>(k) / static_cast<double>(curves.size())))
      return Error{Error::Code::Undecided, "the tracing was cancelled"};
    tracing.curves.push_back(tracer.trace(curves[k]));
    for (const double distance : tracing.curves.back().distances)
      tracing.distance = std::max(tracing.distance, distance);
  }
  tracing.within_tolerance = tracing.distance <= options.tolerance;
  return tracing;
}

Result<SurfaceIntersection> intersect(const Function<3>& f, const Function<3>& g,
                                      const Polyhedron& region, double tolerance,
                                      const SurfaceOptions& options) {
  auto encasement = encase({{"f", f}, {"g", g}}, region, options);
  if (!encasement) return encasement.error();
  SurfaceIntersection result;
  result.encasement = std::move(encasement).value();
  IntersectionTraceOptions tracing;
  tracing.tolerance = tolerance;
  tracing.progress = options.progress;
  auto traced = trace(result.encasement, tracing);
  if (!traced) return traced.error();
  result.curves = std::move(traced.value().curves);
  result.within_tolerance = traced.value().within_tolerance;
  return result;
}

}  // namespace encase
