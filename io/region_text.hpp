// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <variant>

#include "encase/polyhedron.hpp"
#include "encase/region.hpp"
#include "source_text.hpp"

namespace encase {

/// `xmin xmax ymin ymax`, `polygon (x,y) (x,y) ...` or `plane`.
std::variant<Region, SyntaxError> parse_plane_region(std::string_view text);

/// `box x0 x1 y0 y1 z0 z1` or `halfspaces (a,b,c,d) ...`, each a x + b y + c z + d <= 0.
std::variant<Polyhedron, SyntaxError> parse_solid_region(std::string_view text);

/// `a b c d` of the plane a x + b y + c z + d = 0.
std::variant<HalfSpace, SyntaxError> parse_plane(std::string_view text);

}  // namespace encase
