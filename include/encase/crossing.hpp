// SPDX-License-Identifier: MIT
#pragma once

#include "encase/encasement.hpp"

namespace encase {

/// A box with exact dyadic bounds.
struct RationalBox {
  RationalPoint<2> lo;
  RationalPoint<2> hi;
};

/// Encloses crossing `id` in a box of width at most 2^-bits in both coordinates that holds it and
/// no other common point of the pair. Undecided only if `bits` is beyond what memory allows: 10^8,
/// where a curve is no polynomial 2^20.
Result<RationalBox> refine(const Encasement& encasement, int id, int bits);

/// Compares coordinate `axis` of two crossings exactly: Negative if that of `first` is less.
/// Equality is proved by the roots of resultants; where a curve is no polynomial it cannot be, and
/// the answer is Undecided once more than 2^11 bits agree.
Result<Sign> compare_coordinate(const Encasement& encasement, int axis, int first, int second);

}  // namespace encase
