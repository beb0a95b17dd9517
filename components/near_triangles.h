// Triangles of a mesh body near the coarse face at hand, as the drawn surface is kept out of them.
#pragma once

#include "components/column.h"
#include "components/lanes.h"

namespace pleat {

/// Eight of a body's triangles, those of one leaf of its tree, side by side.
struct NearTriangles {
  Vec3Lanes corner[3];  // m
  Vec3Lanes low, high;  // m, of the boxes around them
  Vec3Lanes normal;     // unit, or zero
  Vec3Lanes aside[3];   // unit, in its plane, square to edge k and out of it; or zero
  Lanes above, below;   // m, from the face's plane to the nearest corner; zero where it is not on that side
  std::uint64_t meets;  // a byte for each: a bit for each of eight drawn triangles that may be too near
  std::uint32_t near;   // a bit for each that is near the face
  std::uint32_t leaf;
};

/// Scratch: what has been posed of one body, in the order in which it was asked for.
struct NearTriangleView {
  NearTriangles* posed = nullptr;
  std::uint32_t* place = nullptr;    // of a leaf: where it is, if that place is taken and holds it
  std::uint32_t* of_face = nullptr;  // the places of what is near the face at hand
  std::uint32_t capacity = 0;        // of leaves; those of a body beyond that are not seen

  bool validate() const { return capacity == 0 || (posed != nullptr && place != nullptr && of_face != nullptr); }
};

struct NearTriangleColumns {
  Column<NearTriangles> posed;
  Column<std::uint32_t> place, of_face;

  explicit NearTriangleColumns(std::pmr::memory_resource* m) : posed(m), place(m), of_face(m) {}
  /// For bodies of as many triangles. Throws std::bad_alloc.
  void make_room(std::size_t triangles) {
    const std::size_t leaves = (triangles + kLanes - 1) / kLanes;
    if (leaves <= posed.size()) return;
    posed.resize(leaves), place.resize(leaves), of_face.resize(leaves);
  }
  NearTriangleView view() {
    return {posed.data(), place.data(), of_face.data(), static_cast<std::uint32_t>(posed.size())};
  }
};

}  // namespace pleat
