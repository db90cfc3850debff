// SPDX-License-Identifier: MIT
#include "curves.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "common/parallel.hpp"
#include "curves_input.hpp"
#include "encase/arrangement.hpp"
#include "encase/curves_file.hpp"
#include "encase/result_json.hpp"
#include "encase/svg.hpp"
#include "encase/verify.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "report.hpp"
#ifdef ENCASE_HAVE_VTK
#include "encase/vtk.hpp"
#endif
#ifdef ENCASE_HAVE_OPEN_MESH
#include "encase/open_mesh.hpp"
#endif

namespace encase {
namespace {

Error bad_input(const std::string& message) { return {Error::Code::BadInput, message}; }

Status check_options(const CurvesRequest& r) {
  if (const Status status = check_request(r, "curves", "curves", r.options.max_seconds))
    return status;
  if (r.faces && r.svg.empty() && r.mesh.empty())
    return bad_input("--faces belongs to the picture or the mesh: give --svg or --mesh");
  if (r.labels && r.svg.empty()) return bad_input("--labels belongs to the picture: give --svg");
  if (!r.onto.empty() && (!r.region.empty() || r.options.perturbation > 0))
    return bad_input("with --onto the region and the perturbation are those of the earlier result");
  if (r.onto == "-" && r.file == "-")
    return bad_input("FILE and --onto cannot both be standard input");
  if (const Status status =
          check_encasing(r.options.start_bits, r.options.max_bits, r.options.perturbation))
    return status;
  return check_outputs(r);
}

struct Input {
  std::optional<Encasement> earlier;  ///< of --onto
  std::vector<NamedCurve> curves;
  Region region;
};

/// Reads the earlier result and proves it again, for what is taken over from it must be. Names of
/// the new curves that say nothing but their place go on with its numbers; of the others none may
/// be there already.
Result<Input> read_onto(const CurvesRequest& r, std::vector<NamedCurve> curves) {
  const auto text = read_input(r.onto);
  if (!text) return text.error();
  auto earlier = encasement_from_json(text.value(), r.onto == "-" ? "standard input" : r.onto);
  if (!earlier) return earlier.error();
  VerifyOptions verification;
  verification.threads = r.options.threads;
  const Verification proof = verify(earlier.value(), verification);
  if (!proof.ok()) return bad_input(r.onto + " is not proved: " + proof.objections.front());
  const std::vector<NamedCurve>& there = earlier.value().input;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    std::string& name = curves[k].name;
    if (name == fmt::format("c{}", k)) name = fmt::format("c{}", there.size() + k);
    for (const NamedCurve& other : there)
      if (name == other.name)
        return bad_input(fmt::format("a curve '{}' is in {} already", name, r.onto));
  }
  Region region = earlier.value().region;
  return Input{std::move(earlier).value(), std::move(curves), std::move(region)};
}

Result<Input> read(const CurvesRequest& r) {
  auto input = read_curves_input(r.file, r.expressions, r.region, r.onto.empty());
  if (!input) return input.error();
  if (!r.onto.empty()) return read_onto(r, std::move(input.value().curves));
  return Input{std::nullopt, std::move(input.value().curves), *std::move(input.value().region)};
}

Status write_svg(const CurvesRequest& r, const Encasement& encasement) {
  SvgOptions options;
  options.faces = r.faces;
  options.labels = r.labels;
  return write_output(r.svg, to_svg(encasement, options));
}

/// What is written: the result, and its arrangement where it is certified.
struct Answer {
  Encasement encasement;
  std::optional<Arrangement> arrangement;
  const Arrangement* arranged() const { return arrangement ? &*arrangement : nullptr; }
};

Result<Answer> with_arrangement(Encasement encasement) {
  Answer answer{std::move(encasement), std::nullopt};
  if (answer.encasement.outcome != Outcome::Certified) return answer;
  Result<Arrangement> arranged = arrange(answer.encasement);
  if (!arranged) return arranged.error();
  answer.arrangement = std::move(arranged).value();
  return answer;
}

/// The files asked for, in the order of their options.
Status write_files(const CurvesRequest& r, const Answer& answer) {
  const Encasement& encasement = answer.encasement;
  if (!r.json.empty())
    if (const Status status = write_output(r.json, to_json(encasement, answer.arranged())))
      return status;
  if (!r.svg.empty())
    if (const Status status = write_svg(r, encasement)) return status;
#ifdef ENCASE_HAVE_OPEN_MESH
  if (!r.mesh.empty())
    if (const Status status = write_open_mesh(encasement, r.mesh, {r.faces})) return status;
#endif
#ifdef ENCASE_HAVE_VTK
  if (!r.vtk_directory.empty())
    if (const Status status = write_vtk(encasement, r.vtk_directory, r.history)) return status;
#endif
  return {};
}

std::string threads_report(int threads) {
  return has_threads()
             ? fmt::format("threads              at most {}\n", threads)
             : fmt::format("threads              1 ({} allowed; built without oneTBB)\n", threads);
}

/// Ends the progress before it prints.
Status write_report(const CurvesRequest& r, const Answer& answer,
                    std::optional<Progress>& progress) {
  std::string text = report(answer.encasement);
  if (r.verbose) text += statistics_report(answer.encasement) + threads_report(r.options.threads);
  const std::string counts =
      r.summary ? summary_json(answer.encasement, answer.arranged()) : std::string();
  progress.reset();
  return print_report(r, counts, text);
}

}  // namespace

ExitCode run_curves(CurvesRequest request) {
  if (const Status status = check_options(request)) return fail(*status);
  const auto input = read(request);
  if (!input) return fail(input.error());

  std::optional<Progress> progress(std::in_place, may_show_progress(request));
  request.options.progress = progress->callback();
  const auto& [earlier, curves, region] = input.value();
  auto result = earlier ? add_curves(*earlier, curves, request.options)
                        : encase(curves, region, request.options);
  progress->begin("writing the result");
  const auto answered =
      result ? with_arrangement(std::move(result).value()) : Result<Answer>(result.error());
  Status status = answered ? write_files(request, answered.value()) : Status(answered.error());
  if (!status) status = write_report(request, answered.value(), progress);
  progress.reset();
  return status ? fail(*status) : exit_code(answered.value().encasement.outcome);
}

}  // namespace encase
