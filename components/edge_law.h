// How an edge of coarse cloth answers stretch and compression.
//   M. Oshita, A. Makinouchi, 2001, eq (1).
//   K.-J. Choi, H.-S. Ko, "Stable but Responsive Cloth", 2002: compressed cloth buckles, and then resists little.
#pragma once

namespace pleat {

/// Tension over stretch s = l/L, along a line through (`rest`, 0).
struct EdgeLine {
  float stiffness;  // N/m
  float rest;       // s without tension
};

/// Eq (1), k (s - 1), down to a compression of `buckling`. Past it the cloth between the ends would bulge, which coarse
/// triangles cannot: the edge yields instead, on a line a tenth as steep that joins the first. The surface draws the
/// bulge. Without it stiff edges in a fold hold each other apart, and the strain limit has to give way.
struct EdgeLaw {
  float stiffness = 0.0f;  // k, N/m
  float buckling = 1.0f;   // compression, fraction; 1: never buckles

  EdgeLine straight() const { return {stiffness, 1.0f}; }
  EdgeLine buckled() const { return {kShare * stiffness, 1.0f + (1.0f / kShare - 1.0f) * buckling}; }
  bool buckles(float stretch) const { return stretch < 1.0f - buckling; }
  EdgeLine at(float stretch) const { return buckles(stretch) ? buckled() : straight(); }

 private:
  static constexpr float kShare = 0.1f;
};

}  // namespace pleat
