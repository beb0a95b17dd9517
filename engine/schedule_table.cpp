#include "engine/schedule_table.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace pleat {
namespace {

constexpr std::size_t kMostRows = 64;  // a Plan has a bit for each

struct Table {
  std::array<Row, kMostRows> rows{};
  std::size_t count = 0;
  std::array<Plan, kPhases> of_phase{};

  Table() {
    for (const std::span<const Row> part : {force_rows(), constraint_rows(), surface_rows()}) {
      assert(count + part.size() <= kMostRows);
      std::ranges::copy(part, rows.begin() + static_cast<std::ptrdiff_t>(count));
      count += part.size();
    }
    for (std::size_t r = 0; r < count; ++r) of_phase[static_cast<std::size_t>(rows[r].phase)] |= Plan{1} << r;
  }
};

const Table& table() {
  static const Table table;
  return table;
}

}  // namespace

std::span<const Row> schedule_table() { return {table().rows.data(), table().count}; }
Plan rows_of(Phase phase) { return table().of_phase[static_cast<std::size_t>(phase)]; }

}  // namespace pleat
