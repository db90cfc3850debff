// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "3d/certificate_tests.hpp"

namespace encase {

/// Searches for a proof that two surfaces do not meet, from their nets, of equal degrees, on a box.
/// `surfaces` of the result is left open, here and below.
std::optional<PairCertificate> find_apart(const Bernstein<3>& f, const Bernstein<3>& g,
                                          const Box<3>& box, double scale_f, double scale_g);

/// Searches for a direction along which the curve of two surfaces grows everywhere in a box, with
/// arithmetic of `bits` or, where rounding errors hide the proof, more.
/// Cost: of two polynomials of degree d about d^6 products.
std::optional<PairCertificate> find_local(const FilteredFunction<3>& f,
                                          const FilteredFunction<3>& g, const Box<3>& box, int bits,
                                          Kernel& kernel);

}  // namespace encase
