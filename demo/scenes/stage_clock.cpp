#include "demo/scenes/stage_clock.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pleat::demo {

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const size_t middle = values.size() / 2;
  const double median = values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {median, values.front(), values[size_t(std::ceil(0.99 * double(values.size()))) - 1]};
}

void StageClock::on_stage(const char* system, int begin, void* clock) {
  StageClock& self = *static_cast<StageClock*>(clock);
  const auto now = std::chrono::steady_clock::now();
  if (begin) {
    self.start_ = now;
    return;
  }
  auto running = std::ranges::find_if(self.running_, [system](const Running& known) {
    return known.system == system || std::strcmp(known.system, system) == 0;
  });
  if (running == self.running_.end()) running = self.running_.insert(running, {system});
  running->sum += std::chrono::duration<double, std::micro>(now - self.start_).count();
}

void StageClock::begin_frame() {
  if (frames_ == 0) running_.clear();  // what ran while the scene was made is not in the schedule's order
  for (Running& running : running_) running.sum = 0.0;
}

void StageClock::end_frame() {
  for (size_t i = 0; i < running_.size(); ++i) {
    // A system that was not in the plan until now took nothing before.
    if (i == stages_.size()) stages_.push_back({running_[i].system, std::vector<double>(frames_, 0.0)});
    stages_[i].frames.push_back(running_[i].sum);
    running_[i].sum = 0.0;
  }
  ++frames_;
}

void align(std::vector<std::vector<StageClock::Stage>>& runs) {
  std::vector<StageClock::Stage> idle;  // every stage of any run
  for (const auto& run : runs) {
    for (const StageClock::Stage& stage : run) {
      if (std::ranges::find(idle, stage.name, &StageClock::Stage::name) == idle.end())
        idle.push_back({stage.name, std::vector<double>(stage.frames.size(), 0.0)});
    }
  }
  for (auto& run : runs) {
    std::vector<StageClock::Stage> all = idle;
    for (StageClock::Stage& stage : run)
      *std::ranges::find(all, stage.name, &StageClock::Stage::name) = std::move(stage);
    run = std::move(all);
  }
}

}  // namespace pleat::demo
