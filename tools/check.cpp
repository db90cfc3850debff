// SPDX-License-Identifier: MIT
#include "check.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <variant>

#include "encase/result_json.hpp"
#include "encase/surface_mesh.hpp"
#include "encase/verify.hpp"
#include "output.hpp"
#include "progress.hpp"

namespace encase {
namespace {

/// The sentence for people, the exit code, and what was found.
struct Verdict {
  std::string text;
  ExitCode code = kCertified;
  Verification verification;
};

void add(Verdict* verdict, const Verification& more) {
  verdict->verification.claims += more.claims;
  auto& objections = verdict->verification.objections;
  objections.insert(objections.end(), more.objections.begin(), more.objections.end());
}

/// What an encasement says of itself.
template <class AnyEncasement>
Verdict verdict_of(const AnyEncasement& encasement) {
  Verdict verdict;
  verdict.code = exit_code(encasement.outcome);
  if (encasement.outcome == Outcome::Degenerate)
    verdict.text = fmt::format("; degenerate: {}", encasement.degenerate.size());
  if (encasement.outcome == Outcome::Undecided)
    verdict.text = fmt::format("; undecided: {}", encasement.undecided.size());
  return verdict;
}

Verdict judge(const StoredResult& stored, const VerifyOptions& options) {
  const auto& [encasement, arrangement, source] = stored;
  Verdict verdict = verdict_of(encasement);
  add(&verdict,
      arrangement ? verify(encasement, *arrangement, options) : verify(encasement, options));
  if (source) add(&verdict, verify_source(*source, encasement, options));
  return verdict;
}

Verdict judge(const CapsResult& result, const VerifyOptions& options) {
  Verdict verdict;
  verdict.code = exit_code(result.answer);
  switch (result.answer) {
    case CapsClass::Exact:
      verdict.text = "; exact: the graph is that of the arrangement";
      break;
    case CapsClass::DeltaWeak:
      verdict.text = "; delta-weak: beyond that it is a claim of the paper, and not proved";
      break;
    case CapsClass::Undecided:
      verdict.text = "; undecided: a limit was reached";
      break;
  }
  add(&verdict, verify(result, options));
  return verdict;
}

Verdict judge(const StoredSurfaces& stored, const VerifyOptions& options) {
  const auto& [encasement, arrangement, meshes] = stored;
  Verdict verdict = verdict_of(encasement);
  Verification& verification = verdict.verification;
  verification =
      arrangement ? verify(encasement, *arrangement, options) : verify(encasement, options);
  if (!verification.ok()) return verdict;
  for (const SurfaceMesh& mesh : meshes)
    verification.claims += static_cast<decltype(verification.claims)>(mesh.triangles.size());
  if (const std::string objection = check(meshes, encasement); !objection.empty())
    verification.objections.push_back("meshes: " + objection);
  return verdict;
}

}  // namespace

ExitCode run_check(const CheckRequest& request) {
  const auto& [file, quiet, options] = request;
  const auto text = read_input(file);
  if (!text) return fail(text.error());
  const auto stored = any_result_from_json(text.value(), file == "-" ? "standard input" : file);
  if (!stored) return fail(stored.error());
  std::optional<Progress> progress(std::in_place, !quiet);
  progress->begin("proving the result again");
  const auto& [words, code, verification] = std::visit(
      [&](const auto& result) { return judge(result, request.options); }, stored.value());
  progress.reset();
  if (!verification.ok()) {
    std::string objections;
    for (const std::string& objection : verification.objections) objections += objection + "\n";
    if (!quiet)
      if (const Status status = print(objections)) return fail(*status);
    return fail(
        {Error::Code::BadInput,
         fmt::format("{} is not proved: {} objection{}", file, verification.objections.size(),
                     verification.objections.size() == 1 ? "" : "s")});
  }
  if (!quiet)
    if (const Status status =
            print(fmt::format("verified: {} claims re-proved{}\n", verification.claims, words)))
      return fail(*status);
  return code;
}

}  // namespace encase
