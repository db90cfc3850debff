// SPDX-License-Identifier: MIT
#pragma once

namespace encase {

/// The version of the library and the command, MAJOR.MINOR.PATCH. The build reads it from here.
inline constexpr char kVersion[] = "0.1.0";

}  // namespace encase
