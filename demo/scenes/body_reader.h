#pragma once

#include <optional>
#include <string>

#include "demo/scenes/garment_reader.h"
#include "demo/scenes/json_value.h"
#include "demo/scenes/scene_def.h"
#include "demo/scenes/scene_files.h"

namespace pleat::demo {

/// Reads one of a scene's `colliders`. Throws InputError.
FixedBody read_fixed_body(const JsonValue& body, const SceneFile& file);

/// A scene's `motion`, and what a recorded clip tells about the rest of the scene.
struct MotionDef {
  BodyMotion motion;
  TriangleMesh body;               ///< that moves, if its body is a mesh
  double settle = 0.0;             ///< s of `motion` before frame 0
  std::optional<Figure> figure;    ///< of a clip
  std::optional<double> duration;  ///< of a clip, s
  std::optional<double> ground;    ///< y, m
};

/// Reads a scene's `motion`; the clip at the path `other_clip` takes its place, unless empty. Throws InputError.
MotionDef read_motion(const JsonValue& motion, const SceneFile& file, const std::string& other_clip);

}  // namespace pleat::demo
