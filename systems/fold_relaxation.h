// Fold relaxation: lets the folds of neighbouring edges settle against each other, so that where a fold lies and which
// way it points come from the faces around it and not from the two ends of its edge alone.
//   M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001, section 6,
//   asks for this; to relax the drawn cloth a little, particles fixed, after M. Mueller, N. Chentanez, "Wrinkle
//   Meshes", 2010.
//
//            V2               Edge length control gives each side of a face its length, but nothing keeps the lengths
//           /  \              across it: two folds that rise side by side leave the segment a-b between their middles
//          c----b             short, two that part stretch it, and the face looks quilted. The middles of folded edges
//         / \  / \            are therefore moved, anywhere in space, until the segments a-b, b-c, c-a of all faces
//       V0---a----V1          have half the length of the side that they run along, and the halves V0-a, a-V1, ... keep
//                             theirs.
//
// What is relaxed is E = 1/2 sum (length - wanted)^2 over these segments, by steps with momentum against its gradient.
// Nothing is remembered from frame to frame: the result is a continuous function of the particles, whatever the frame
// rate was.
#pragma once

#include "components/garment.h"
#include "components/surface.h"

namespace pleat {

/// Moves the folds that edge length control (SurfaceMode::kPleat) made. A fold of no height stays as it is, bit for
/// bit, and one of hardly any height hardly moves, so that nothing begins with a jump.
/// Reads:  garment faces, edges and rest lengths; position (P) m; normal (N) unit
/// Writes: fold (E) unit and fold_height (E) m; scratch (E)
/// Cost:   O(sweeps E), no allocation. Errors: none; folds stay bounded for any particles.
struct FoldRelaxation {
  std::uint32_t sweeps = 0;
  const Garment* garment = nullptr;
  ConstVec3View position;
  ConstVec3View normal;
  Vec3View fold;
  float* fold_height = nullptr;
  FoldScratchView scratch;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
