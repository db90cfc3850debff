// SPDX-License-Identifier: MIT
#pragma once

#include "common/bernstein.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// The net of a polynomial on a box (in the coordinates of `centered`), restricted to the two parts
/// into which the box is cut at a coordinate, each in the coordinates of its own box.
void cut(const Bernstein<3>& net, const Box<3>& box, int axis, double at, Bernstein<3>* lower,
         Bernstein<3>* upper);

/// Where the cut is in the coordinate of [lo, hi], from 0 to 1, and how far from there the ends of
/// the charts may be.
struct CutPlace {
  double t;
  double deviation;
};
CutPlace cut_place(double lo, double hi, double at);

}  // namespace encase
