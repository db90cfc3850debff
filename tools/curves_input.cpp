// SPDX-License-Identifier: MIT
#include "curves_input.hpp"

#include <utility>

namespace encase {

Result<CurvesFile> read_curves_input(const std::string& file,
                                     const std::vector<std::string>& expressions,
                                     const std::string& region, bool region_needed) {
  std::string lines;
  for (const std::string& expression : expressions) lines += expression + "\n";
  auto read = expressions.empty() ? load_curves(file) : read_curves(lines, "-e");
  if (!read) return read.error();
  CurvesFile input = std::move(read).value();
  if (!region.empty()) {
    auto parsed = parse_region(region, "--region");
    if (!parsed) return parsed.error();
    input.region = std::move(parsed).value();
  }
  if (region_needed && !input.region)
    return Error{Error::Code::BadInput,
                 "no region is given: add a line 'region: xmin xmax ymin ymax' to the file, or "
                 "--region \"xmin xmax ymin ymax\""};
  return input;
}

}  // namespace encase
