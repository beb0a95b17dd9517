// How often cloth passes through cloth.
#pragma once

#include <cstddef>

#include "systems/near_search.h"

namespace pleat {

/// Edges of one cloth that pass through the inside of another's faces, or of its own that do not share a corner.
/// Cost: O(E + F) for triangles of like size; no allocation. Errors: none.
struct Crossings {
  PosedCloth edges, faces;
  bool itself = false;  // both are the same cloth
  NearScratch* scratch = nullptr;
  Vec3 apart{};  // m, from the zero of the edges' positions to that of the faces'

  bool validate() const;
  std::size_t run() const;
};

}  // namespace pleat
