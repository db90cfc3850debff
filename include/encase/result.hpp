// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace encase {

/// Why a call has no value. `message` is one sentence the user can act on (which curve, which line
/// and column of which file).
struct Error {
  enum class Code {
    BadInput,    ///< the input cannot be understood or is outside what Encase accepts
    Degenerate,  ///< the input is proved to be outside generic position
    Undecided,   ///< a precision or budget cap was reached before the answer was proved
    Io,          ///< a file cannot be read or written
    Internal     ///< a defect of Encase
  };
  Code code = Code::Internal;
  std::string message;
};

/// A value or the error that took its place.
template <class T>
class Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}

  bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }

  /// The value; throws std::logic_error with the error's message if there is none.
  T& value() & {
    require_value();
    return std::get<T>(state_);
  }
  const T& value() const& {
    require_value();
    return std::get<T>(state_);
  }
  T&& value() && {
    require_value();
    return std::get<T>(std::move(state_));
  }
  const Error& error() const { return std::get<Error>(state_); }

 private:
  void require_value() const {
    if (!ok()) throw std::logic_error(std::get<Error>(state_).message);
  }
  std::variant<T, Error> state_;
};

/// The outcome of a call that has no value of its own.
using Status = std::optional<Error>;

}  // namespace encase
