// SPDX-License-Identifier: MIT
#include "slice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "encase/arrangement.hpp"
#include "encase/result_json.hpp"
#include "encase/surfaces_file.hpp"
#include "encase/svg.hpp"
#include "io/names.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "surfaces_input.hpp"
#ifdef ENCASE_HAVE_VTK
#include "encase/vtk.hpp"
#endif

namespace encase {
namespace {

Error bad_input(const std::string& message) { return {Error::Code::BadInput, message}; }

Status check_options(const SliceRequest& r) {
  if (const Status status = check_request(r, "slice", "surfaces", r.options.max_seconds))
    return status;
  if (r.plane.empty())
    return bad_input("no plane is given: --plane \"a b c d\" is a x + b y + c z + d = 0");
  if (r.count > 0 && !(r.json.empty() && r.svg.empty()))
    return bad_input("--json and --svg show one slice: leave out --count, or take -o");
  if (const Status status =
          check_encasing(r.options.start_bits, r.options.max_bits, r.options.perturbation))
    return status;
  return check_outputs(r);
}

struct Input {
  SurfacesInput solid;
  std::vector<std::array<Rational, 4>> planes;
};

Result<Input> read(const SliceRequest& r) {
  auto solid = read_surfaces_input(r.file, r.expressions, r.region);
  if (!solid) return solid.error();
  auto plane = parse_plane(r.plane, "--plane");
  if (!plane) return plane.error();
  const auto& [a, b, c, d] = plane.value();
  if (a == 0 && b == 0 && c == 0) return bad_input("--plane has no normal: a, b and c are zero");
  Input input{std::move(solid).value(), {plane.value()}};
  if (r.count > 0) input.planes = parallel_planes(input.solid.region, {a, b, c}, r.count);
  return input;
}

/// What is made of a slice: the arrangement where the encasement is certified.
Result<std::optional<Arrangement>> arranged(const Slice& slice) {
  if (slice.encasement.outcome != Outcome::Certified) return std::optional<Arrangement>();
  auto arrangement = arrange(slice.encasement);
  if (!arrangement) return arrangement.error();
  return std::optional<Arrangement>(std::move(arrangement).value());
}

const Arrangement* pointer(const std::optional<Arrangement>& arrangement) {
  return arrangement ? &*arrangement : nullptr;
}

Result<std::vector<Slice>> make_slices(const Input& input, const EncaseOptions& options) {
  std::vector<Slice> slices;
  for (const auto& plane : input.planes) {
    auto one = slice(input.solid.surfaces, input.solid.region, plane, options);
    if (!one) return one.error();
    slices.push_back(std::move(one).value());
  }
  return slices;
}

Outcome worst(const std::vector<Slice>& slices) {
  Outcome outcome = Outcome::Certified;
  for (const Slice& slice : slices) outcome = std::max(outcome, slice.encasement.outcome);
  return outcome;
}

Status write_files(const SliceRequest& r, const std::vector<Slice>& slices) {
  if (!r.json.empty()) {
    const auto arrangement = arranged(slices[0]);
    if (!arrangement) return arrangement.error();
    if (const Status status =
            write_output(r.json, to_json(slices[0], pointer(arrangement.value()))))
      return status;
  }
  if (!r.svg.empty())
    if (const Status status = write_output(r.svg, to_svg(slices[0].encasement))) return status;
#ifdef ENCASE_HAVE_VTK
  if (!r.vtk_directory.empty())
    return r.count > 0 ? write_vtk(slices, r.vtk_directory) : write_vtk(slices[0], r.vtk_directory);
#endif
  return {};
}

Result<std::string> summary(const SliceRequest& r, const std::vector<Slice>& slices) {
  std::string text;
  double seconds = 0;
  for (const Slice& slice : slices) {
    const auto arrangement = arranged(slice);
    if (!arrangement) return arrangement.error();
    text +=
        (text.empty() ? "" : ",") + summary_json(slice.encasement, pointer(arrangement.value()));
    seconds += slice.encasement.seconds;
  }
  if (r.count == 0) return text;
  return fmt::format("{{\"status\":\"{}\",\"slices\":[{}],\"seconds\":{}}}",
                     name_of(kOutcomes, worst(slices)), text, seconds);
}

std::string slice_report(const SliceRequest& r, const Slice& slice) {
  const auto& plane = slice.source.chart.plane();
  const auto axis = [&](std::size_t k) { return "xyz"[slice.source.chart.axes()[k]]; };
  std::string text =
      fmt::format("plane {} {} {} {}; coordinates {} and {}\n", plane[0].get_str(),
                  plane[1].get_str(), plane[2].get_str(), plane[3].get_str(), axis(0), axis(1));
  for (const int k : slice.source.containing)
    text += fmt::format("surface {} contains the plane\n",
                        slice.source.surfaces[static_cast<std::size_t>(k)].name);
  text += report(slice.encasement);
  if (r.verbose) text += statistics_report(slice.encasement);
  return text;
}

Status write_report(const SliceRequest& r, const std::vector<Slice>& slices) {
  std::string text;
  for (const Slice& slice : slices) text += (text.empty() ? "" : "\n") + slice_report(r, slice);
  if (!r.summary) return print_report(r, "", text);
  const auto counts = summary(r, slices);
  return counts ? print_report(r, counts.value(), text) : Status(counts.error());
}

}  // namespace

ExitCode run_slice(SliceRequest request) {
  if (const Status status = check_options(request)) return fail(*status);
  const auto input = read(request);
  if (!input) return fail(input.error());

  std::optional<Progress> progress(std::in_place, may_show_progress(request));
  request.options.progress = progress->callback();
  const auto slices = make_slices(input.value(), request.options);
  progress->begin("writing the result");
  Status status = slices ? write_files(request, slices.value()) : Status(slices.error());
  progress.reset();
  if (!status) status = write_report(request, slices.value());
  return status ? fail(*status) : exit_code(worst(slices.value()));
}

}  // namespace encase
