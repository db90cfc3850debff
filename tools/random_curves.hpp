// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "common/random_polynomials.hpp"
#include "encase/result.hpp"
#include "exit_code.hpp"

namespace CLI {
class App;
}

namespace encase {

/// What `encase random` was asked for.
struct RandomRequest {
  int degree = 0;
  int count = 2;
  std::uint64_t seed = 1;
  int dimension = 2;
  std::vector<std::string> box;
  std::string kind = "interpolating";
  int bits = 32;
};

/// The options of `encase random`, stored in `request`, which must outlive the parsing.
void add_random_options(CLI::App& app, RandomRequest& request);

/// A .curves file (dimension 2) or .surfaces file (3) of random polynomials with the box as its
/// region. BadInput if a value is out of range.
Result<std::string> random_file(const RandomRequest& request);

/// Prints random_file.
ExitCode run_random(const RandomRequest& request);

}  // namespace encase
