// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "3d/arc_tracer.hpp"
#include "encase/slice.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// The smallest box that holds what a chart makes of a rectangle of its plane, rounded outward.
Box<3> lift(const PlaneChart& chart, const Box<2>& box);

/// The points that an encasement of surfaces knows, in boxes: for each the point is in the box, and
/// the only one of the surfaces and planes it belongs to in a neighbourhood that contains the box.
class KnownPoints {
 public:
  /// The encasement is to outlive this.
  explicit KnownPoints(const SurfaceEncasement& encasement);

  /// Where two surfaces meet a facet. The box is that of the facet's crossing, made small.
  SpacePoint facet_point(int k) const;
  /// The box that proves the point; where its rounding is proved, one of its size.
  SpacePoint triple_point(int k) const;

 private:
  struct Place {
    int facet = -1, vertex = -1;
  };
  const SurfaceEncasement& encasement_;
  std::vector<Place> places_;  ///< of every facet point
};

}  // namespace encase
