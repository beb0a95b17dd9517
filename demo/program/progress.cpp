#include "demo/program/progress.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace pleat::demo {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void catch_interrupt() {
  for (const int number : {SIGINT, SIGTERM}) {
    std::signal(number, [](int caught) {
      interrupted = 1;
      std::signal(caught, SIG_DFL);
    });
  }
}

Progress::Progress(std::string what, uint32_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO)),
      begin_(std::chrono::steady_clock::now()),
      last_(begin_) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::step() {
  ++done_;
  if (interrupted) throw std::runtime_error("interrupted: nothing was kept");
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  shown_ = true;
  const double spent = std::chrono::duration<double>(now - begin_).count();
  std::fprintf(stderr, "\r%s %u / %u, %.0f s left\033[K", what_.c_str(), done_, total_,
               spent * (total_ - done_) / done_);
}

}  // namespace pleat::demo
