// The edges and hinges that meet at each particle, while a garment is built.
#pragma once

#include <span>
#include <vector>

#include "components/garment.h"

namespace pleat {

/// Lists of indices, one for each particle.
class IndexLists {
 public:
  /// Of all k, those for which columns[c][k] is the particle, for any c.
  template <std::size_t N>
  IndexLists(std::uint32_t particle_count, const Column<std::uint32_t> (&columns)[N])
      : begin_(std::size_t{particle_count} + 1), indices_(N * columns[0].size()) {
    for (const auto& column : columns) {
      for (const std::uint32_t i : column) ++begin_[i + 1];
    }
    for (std::uint32_t i = 0; i < particle_count; ++i) begin_[i + 1] += begin_[i];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t k = 0; k < columns[0].size(); ++k) {
      for (const auto& column : columns) indices_[next[column[k]]++] = k;
    }
  }
  std::span<const std::uint32_t> of(std::uint32_t i) const {
    return {indices_.data() + begin_[i], indices_.data() + begin_[i + 1]};
  }

 private:
  std::vector<std::uint32_t> begin_, indices_;
};

/// The other end of edge e.
inline std::uint32_t across(const Garment& g, std::uint32_t e, std::uint32_t i) {
  return g.edge_particle[0][e] ^ g.edge_particle[1][e] ^ i;
}

}  // namespace pleat
