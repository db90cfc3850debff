// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/result.hpp"

namespace encase {

/// What every command that makes a result can be asked for.
struct Request {
  std::string file;                      ///< "-" is standard input; empty: `expressions`
  std::vector<std::string> expressions;  ///< of -e
  std::string region;                    ///< of --region, overrides the file's
  std::string json;
  std::string svg;
  std::string vtk_directory;
  bool history = false;  ///< with the VTK files
  std::string mesh;
  bool summary = false;
  bool quiet = false;
  bool verbose = false;

  bool json_or_svg_on_output() const { return json == "-" || svg == "-"; }
};

/// The input is a file or expressions, of `things` for `command`; at most one output is standard
/// output; and the time is limited by a number. Else BadInput.
Status check_request(const Request& request, const std::string& command, const std::string& things,
                     double max_seconds);

/// The precision to start with is not above the highest one, and the perturbation lies in [0, 1).
/// Else BadInput.
Status check_encasing(int start_bits, int max_bits, double perturbation);

/// What is asked for can be written: there are VTK and OpenMesh for what needs them, which knows
/// the mesh's extension (else BadInput), and the places exist (else Io).
Status check_outputs(const Request& request);

/// Whether progress may be shown: not in the middle of an output.
bool may_show_progress(const Request& request);

/// Prints `counts`, if the summary is asked for, or `report`, where an output does not take its
/// place.
Status print_report(const Request& request, const std::string& counts, const std::string& report);

}  // namespace encase
