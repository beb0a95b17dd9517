#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "demo/scenes/body_motion.h"
#include "demo/scenes/triangle_mesh.h"
#include "engine/pleat.h"

namespace pleat::demo {

/// A plane, a box or a hull.
struct RigidBody {
  uint32_t kind;  ///< PLEAT_COLLIDER_PLANE, PLEAT_COLLIDER_BOX or PLEAT_COLLIDER_HULL
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  Eigen::Vector3f half_extents = Eigen::Vector3f::Zero();  ///< of a box
  std::vector<float> points{};                             ///< (N,3) of a hull
  TriangleMesh outline{};                                  ///< to draw and to measure; of a plane, a slab below it
};

/// A body that never moves. World space.
struct FixedBody {
  std::variant<CapsulePose, TriangleMesh, RigidBody> shape;
  float friction = 1.0f;   ///< multiplied by the cloth's
  float thickness = 0.0f;  ///< kept from it besides the cloth's
  uint32_t groups = 1;     ///< bits, see pleat_collider_def

  /// Null for a capsule.
  const TriangleMesh* outline() const {
    if (const auto* rigid = std::get_if<RigidBody>(&shape)) return &rigid->outline;
    return std::get_if<TriangleMesh>(&shape);
  }
};

/// Everything a scene is made of, read and checked: what a Scene is started from. Metres, seconds, world space.
struct SceneDef {
  std::string name;        ///< as the user asked for it: `drape_sphere:32`
  double rate = 60.0;      ///< frames a second
  uint32_t frames = 300;   ///< a run's length
  uint32_t workers = 1;    ///< threads that run cloths
  double budget = 0.0;     ///< ms that a tick may take, with detail given up from the last copy on; 0: all detail
  size_t seen = SIZE_MAX;  ///< copies that are in sight, the first ones
  double settle = 0.0;     ///< s of `motion` before frame 0: it begins at -settle
  Eigen::Vector3d gravity{0.0, -9.81, 0.0};
  Eigen::Vector3d wind{0.0, 0.0, 0.0};
  double gust = 0.0, gust_frequency = 2.0;  ///< m/s, Hz: as in pleat_world_def
  uint32_t gust_seed = 0;
  TriangleMesh garment;        ///< at rest, where it starts
  std::vector<uint32_t> pins;  ///< vertices that follow the body's hips
  pleat_cloth_settings settings{};
  std::vector<FixedBody> fixed;
  TriangleMesh body;  ///< a mesh that moves: its triangles, and where they are at first; may be empty
  BodyMotion motion;  ///< empty: nothing moves
  std::vector<Eigen::Vector3d> origins{Eigen::Vector3d::Zero()};  ///< a copy of garment, body and motion at each
  bool layered = false;                   ///< the copies are worn over each other, the first innermost
  bool crossings = false;                 ///< is about cloth that passes through itself: worth counting
  std::optional<double> ground;           ///< y of a floor to draw
  Eigen::Vector3d view{0.55, 0.25, 1.0};  ///< towards the camera, any length
};

}  // namespace pleat::demo
