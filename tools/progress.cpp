// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace encase {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;

extern "C" void on_interrupt(int) {
  interrupt_count = interrupt_count + 1;
  if (interrupt_count > 1) _exit(128 + SIGINT);
}

}  // namespace

Progress::Progress(bool show)
    : show_(show && isatty(STDERR_FILENO)),
      start_(std::chrono::steady_clock::now()),
      last_(start_),
      previous_handler_(std::signal(SIGINT, on_interrupt)) {
  interrupt_count = 0;
}

Progress::~Progress() {
  std::signal(SIGINT, previous_handler_);
  if (printed_) std::fputs("\r\033[K", stderr);
}

bool Progress::interrupted() { return interrupt_count > 0; }

std::function<bool(const char*, double)> Progress::callback() {
  return [this](const char* stage, double done) {
    print(stage, done);
    return !interrupted();
  };
}

void Progress::print(const char* stage, double done) {
  if (!show_) return;
  const auto now = std::chrono::steady_clock::now();
  using namespace std::chrono_literals;
  if (now - start_ < 1s || now - last_ < 100ms) return;
  last_ = now;
  printed_ = true;
  if (done >= 0)
    std::fprintf(stderr, "\r\033[K%s %3.0f %%", stage, 100 * done);
  else
    std::fprintf(stderr, "\r\033[K%s ...", stage);
  std::fflush(stderr);
}

}  // namespace encase
