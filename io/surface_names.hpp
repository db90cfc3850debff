// SPDX-License-Identifier: MIT
#pragma once

#include "encase/surface_encasement.hpp"
#include "io/names.hpp"

namespace encase {

inline constexpr Name<PairCertificate::Kind> kPairKinds[] = {
    {PairCertificate::Kind::Apart, "apart"},
    {PairCertificate::Kind::Listed, "listed"},
    {PairCertificate::Kind::Local, "local"}};

}  // namespace encase
