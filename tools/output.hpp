// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/result.hpp"
#include "exit_code.hpp"

namespace encase {

/// Prints "encase: message" on standard error and gives the exit code.
ExitCode fail(const Error& error);

/// Writes text to standard output; Io if that fails (a full disk, a closed pipe).
Status print(const std::string& text);

/// Standard output for "-", else a file that is complete or absent.
Status write_output(const std::string& path, const std::string& text);

/// Io if a file surely cannot be written at `path`, so that long work need not be done first.
Status check_writable(const std::string& path);

/// The same for a directory that may have to be made.
Status check_writable_directory(const std::string& path);

/// All of a file, or of standard input for "-".
Result<std::string> read_input(const std::string& path);

}  // namespace encase
