// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/function.hpp"
#include "encase/polyhedron.hpp"
#include "encase/result.hpp"
#include "encase/verify.hpp"

namespace encase {

/// What the user wrote.
using NamedSurface = NamedFunction<3>;

/// Two of the coordinates as coordinates (u, v) of a plane: those across which the plane is least
/// steep, in the order in which (u, v) turns counter-clockwise seen from where the normal points.
class PlaneChart {
 public:
  /// The plane a x + b y + c z + d = 0; its normal must not be zero.
  explicit PlaneChart(const std::array<Rational, 4>& plane);

  const std::array<Rational, 4>& plane() const { return plane_; }
  /// Which coordinates u and v are (0: x, 1: y, 2: z).
  const std::array<int, 2>& axes() const { return axes_; }

  /// The point of the plane with coordinates (u, v): exactly, and rounded.
  RationalPoint<3> lift(const RationalPoint<2>& point) const;
  Point<3> lift(const Point<2>& point) const;

  /// A function on the plane, as one of (u, v). Exact.
  Function<2> restrict(const Function<3>& function) const;
  /// The part of the polyhedron in the plane, in (u, v). BadInput if it has no area.
  Result<Region> restrict(const Polyhedron& polyhedron) const;

 private:
  std::array<Rational, 4> plane_;
  std::array<int, 2> axes_;
  int solved_;                      ///< the third coordinate
  std::array<Rational, 3> height_;  ///< it is height[0] u + height[1] v + height[2]
  std::array<double, 3> rounded_height_;
};

/// Where a slice comes from.
struct SliceSource {
  std::vector<NamedSurface> surfaces;
  Polyhedron region;
  PlaneChart chart;
  std::vector<int> surface_of;  ///< of every input curve of the encasement
  std::vector<int> containing;  ///< surfaces that contain the whole plane
};

/// What surfaces look like on a plane.
struct Slice {
  SliceSource source;
  /// Of the curves in which the surfaces meet the plane, in the chart's coordinates; they have the
  /// surfaces' names.
  Encasement encasement;
};

/// Encases the curves in which surfaces meet a plane, in the part of the polyhedron that lies in
/// it. A surface whose function is constant on the plane has no curve: it contains the plane or
/// does not meet it. BadInput if the polyhedron's part has no area, if a perturbation is asked for,
/// and as `encase`; Undecided if it cannot be told whether a constant is zero.
Result<Slice> slice(const std::vector<NamedSurface>& surfaces, const Polyhedron& region,
                    const std::array<Rational, 4>& plane, const EncaseOptions& options = {});

/// Proves again that the region and the curves of an encasement are what the source has on its
/// plane.
Verification verify_source(const SliceSource& source, const Encasement& encasement,
                           const VerifyOptions& options = {});

/// Proves that again, and the encasement itself.
Verification verify(const Slice& slice, const VerifyOptions& options = {});

/// `count` planes parallel to a x + b y + c z = 0 that cut the polyhedron into slabs of equal
/// thickness, in the direction of the normal. Requires a normal that is not zero.
std::vector<std::array<Rational, 4>> parallel_planes(const Polyhedron& region,
                                                     const std::array<Rational, 3>& normal,
                                                     int count);

}  // namespace encase
