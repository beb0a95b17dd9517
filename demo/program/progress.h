#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace pleat::demo {

/// A line on a terminal that shows how far long work is and, from its pace so far, how long it will take. Silent where
/// stderr is no terminal.
class Progress {
 public:
  Progress(std::string what, uint32_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more unit is done. Throws std::runtime_error after what catch_interrupt caught, so that what was begun is
  /// cleaned up.
  void step();

 private:
  std::string what_;
  uint32_t total_, done_ = 0;
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point begin_, last_;
};

/// From now on Ctrl-C or SIGTERM ends work at its next Progress::step, and one that comes two seconds later or more at
/// once.
void catch_interrupt();

}  // namespace pleat::demo
