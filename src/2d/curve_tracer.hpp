// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "2d/curve_follower.hpp"
#include "common/filtered_polynomial.hpp"
#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// Traces branches of one curve of an encasement. Makes what it needs when it is first asked.
class CurveTracer {
 public:
  /// Paths are within `tolerance` of the curve, where that can be proved. The encasement is to
  /// outlive the tracer.
  CurveTracer(const Encasement& encasement, int curve, double tolerance);

  /// A branch of a certified cell from its first line crossing to its second, and an edge along its
  /// strands. At most about `most` pieces.
  CurvePath branch(int cell, const Branch& branch, int most);
  CurvePath edge(const std::vector<Arrangement::Strand>& strands, int most);

  /// Where a line crossing is, the same point whoever asks.
  const CurvePoint& at_line_crossing(int line_crossing);
  /// Where a crossing is.
  CurvePoint at_crossing(int crossing) const;

  /// Another path in place of a piece, within `goal`.
  CurvePath finer(const CurvePoint& from, const CurvePoint& to, int direction, double goal,
                  int most);

 private:
  CurvePath into_cell(int cell, int from, const CurvePoint& to, int most);
  CurvePath strand(const Arrangement::Strand& strand, int most);
  CurvePoint at_end(const Arrangement::Strand& strand, int line_crossing);
  int direction_into(int cell, int line_crossing);

  const Encasement& encasement_;
  double tolerance_;
  double size_ = 0;
  Kernel kernel_;
  FilteredPolynomial<2> polynomial_;
  std::unique_ptr<TiledPolynomial> tiles_;
  std::unique_ptr<CurveFollower> follower_;
  std::map<int, CurvePoint> ends_;
};

/// The tracers of an encasement's curves.
std::vector<std::unique_ptr<CurveTracer>> tracers_of(const Encasement& encasement,
                                                     double tolerance);

}  // namespace encase
