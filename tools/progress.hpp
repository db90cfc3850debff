// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>

namespace encase {

/// While it lives: Ctrl-C asks the computation to stop with what it has (a second one ends the
/// process), and work that takes more than a second shows its stage on standard error, if that is a
/// terminal and `show` holds. One at a time.
class Progress {
 public:
  explicit Progress(bool show);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What EncaseOptions::progress takes; valid while this lives.
  std::function<bool(const char* stage, double done)> callback();

  /// Whether Ctrl-C was pressed.
  static bool interrupted();

 private:
  void print(const char* stage, double done);

  bool show_;
  bool printed_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
  void (*previous_handler_)(int);
};

}  // namespace encase
