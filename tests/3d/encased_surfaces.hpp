// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "encase/surface_encasement.hpp"
#include "written.hpp"

namespace encase {

/// A certified encasement of polynomials in [-half, half]^3.
inline SurfaceEncasement encased_surfaces(const std::vector<std::string>& texts, int half) {
  std::vector<NamedSurface> surfaces;
  for (const std::string& text : texts)
    surfaces.push_back({"s" + std::to_string(surfaces.size()), written::polynomial<3>(text)});
  const Polyhedron cube = make_box({-half, -half, -half}, {half, half, half}).value();
  auto result = encase(surfaces, cube);
  EXPECT_TRUE(result) << result.error().message;
  EXPECT_EQ(result.value().outcome, Outcome::Certified);
  return std::move(result).value();
}

}  // namespace encase
