// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "2d/curve_follower.hpp"
#include "common/filtered_function.hpp"
#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// Traces one curve of an encasement, where its cells are certified. Makes what it needs when it is
/// first asked.
class CurveTracer {
 public:
  /// Paths are within `tolerance` of the curve, where that can be proved. The encasement is to
  /// outlive the tracer.
  CurveTracer(const Encasement& encasement, int curve, double tolerance);

  /// An edge, or another part of the curve, along strands that go on in each other. At most about
  /// `most` pieces.
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
  FilteredFunction<2> polynomial_;
  std::unique_ptr<TiledFunction> tiles_;
  std::unique_ptr<CurveFollower> follower_;
  std::map<int, CurvePoint> ends_;
};

}  // namespace encase
