// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

#include "encase/atomic_file.hpp"

namespace encase {
namespace {

constexpr int kWake = SIGURG;  // who is not watched for is not disturbed by it

bool is_ignored(int signal) {
  struct sigaction action;
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

Progress::Progress(bool show)
    : show_(show && isatty(STDERR_FILENO)), start_(std::chrono::steady_clock::now()) {
  sigemptyset(&signals_);
  sigaddset(&signals_, kWake);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (!is_ignored(signal)) sigaddset(&signals_, signal);
  // Blocked in this thread and in all that it makes, so that the watcher gets them.
  pthread_sigmask(SIG_BLOCK, &signals_, &mask_before_);
  watcher_ = std::thread([this] { watch(); });
}

Progress::~Progress() {
  ending_ = true;
  pthread_kill(watcher_.native_handle(), kWake);
  watcher_.join();
  clear();
  pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

std::function<bool(const char*, double)> Progress::callback() {
  listening_ = true;
  return [this](const char* stage, double done) {
    stage_ = stage;
    done_ = done;
    return !asked_;
  };
}

void Progress::begin(const char* stage) {
  listening_ = false;
  stage_ = stage;
  done_ = -1;
}

void Progress::watch() {
  constexpr timespec kBetweenLines{0, 100'000'000};
  while (!ending_) {
    const int signal =
        show_ ? sigtimedwait(&signals_, nullptr, &kBetweenLines) : sigwaitinfo(&signals_, nullptr);
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) on_signal(signal);
    if (show_ && std::chrono::steady_clock::now() - start_ >= std::chrono::seconds(1)) print();
  }
}

void Progress::on_signal(int signal) {
  if (signal != SIGHUP && listening_ && !asked_) {
    asked_ = true;
    return;
  }
  clear();
  abandon_writes();
  _exit(128 + signal);
}

void Progress::print() {
  const char* stage = stage_;
  if (!stage) return;
  printed_ = true;
  const double done = done_;
  if (done >= 0)
    std::fprintf(stderr, "\r\033[K%s %3.0f %%", stage, 100 * done);
  else
    std::fprintf(stderr, "\r\033[K%s ...", stage);
  std::fflush(stderr);
}

void Progress::clear() {
  if (printed_) std::fputs("\r\033[K", stderr);
}

}  // namespace encase
