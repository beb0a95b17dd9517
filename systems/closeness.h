// How near two features of cloth are, on which side of each other, and whether one passed through the other on the way.
//   X. Provot, "Collision and Self-Collision Handling in Cloth Model Dedicated to Design Garments", 1997: four points
//   that move meet when they lie in one plane.
//   R. Bridson, R. Fedkiw, J. Anderson, "Robust Treatment of Collisions, Contact and Friction for Cloth Animation",
//   2002, section 6.
#pragma once

#include "components/near_pairs.h"
#include "components/vec3.h"

namespace pleat {

/// Of four points, the first feature's before the second's: sum of weight x = (point of the first) - (point of the
/// second). The weights of a feature sum to 1 and to -1.
struct Closeness {
  float weight[4];
  Vec3 normal;     // unit, out of the second feature to the side where the first belongs
  float distance;  // m, along it; negative: on the wrong side
};

/// How features at x, that were at `before` when the substep began, are to each other. False where they are not over
/// each other: a particle beside a face, edges past each other's ends or nearly parallel, anything without extent.
///   kParticleFace: particle x[0], face x[1] x[2] x[3]; side 1 is the face's front;
///   kEdges:        edges x[0] x[1] and x[2] x[3]; side 1 is where cross(x[1] - x[0], x[3] - x[2]) points.
/// A side that is known is kept while the features stay over each other. Else it becomes the one that they are on, or,
/// if they passed through each other in this substep, the one that they were on; the weights and the normal are then
/// those of the moment when they met. It becomes 0 with the answer false.
bool closeness(NearKind kind, const Vec3 (&x)[4], const Vec3 (&before)[4], float& side, Closeness& out);

}  // namespace pleat
