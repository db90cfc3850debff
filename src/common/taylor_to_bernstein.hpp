// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/bernstein.hpp"

namespace encase {

/// Turns Taylor coefficients in [-1,1]^K (dense, degree n in every variable, of total degree n)
/// into a Bernstein net of degree `net_degree` >= n in every variable. `error` bounds the sum of
/// the errors of all Taylor coefficients, or what the polynomial lacks.
template <int K>
void taylor_to_bernstein(const std::vector<double>& taylor, int n, double error, int net_degree,
                         Bernstein<K>* net);

}  // namespace encase
