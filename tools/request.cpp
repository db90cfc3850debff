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

Status check_outputs(const Request& r) {
#ifndef ENCASE_HAVE_VTK
  if (!r.vtk_directory.empty())
    return bad_input("-o needs VTK, and this encase was built without VTK");
#endif
  for (const std::string* path : {&r.json, &r.svg})
    if (const Status status = check_writable(*path)) return status;
  return check_writable_directory(r.vtk_directory);
}

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
