// Triangle meshes before they become cloth: what can be wrong with one, and the safe repairs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "components/vec3.h"

namespace pleat {

using Triangle = std::array<std::uint32_t, 3>;

/// What check_and_repair found; the meaning of each is in engine/pleat.h, pleat_mesh_report.
struct MeshReport {
  std::uint32_t degenerate_triangles = 0, duplicate_triangles = 0, flipped_triangles = 0, unreferenced_vertices = 0;
  std::uint32_t nonmanifold_edges = 0, nonorientable_edges = 0, nonmanifold_vertices = 0;
  std::uint32_t parts = 0, border_loops = 0;
  std::string fault;  // empty, or why the mesh cannot be cloth, naming the first place
};

/// Checks `triangles` over `positions` (finite, m; every index < positions.size()) and repairs in place what is safe:
/// leaves out degenerate and duplicate triangles and turns those wound against their neighbours (in each connected part
/// the majority wins). Vertices keep their indices. `fault` is set for an edge with more than two triangles, a part
/// that has no consistent winding, or when no triangle is left.
MeshReport check_and_repair(std::span<const Vec3> positions, std::vector<Triangle>& triangles);

}  // namespace pleat
