// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "3d/certificate_tests.hpp"

namespace encase {

/// Searches for a proof that a surface is a graph in a box, the chart of which `columns` belong to
/// (field_columns). Parallel lines are preferred to lines through a point. `surface` of the result
/// is left open.
std::optional<GraphCertificate> find_graph(const NetColumns<5>& columns, const Box<3>& box);

}  // namespace encase
