// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/encasement.hpp"

namespace encase {

struct SvgOptions {
  int size = 720;                ///< length of the region's longer side in pixels
  bool legend = true;            ///< names of curves and of what else is drawn, above the picture
  bool axes = true;              ///< a frame with coordinates
  bool cells = true;             ///< cells tinted by what they hold
  bool critical_regions = true;  ///< translucent, in their curve's colour
  bool faces = false;   ///< in place of cells and critical regions, the faces of the arrangement,
                        ///< tinted by the curves' signs, its edges and its vertices; only where
                        ///< the answer is certified
  bool labels = false;  ///< the numbers of faces, edges and vertices of the arrangement (f1, e2,
                        ///< v3), those that find room; only where the answer is certified
};

/// A picture of an encasement: cells, curves (traced within a tenth of a pixel), crossings,
/// critical regions, and a ring around every place that resists. y points up; both axes have the
/// same scale unless the region is more than twelve times as long as it is wide. Deterministic.
std::string to_svg(const Encasement& encasement, const SvgOptions& options = {});

}  // namespace encase
