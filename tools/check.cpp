// SPDX-License-Identifier: MIT
#include "check.hpp"

#include <fmt/format.h>

#include <optional>

#include "encase/result_json.hpp"
#include "encase/verify.hpp"
#include "output.hpp"
#include "progress.hpp"

namespace encase {
namespace {

std::string verdict(const Encasement& encasement, std::int64_t claims) {
  std::string text = fmt::format("verified: {} claims re-proved", claims);
  if (encasement.outcome == Outcome::Degenerate)
    text += fmt::format("; degenerate: {}", encasement.degenerate.size());
  if (encasement.outcome == Outcome::Undecided)
    text += fmt::format("; undecided: {}", encasement.undecided.size());
  return text + "\n";
}

}  // namespace

ExitCode run_check(const CheckRequest& request) {
  const auto& [file, quiet, options] = request;
  const auto text = read_input(file);
  if (!text) return fail(text.error());
  const auto stored = result_from_json(text.value(), file == "-" ? "standard input" : file);
  if (!stored) return fail(stored.error());
  const auto& [encasement, arrangement, source] = stored.value();
  std::optional<Progress> progress(std::in_place, !quiet);
  progress->begin("proving the result again");
  Verification verification =
      arrangement ? verify(encasement, *arrangement, options) : verify(encasement, options);
  if (source) {
    const Verification more = verify_source(*source, encasement, options);
    verification.claims += more.claims;
    verification.objections.insert(verification.objections.end(), more.objections.begin(),
                                   more.objections.end());
  }
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
    if (const Status status = print(verdict(encasement, verification.claims))) return fail(*status);
  return exit_code(encasement.outcome);
}

}  // namespace encase
