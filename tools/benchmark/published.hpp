// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace encase::benchmark {

/// Cells of the encasements that the program of the thesis's authors (ACP) makes of random pairs of
/// the same kind: the least and the greatest of three pairs a degree. Counted by running it,
/// built with its assertions, without which it errs.
struct PublishedCells {
  int degree, least, most;
};

inline constexpr std::array<PublishedCells, 12> kAuthorsCells{{{2, 7, 10},
                                                               {4, 38, 43},
                                                               {5, 61, 76},
                                                               {6, 90, 130},
                                                               {8, 223, 269},
                                                               {10, 303, 358},
                                                               {12, 444, 518},
                                                               {14, 505, 621},
                                                               {15, 621, 653},
                                                               {16, 685, 772},
                                                               {18, 978, 1069},
                                                               {20, 1204, 1229}}};

}  // namespace encase::benchmark
