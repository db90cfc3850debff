// SPDX-License-Identifier: MIT
#include "surfaces.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "encase/intersection_curves.hpp"
#include "encase/surface_mesh.hpp"
#include "encase/surface_result_json.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "surface_report.hpp"
#include "surfaces_input.hpp"
#ifdef ENCASE_HAVE_VTK
#include "encase/surface_vtk.hpp"
#endif
#ifdef ENCASE_HAVE_OPEN_MESH
#include "encase/surface_mesh_file.hpp"
#endif

namespace encase {
namespace {

Error bad_input(const std::string& message) { return {Error::Code::BadInput, message}; }

Status check_options(const SurfacesRequest& r) {
  if (const Status status = check_request(r, "surfaces", "surfaces", r.options.max_seconds))
    return status;
  if (const Status status =
          check_encasing(r.options.start_bits, r.options.max_bits, r.options.perturbation))
    return status;
  if (!(r.angle > 0 && r.angle < 1.5)) return bad_input("--angle must be between 0 and 1.5");
  if (!(r.tolerance >= 0 && std::isfinite(r.tolerance)))
    return bad_input("--tolerance must be a finite positive number");
  return check_outputs(r);
}

double tolerance(const SurfacesRequest& r, const SurfaceEncasement& encasement) {
  constexpr double kPart = 1e-3;
  return r.tolerance > 0 ? r.tolerance
                         : kPart * encasement.region_used.bounding_box().largest_width();
}

/// The arrangement of space, where the encasement is certified and the regions can be told.
Result<std::optional<SpaceArrangement>> arranged(const Result<SurfaceEncasement>& encasement) {
  if (!encasement || encasement.value().outcome != Outcome::Certified)
    return std::optional<SpaceArrangement>();
  auto arrangement = arrange(encasement.value());
  if (!arrangement && arrangement.error().code == Error::Code::Undecided)
    return std::optional<SpaceArrangement>();
  if (!arrangement) return arrangement.error();
  return std::optional<SpaceArrangement>(std::move(arrangement).value());
}

/// The files asked for, in the order of their options. `notes` is what the report says of them.
Status write_files(const SurfacesRequest& r, const SurfaceEncasement& encasement,
                   const SpaceArrangement* arrangement, [[maybe_unused]] std::string* notes) {
  std::vector<SurfaceMesh> meshes;
  SurfaceMeshOptions meshing;
  meshing.tolerance = tolerance(r, encasement);
  meshing.angle = r.angle;
  if (!r.mesh.empty() || !r.vtk_directory.empty()) {
    auto made = mesh(encasement, meshing);
    if (!made) return made.error();
    meshes = std::move(made).value();
    *notes = mesh_report(encasement, meshes);
  }
  if (!r.json.empty())
    if (const Status status = write_output(r.json, to_json(encasement, arrangement, meshes)))
      return status;
#ifdef ENCASE_HAVE_OPEN_MESH
  if (!r.mesh.empty())
    if (const Status status = write_open_mesh(meshes, r.mesh)) return status;
#endif
#ifdef ENCASE_HAVE_VTK
  if (!r.vtk_directory.empty()) {
    IntersectionTraceOptions tracing;
    tracing.tolerance = meshing.tolerance;
    const auto curves = trace(encasement, tracing);
    if (!curves) return curves.error();
    return write_vtk(encasement, curves.value(), meshes, r.vtk_directory, r.history);
  }
#endif
  return {};
}

Status write_report(const SurfacesRequest& r, const SurfaceEncasement& encasement,
                    const SpaceArrangement* arrangement, const std::string& notes) {
  std::string text = report(encasement) + notes;
  if (r.verbose) text += statistics_report(encasement);
  return print_report(r, r.summary ? summary_json(encasement, arrangement) : "", text);
}

}  // namespace

ExitCode run_surfaces(SurfacesRequest request) {
  if (const Status status = check_options(request)) return fail(*status);
  auto input = read_surfaces_input(request.file, request.expressions, request.region);
  if (!input) return fail(input.error());

  std::optional<Progress> progress(std::in_place, may_show_progress(request));
  request.options.progress = progress->callback();
  const auto encasement = encase(input.value().surfaces, input.value().region, request.options);
  const auto arrangement = arranged(encasement);
  if (!arrangement) return fail(arrangement.error());
  const SpaceArrangement* known = arrangement.value() ? &*arrangement.value() : nullptr;
  progress->begin("writing the result");
  std::string notes;
  Status status = encasement ? write_files(request, encasement.value(), known, &notes)
                             : Status(encasement.error());
  progress.reset();
  if (!status) status = write_report(request, encasement.value(), known, notes);
  return status ? fail(*status) : exit_code(encasement.value().outcome);
}

}  // namespace encase
