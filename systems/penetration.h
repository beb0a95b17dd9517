// How deep a cloth lies in the bodies: for whoever asks, no tick does.
#pragma once

#include <optional>

#include "components/colliders.h"
#include "components/garment.h"
#include "components/tessellation_pattern.h"
#include "systems/collision_bodies.h"

namespace pleat {

/// Depths below the bodies' own surfaces, what is kept from them aside; m, 0 outside.
struct PenetrationDepths {
  float particle = 0.0f;            // of free particles
  float pin = 0.0f;                 // of pinned ones and of any point of the edges between them
  float face = 0.0f, drawn = 0.0f;  // of any point of a coarse triangle and of a drawn one
  std::uint32_t pins_inside = 0;    // deeper than rounding
  struct Body {
    ColliderKind kind;
    std::uint32_t index;  // in the columns of its kind
  };
  std::optional<Body> deepest;  // that of the largest of the depths
};

/// Exact for capsules (a triangle's depth is the radius less its distance from the core) and half-spaces. In a mesh a
/// point is as deep as the nearest point of its surface is far; of a coarse triangle 45 points are asked, of the drawn
/// surface its vertices.
/// Reads:  all. Writes: nothing.
/// Cost:   O(bodies (P + F)) to see that nothing is near; no allocation. Errors: none.
struct Penetration {
  const Garment* garment = nullptr;
  ConstVec3View position;                        // (P) m
  const TessellationPattern* pattern = nullptr;  // null: the coarse triangles are what is drawn
  ConstVec3View drawn_position{};                // (V) m
  Vec3 origin{};                                 // of both, m in the world
  const CapsuleColumns* capsules = nullptr;
  const PlaneCollider* planes = nullptr;
  std::size_t plane_count = 0;
  const MeshCollider* const* meshes = nullptr;
  const CollisionBodies* bodies = nullptr;  // null: no meshes
  std::uint32_t collides_with = kAllGroups;
  float t = 0.0f;  // fraction of the tick at which the bodies are asked for

  bool validate() const;
  PenetrationDepths run() const;
};

}  // namespace pleat
