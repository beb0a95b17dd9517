// Carries bodies along when a cloth is carried to another place: what jumps with it must not sweep through it.
#pragma once

#include "components/colliders.h"

namespace pleat {

/// A body that `motion` brings nearer to its next pose jumps with the cloth: its previous pose becomes the one that
/// `motion` makes of it. Others stay. Distances are squares summed over a capsule's two ends, a mesh's vertices, a
/// plane's origin.
/// Cost: O(capsules), O(vertices), O(1); no allocation. Errors: none.
void carry_along(const RigidMotion& motion, CapsuleColumns& capsules);
void carry_along(const RigidMotion& motion, MeshCollider& mesh);
void carry_along(const RigidMotion& motion, PlaneCollider& plane);

}  // namespace pleat
