// SPDX-License-Identifier: MIT
#pragma once

#include <signal.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace encase {

/// While it lives, a thread of its own watches for signals and shows what is being done.
///
/// Ctrl-C (or SIGTERM) asks a computation that listens to stop with what it has. If none listens,
/// or it was asked before, or the terminal is closed (SIGHUP), the process ends at once with the
/// exit code 128 + signal, and no temporary file is left. Signals that were ignored stay so.
///
/// Work that takes more than a second shows its stage on standard error, if that is a terminal and
/// `show` holds. One at a time, made before other threads are.
class Progress {
 public:
  explicit Progress(bool show);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What EncaseOptions::progress takes; valid while this lives. The computation listens from now
  /// on.
  std::function<bool(const char* stage, double done)> callback();

  /// What is done from now on, in words that outlive this; nothing listens.
  void begin(const char* stage);

 private:
  void watch();
  void on_signal(int signal);
  void print();
  void clear();

  const bool show_;
  const std::chrono::steady_clock::time_point start_;
  bool printed_ = false;
  sigset_t signals_, mask_before_;
  std::atomic<const char*> stage_ = nullptr;
  std::atomic<double> done_ = -1;
  std::atomic<bool> listening_ = false, asked_ = false, ending_ = false;
  std::thread watcher_;
};

}  // namespace encase
