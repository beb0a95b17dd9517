// The order in which edges are solved, and which of them at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pleat {

using EdgeEnds = std::array<std::uint32_t, 2>;

/// Puts edges in bands by how far their two ends are from the nearest of `from`, in edges: a pass over them carries a
/// pull from there outwards, edges across it one band later. These are the pins or, where a cloth has none, its middle,
/// where it will lie on something. Within a band edges of one colour come together, which share no particle, so that
/// runs of slots fill. What is not joined to any of them is one band. Cost: O(E log E).
void order_edges(std::uint32_t particle_count, std::span<const std::uint32_t> from, std::vector<EdgeEnds>& edges);

inline constexpr std::uint32_t kEmptySlot = 0xffffffffu;

/// Edges, by index, in runs of `lanes` that share no particle, the last places of some empty. An edge comes after all
/// that are before it in `edges` and meet it at a particle: solved run by run, each at once, they end as they would one
/// after the other. A run that another waits for takes a processor long, runs side by side do not: so runs come in
/// stages of some that do not wait for each other, as few stages as the longest chain has edges that meet one after the
/// other (list scheduling; T. Hu, "Parallel Sequencing and Assembly Line Problems", 1961). Cost: O(P + E log E).
std::vector<std::uint32_t> slots_of(std::uint32_t particle_count, std::span<const EdgeEnds> edges, std::uint32_t lanes);

}  // namespace pleat
