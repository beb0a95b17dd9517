// The curved surface over the coarse mesh: what normal control and edge length control decide, and what is drawn.
#pragma once

#include <cstdint>

#include "components/column.h"

namespace pleat {

/// How the surface is shaped; the values are those of PLEAT_SURFACE_* in engine/pleat.h.
enum class SurfaceMode : std::uint32_t {
  kFlat = 0,
  kPn = 1,
  kPaper = 2,
  kPleat = 3,
  kPhong = 4,
  kSpherigon = 5,
  kArcPn = 6
};

/// Whether edge length control has a say.
constexpr bool has_folds(SurfaceMode mode) { return mode == SurfaceMode::kPaper || mode == SurfaceMode::kPleat; }

/// One element per normal of the garment or per edge (the others). Only where a cloth is drawn curved.
struct SurfaceColumns {
  Vec3Column normal;          // unit, as the garment counts normals
  Vec3Column fold;            // unit, per edge: direction in which its midpoint is moved
  Column<float> fold_height;  // m, per edge: how far; 0 where the edge is not short. Negative folds inward
  Column<float> fold_side;    // per edge, -1 .. 1: to which side of its curve it folds, inward, undecided or outward

  explicit SurfaceColumns(std::pmr::memory_resource* m) : normal(m), fold(m), fold_height(m), fold_side(m) {}
};

/// Scratch of fold relaxation, one element per edge of one cloth at a time.
struct FoldScratchView {
  Vec3View middle;     // m, where the edge's middle is now
  Vec3View pull;       // m, sum of what its segments ask of it, and of its last step
  float* half_length;  // m, of the chord that each half of the edge keeps
  float* freedom;      // 0 where there is no fold .. 1
};
struct FoldScratch {
  Vec3Column middle, pull;
  Column<float> half_length, freedom;

  explicit FoldScratch(std::pmr::memory_resource* m) : middle(m), pull(m), half_length(m), freedom(m) {}
  FoldScratchView view() { return {middle.view(), pull.view(), half_length.data(), freedom.data()}; }
};

/// The drawn vertices, in the order of the cloth's TessellationPattern.
struct DrawnColumns {
  Vec3Column position;       // m
  Vec3Column normal;         // unit, per shaded vertex
  Vec3Column tangent;        // unit, per shaded vertex, and
  Column<float> handedness;  // 1 or -1: both empty unless a cloth asks for tangents

  explicit DrawnColumns(std::pmr::memory_resource* m) : position(m), normal(m), tangent(m), handedness(m) {}
};

}  // namespace pleat
