#include "demo/program/progress.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <stdexcept>

namespace pleat::demo {
namespace {

constexpr std::int64_t kPatience = 2;  // s: one request to stop may come as two signals

std::atomic<std::int64_t> interrupted_at = 0;  // s since 1970, 0: not yet
static_assert(decltype(interrupted_at)::is_always_lock_free, "a signal's handler sets it");

}  // namespace

void catch_interrupt() {
  for (const int number : {SIGINT, SIGTERM}) {
    std::signal(number, [](int caught) {
      const std::int64_t now = std::time(nullptr);
      std::int64_t first = 0;
      if (interrupted_at.compare_exchange_strong(first, now) || now - first < kPatience) return;
      std::signal(caught, SIG_DFL);
      std::raise(caught);
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
  if (interrupted_at != 0) throw std::runtime_error("interrupted: nothing was kept");
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  shown_ = true;
  const double spent = std::chrono::duration<double>(now - begin_).count();
  std::fprintf(stderr, "\r%s %u / %u, %.0f s left\033[K", what_.c_str(), done_, total_,
               spent * (total_ - done_) / done_);
}

}  // namespace pleat::demo
