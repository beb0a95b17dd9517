#include "demo/scenes/body_reader.h"

#include <cmath>
#include <numbers>

#include "demo/input_error.h"
#include "demo/motion/bvh.h"
#include "demo/motion/turn.h"
#include "demo/scenes/hull.h"
#include "demo/scenes/icosphere.h"

namespace pleat::demo {
namespace {

Eigen::Vector3f read_point(const JsonValue& value) { return value.vector().cast<float>(); }

double read_radius(const JsonValue& shape) { return shape.at("radius").number(1e-4, 1e3); }

CapsulePose read_tapered_capsule(const JsonValue& shape) {
  shape.allow_keys({"a", "b", "radius", "radius_b"});
  const double radius = read_radius(shape), taper = shape.at("radius_b").number(1e-4, 1e3) - radius;
  const CapsulePose capsule{read_point(shape.at("a")), read_point(shape.at("b")), float(radius), float(taper)};
  if ((capsule.b - capsule.a).norm() <= std::abs(capsule.taper)) shape.fail("one end holds the other: use a sphere");
  return capsule;
}

constexpr float kSlab = 3.0f;  // m, half the width of what is shown of a plane

RigidBody read_plane(const JsonValue& shape) {
  shape.allow_keys({"point", "normal"});
  const Eigen::Vector3f normal = read_point(shape.at("normal"));
  if (!(normal.norm() > 1e-6f)) shape.at("normal").fail("should not be zero");
  RigidBody plane{.kind = PLEAT_COLLIDER_PLANE, .position = read_point(shape.at("point"))};
  plane.rotation = turn_from_y(normal);
  plane.outline = make_hull(box_corners({0.0f, -0.5f, 0.0f}, {kSlab, 0.5f, kSlab}), plane.position, plane.rotation);
  return plane;
}

RigidBody read_box(const JsonValue& shape) {
  shape.allow_keys({"center", "size", "axis", "degrees"});
  RigidBody box{.kind = PLEAT_COLLIDER_BOX, .position = read_point(shape.at("center"))};
  box.half_extents = 0.5f * shape.at("size").vector(1e-3, 1e3).cast<float>();
  if (const auto degrees = shape.find("degrees")) {
    const Eigen::Vector3f axis = read_point(shape.at("axis"));
    if (!(axis.norm() > 1e-6f)) shape.at("axis").fail("should not be zero");
    box.rotation = Eigen::AngleAxisf(float(degrees->number(-360.0, 360.0)) * std::numbers::pi_v<float> / 180.0f,
                                     axis.normalized());
  }
  box.outline = make_hull(box_corners(Eigen::Vector3f::Zero(), box.half_extents), box.position, box.rotation);
  return box;
}

RigidBody read_hull(const JsonValue& shape) {
  shape.allow_keys({"points"});
  RigidBody hull{.kind = PLEAT_COLLIDER_HULL};
  std::vector<Eigen::Vector3f> points;
  for (const JsonValue& point : shape.at("points").items()) points.push_back(read_point(point));
  if (points.size() < 4 || points.size() > 64) shape.at("points").fail("should have 4 to 64 points");
  for (const Eigen::Vector3f& p : points) hull.points.insert(hull.points.end(), p.begin(), p.end());
  hull.outline = make_hull(points, hull.position, hull.rotation);
  if (hull.outline.triangles.empty()) shape.at("points").fail("lie in a plane");
  return hull;
}

void drop_frames(Clip& clip, size_t dropped) {
  clip.frames.erase(clip.frames.begin(), clip.frames.begin() + ptrdiff_t(dropped * clip.skeleton.channel_count));
}

constexpr double kSettle = 1.0;  // s

/// A clip on a figure fitted to it. Without `first_frame` it begins where its calibration ends.
MotionDef play(Clip clip, std::optional<size_t> first_frame, double settle) {
  MotionDef def;
  def.settle = settle;
  def.figure = fit_figure(clip);
  drop_frames(clip, first_frame.value_or(calibration_frames(*def.figure, clip)));
  def.ground = ground_height(*def.figure, clip);
  def.duration = clip.duration();
  def.motion = make_clip_motion(std::move(clip), *def.figure);
  return def;
}

MotionDef read_clip(const JsonValue& value, const SceneFile& file) {
  value.allow_keys({"file", "first_frame", "settle"});
  const std::string name = value.at("file").text();
  Clip clip = read_bvh(*file.open(name), file.path_of(name));
  std::optional<size_t> first_frame;
  if (const auto first = value.find("first_frame")) first_frame = first->integer(0, uint32_t(clip.frame_count()) - 1);
  const auto settle = value.find("settle");
  return play(std::move(clip), first_frame, settle ? settle->number(0.0, 60.0) : kSettle);
}

/// A mesh and where its vertices go. The hips are all vertices in a box, in the first sample.
MotionDef read_sequence(const JsonValue& sequence, const SceneFile& file) {
  sequence.allow_keys({"obj", "points", "rate", "hips", "settle"});
  MotionDef def;
  def.body = read_mesh_file(sequence.at("obj"), file);
  const std::string points = sequence.at("points").text();
  PointCache cache = read_point_cache(*file.open(points), file.path_of(points));
  if (cache.points != def.body.vertex_count()) {
    sequence.at("points").fail("holds " + std::to_string(cache.points) + " points, the mesh has " +
                               std::to_string(def.body.vertex_count()) + " vertices");
  }
  const double rate = sequence.at("rate").number(1.0, 1000.0);
  sequence.at("hips").allow_keys({"low", "high"});
  const Eigen::Vector3f low = read_point(sequence.at("hips").at("low")),
                        high = read_point(sequence.at("hips").at("high"));
  std::vector<uint32_t> hips;
  for (uint32_t v = 0; v < cache.points; ++v) {
    const Eigen::Array3f p = Eigen::Map<const Eigen::Array3f>(cache.positions.data() + 3 * v);
    if ((p >= low.array()).all() && (p <= high.array()).all()) hips.push_back(v);
  }
  if (hips.size() < 3) sequence.at("hips").fail("holds fewer than 3 vertices of the body");
  def.duration = double(cache.samples - 1) / rate;
  if (const auto settle = sequence.find("settle")) def.settle = settle->number(0.0, 60.0);
  def.motion = make_sequence_motion(std::move(cache), rate, std::move(hips));
  return def;
}

}  // namespace

FixedBody read_fixed_body(const JsonValue& body, const SceneFile& file) {
  body.allow_keys({"sphere", "capsule", "tapered_capsule", "plane", "box", "hull", "icosphere", "obj", "friction",
                   "thickness", "groups"});
  const std::string kind =
      body.one_of({"sphere", "capsule", "tapered_capsule", "plane", "box", "hull", "icosphere", "obj"});
  const JsonValue shape = body.at(kind);
  FixedBody fixed;
  if (const auto friction = body.find("friction")) fixed.friction = float(friction->number(0.0, 10.0));
  if (const auto thickness = body.find("thickness")) fixed.thickness = float(thickness->number(0.0, 1.0));
  if (const auto groups = body.find("groups")) fixed.groups = groups->integer(0, 0xffffffff);
  if (kind == "sphere") {
    shape.allow_keys({"center", "radius"});
    const Eigen::Vector3f center = read_point(shape.at("center"));
    fixed.shape = CapsulePose{center, center, float(read_radius(shape))};
  } else if (kind == "capsule") {
    shape.allow_keys({"a", "b", "radius"});
    fixed.shape = CapsulePose{read_point(shape.at("a")), read_point(shape.at("b")), float(read_radius(shape))};
  } else if (kind == "tapered_capsule") {
    fixed.shape = read_tapered_capsule(shape);
  } else if (kind == "plane") {
    fixed.shape = read_plane(shape);
  } else if (kind == "box") {
    fixed.shape = read_box(shape);
  } else if (kind == "hull") {
    fixed.shape = read_hull(shape);
  } else if (kind == "icosphere") {
    shape.allow_keys({"level", "center", "radius"});
    fixed.shape = make_icosphere(shape.at("level").integer(0, 6), shape.at("center").vector(), read_radius(shape));
  } else {
    fixed.shape = read_mesh_file(shape, file);
  }
  return fixed;
}

MotionDef read_motion(const JsonValue& motion, const SceneFile& file, const std::string& other_clip) {
  motion.allow_keys({"kick", "clip", "sequence"});
  const std::string kind = motion.one_of({"kick", "clip", "sequence"});
  if (!other_clip.empty()) return play(load_bvh(other_clip), std::nullopt, kSettle);
  const JsonValue value = motion.at(kind);
  if (kind == "clip") return read_clip(value, file);
  if (kind == "sequence") return read_sequence(value, file);
  value.allow_keys({"thigh", "knee"});
  MotionDef def;
  def.motion = make_kick(value.at("thigh").number(-180.0, 180.0), value.at("knee").number(-180.0, 180.0));
  return def;
}

}  // namespace pleat::demo
