// SPDX-License-Identifier: MIT
#pragma once

#include "encase/caps.hpp"
#include "encase/encasement.hpp"
#include "encase/result.hpp"

namespace encase {

/// What the command returns to the shell.
enum ExitCode : int {
  kCertified = 0,
  kBadInput = 1,    ///< wrong usage, input that is not understood, a result that does not hold
  kFileError = 2,   ///< a file that cannot be read or written
  kDegenerate = 3,  ///< something degenerate is reported
  kUndecided = 4,   ///< a budget ran out
  kInternalError = 5
};

inline ExitCode exit_code(Outcome outcome) {
  switch (outcome) {
    case Outcome::Certified:
      return kCertified;
    case Outcome::Degenerate:
      return kDegenerate;
    case Outcome::Undecided:
      return kUndecided;
  }
  return kInternalError;
}

inline ExitCode exit_code(CapsClass answer) {
  switch (answer) {
    case CapsClass::Exact:
      return kCertified;
    case CapsClass::DeltaWeak:
      return kDegenerate;
    case CapsClass::Undecided:
      return kUndecided;
  }
  return kInternalError;
}

inline ExitCode exit_code(Error::Code code) {
  switch (code) {
    case Error::Code::BadInput:
      return kBadInput;
    case Error::Code::Io:
      return kFileError;
    case Error::Code::Degenerate:
      return kDegenerate;
    case Error::Code::Undecided:
      return kUndecided;
    case Error::Code::Internal:
      return kInternalError;
  }
  return kInternalError;
}

}  // namespace encase
