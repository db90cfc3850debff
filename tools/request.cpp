// SPDX-License-Identifier: MIT
#include "request.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "output.hpp"

namespace encase {
namespace {

Error bad_input(const std::string& message) { return {Error::Code::BadInput, message}; }

Status check_mesh_output(const std::string& path) {
  if (path.empty()) return {};
#ifdef ENCASE_HAVE_OPEN_MESH
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".om" && extension != ".off" && extension != ".obj" && extension != ".ply")
    return bad_input("--mesh writes .om, .off, .obj or .ply, not '" + path + "'");
  return check_writable(path);
#else
  return bad_input("--mesh needs OpenMesh, and this encase was built without OpenMesh");
#endif
}

}  // namespace

Status check_request(const Request& r, const std::string& command, const std::string& things,
                     double max_seconds) {
  if (r.file.empty() == r.expressions.empty())
    return bad_input("give either a FILE of " + things + " or expressions with -e; see encase " +
                     command + " --help");
  if ((r.json == "-") + (r.svg == "-") + r.summary > 1)
    return bad_input("only one of --json -, --svg - and --summary can have standard output");
  if (!std::isfinite(max_seconds)) return bad_input("--max-seconds must be a finite number");
  return {};
}

Status check_encasing(int start_bits, int max_bits, double perturbation) {
  if (start_bits > max_bits) return bad_input("--start-bits is above --max-bits");
  if (!(perturbation >= 0 && perturbation < 1))
    return bad_input("--perturb must be between 0 and 1");
  return {};
}

Status check_outputs(const Request& r) {
  if (r.history && r.vtk_directory.empty())
    return bad_input("--history belongs to the VTK files: give their directory with -o");
  if (const Status status = check_mesh_output(r.mesh)) return status;
#ifndef ENCASE_HAVE_VTK
  if (!r.vtk_directory.empty())
    return bad_input("-o needs VTK, and this encase was built without VTK");
#endif
  for (const std::string* path : {&r.json, &r.svg})
    if (const Status status = check_writable(*path)) return status;
  return check_writable_directory(r.vtk_directory);
}

bool may_show_progress(const Request& r) {
  return !r.quiet && !(r.json_or_svg_on_output() && isatty(STDOUT_FILENO));
}

Status print_report(const Request& r, const std::string& counts, const std::string& report) {
  if (r.summary) {
    if (const Status status = print(counts + "\n")) return status;
    if (r.verbose) std::fputs(report.c_str(), stderr);
    return {};
  }
  if (r.quiet) return {};
  if (!r.json_or_svg_on_output()) return print(report);
  std::fputs(report.c_str(), stderr);
  return {};
}

}  // namespace encase
