// The planes that the drawn surface has yet to satisfy: gathered body by body, then settled together.
#pragma once

#include "components/clearance_plane.h"
#include "components/column.h"

namespace pleat {

/// Room for some planes, and how many there are. When it is full, what it holds is settled to make room.
struct ClearanceList {
  ClearancePlane* planes = nullptr;
  std::uint32_t capacity = 0;
  std::uint32_t* count = nullptr;

  bool validate() const { return planes != nullptr && capacity > 0 && count != nullptr && *count <= capacity; }
  bool is_full() const { return *count == capacity; }
  void add(const ClearancePlane& plane, const Vec3View& drawn_position) const {
    if (is_full()) settle(drawn_position);
    planes[(*count)++] = plane;
  }
  /// Projects each drawn vertex onto the planes that it is behind, one after the other, in sweeps until none is; then
  /// the list is empty. What is shared is moved once for all triangles around it.
  void settle(const Vec3View& drawn_position) const;
};

}  // namespace pleat
