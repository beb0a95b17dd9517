#include "bench/systems/moment.h"

#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace pleat::bench {
namespace {

constexpr int kWarmUp = 5;  // ticks, into the kick
constexpr size_t kLine = 64;

}  // namespace

void Moment::Watch::on_stage(const char* system, int begin, void* user) {
  Watch& watch = *static_cast<Watch*>(user);
  if (begin == 0) return;
  if (std::string_view(system) == "pin_motion") ++watch.substeps;
  if (system != watch.row.name) return;
  if (++watch.runs != (watch.runs_before + 1) / 2 || watch.arena == nullptr) return;
  watch.substep = watch.substeps;
  watch.memory.assign(watch.arena->used().begin(), watch.arena->used().end());
}

Moment::Moment(SkirtSize size, const Row& row)
    : row_(row), watch_{.row = row, .memory = {}}, skirt_(size, Watch::on_stage, &watch_), tick_(reach()) {
  find_written();
}

ClothTick Moment::reach() {
  for (int i = 0; i <= kWarmUp; ++i) {
    watch_.runs_before = std::exchange(watch_.runs, 0);
    watch_.substeps = 0;
    if (i == kWarmUp) watch_.arena = &skirt_.arena();
    skirt_.tick();
  }
  if (watch_.memory.empty()) throw std::runtime_error(std::string("the skirt does not run ") + row_.name);
  const auto substeps = static_cast<float>(watch_.substeps), after = static_cast<float>(watch_.substep);
  std::memcpy(skirt_.arena().used().data(), watch_.memory.data(), watch_.memory.size());
  World& world = skirt_.world();
  world.busy = false;  // what was kept is from within a tick
  watch_.memory.assign(watch_.arena->used().begin(), watch_.arena->used().end());
  ClothTick t(world, world.workers[0], world.clothes[0]);
  t.frame_dt = KickingSkirt::kTick;
  if (watch_.substep == 0) return t;
  t.dt = t.force_dt = t.frame_dt / substeps;
  t.t0 = (after - 1.0f) / substeps;
  t.t1 = after / substeps;
  t.spring_room = std::numeric_limits<float>::infinity();  // these springs need no softening
  t.time = world.time + static_cast<double>(t.t0 * t.frame_dt);
  return t;
}

void Moment::find_written() {
  run();
  const std::byte *now = skirt_.arena().used().data(), *before = watch_.memory.data();
  const size_t size = watch_.memory.size();
  for (size_t begin = 0; begin < size; begin += kLine) {
    const size_t bytes = std::min(kLine, size - begin);
    if (std::memcmp(now + begin, before + begin, bytes) == 0) continue;
    if (!written_.empty() && written_.back().begin + written_.back().bytes == begin) {
      written_.back().bytes += bytes;
    } else {
      written_.push_back({begin, bytes});
    }
  }
  rewind();
}

void Moment::rewind() {
  std::byte* now = skirt_.arena().used().data();
  for (const Piece& piece : written_) std::memcpy(now + piece.begin, &watch_.memory[piece.begin], piece.bytes);
  tick_.trouble = false;
}

void Moment::run() { row_.run(tick_); }

bool is_needed(const Row& row) {
  KickingSkirt skirt(kSkirtSizes[0]);
  const World& world = skirt.world();
  return row.left_out(world, world.clothes[0]) == nullptr;
}

}  // namespace pleat::bench
