// A system of the schedule, run again and again from the same moment of a tick.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/systems/kicking_skirt.h"
#include "engine/schedule_table.h"

namespace pleat::bench {

/// The skirt in the middle of a kick, when `row` is about to run; of a system that runs several times in the tick, the
/// middle one. What the system writes is found by comparing all memory of the world before and after, and only that is
/// put back, so that its data stay in the caches as they do within a tick.
class Moment {
 public:
  /// Throws std::runtime_error where the skirt does not need the row.
  Moment(SkirtSize size, const Row& row);

  /// Puts back what a run has written.
  void rewind();
  void run();  // not inline: flop.sh counts what happens within

 private:
  /// Sees the systems of a tick begin, and keeps the memory of the world when the right one does.
  struct Watch {
    const Row& row;
    Arena* arena = nullptr;  // once the tick has come
    uint32_t runs = 0, runs_before = 0, substeps = 0;
    uint32_t substep = 0;  // the one in which the row is about to run
    std::vector<std::byte> memory;

    static void on_stage(const char* system, int begin, void* watch);
  };
  struct Piece {
    size_t begin, bytes;
  };
  ClothTick reach();
  void find_written();

  const Row& row_;
  Watch watch_;
  KickingSkirt skirt_;
  ClothTick tick_;
  std::vector<Piece> written_;
};

/// Whether the skirt needs the row.
bool is_needed(const Row& row);

}  // namespace pleat::bench
