// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/result.hpp"
#include "tables.hpp"

namespace encase::benchmark {

/// Figures 5.3 to 5.12 of the thesis, ours beside CGAL's, and the growth of the time per crossing:
/// each as figure-5.3.csv and figure-5.3.svg in the directory, which is made if it is missing.
/// CGAL takes part up to `cgal_degrees`, in 5.11 up to degree 8. Times are medians over the seeds;
/// the thesis has means. Io if a file cannot be written.
Status write_chapter5(RandomPairs& pairs, const Request& request, const std::string& directory);

}  // namespace encase::benchmark
