#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "engine/pleat.h"

namespace pleat::demo {

/// Median, least and 99th percentile of a series.
struct Spread {
  double median = 0.0, min = 0.0, p99 = 0.0;
};

/// Errors: an empty series is all zeros.
Spread spread_of(std::vector<double> values);

/// Measures how long each system of the schedule takes a frame, through pleat_world_def.stage.
class StageClock {
 public:
  struct Stage {
    std::string name;
    std::vector<double> frames;  ///< us, one a frame
  };

  static void on_stage(const char* system, int begin, void* clock);  ///< a pleat_stage_fn
  void begin_frame();                                                ///< forgets what ran since the last end_frame
  void end_frame();
  const std::vector<Stage>& stages() const { return stages_; }  ///< in the order they first ran

 private:
  struct Running {
    const char* system;  // the engine's text: the same address each time
    double sum = 0.0;    // us, of this frame
  };
  std::vector<Running> running_;
  std::vector<Stage> stages_;
  size_t frames_ = 0;
  std::chrono::steady_clock::time_point start_;
};

/// Gives all runs of a scene, of the same number of frames, the same stages in the same order: one that was not in a
/// run's plan, as a budget may decide, took nothing there.
void align(std::vector<std::vector<StageClock::Stage>>& runs);

}  // namespace pleat::demo
