#include "demo/scenes/scene.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

void copy(const Eigen::Vector3f& from, float (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

void describe(const CapsulePose& capsule, const Eigen::Vector3f& origin, pleat_collider_def& def) {
  def.shape = capsule.taper == 0.0f ? PLEAT_COLLIDER_CAPSULE : PLEAT_COLLIDER_TAPERED_CAPSULE;
  copy(capsule.a + origin, def.a);
  copy(capsule.b + origin, def.b);
  def.radius = capsule.radius;
  def.radius_b = capsule.radius + capsule.taper;
}

void describe(const TriangleMesh& mesh, pleat_collider_def& def) {
  def.shape = PLEAT_COLLIDER_MESH;
  def.positions = mesh.positions.data();
  def.vertex_count = uint32_t(mesh.vertex_count());
  def.triangles = mesh.triangles.data();
  def.triangle_count = uint32_t(mesh.triangle_count());
}

void describe(const RigidBody& rigid, pleat_collider_def& def) {
  def.shape = rigid.kind;
  copy(rigid.position, def.position);
  for (Eigen::Index k = 0; k < 4; ++k) def.rotation[k] = rigid.rotation.coeffs()[k];  // x, y, z, w
  copy(rigid.half_extents, def.half_extents);
  def.positions = rigid.points.data();
  def.vertex_count = uint32_t(rigid.points.size() / 3);
}

/// All points of `positions` (N,3) moved by `offset`.
void move_points(std::span<const float> positions, const Eigen::Vector3d& offset, std::vector<float>& moved) {
  moved.resize(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) moved[i] = float(positions[i] + offset[Eigen::Index(i % 3)]);
}

}  // namespace

Scene::Scene(const pleat_api& api, SceneDef def, pleat_stage_fn stage, void* stage_user)
    : api_(api), def_(std::move(def)) {
  pleat_world_def world_def;
  api_.world_def_init(&world_def, sizeof world_def);
  copy(def_.gravity.cast<float>(), world_def.gravity);
  copy(def_.wind.cast<float>(), world_def.wind);
  world_def.log = keep_log;
  world_def.log_user = this;
  world_def.stage = stage;
  world_def.stage_user = stage_user;
  check(api_.world_create(&world_def, &world_), "world");
  try {
    if (def_.motion) body_ = def_.motion(-def_.settle);
    from_first_hips_ = body_.hips.inverse();
    create_garment();
    create_copies();
    create_fixed_bodies();
    place_pins();
    const long settling = def_.motion ? std::lround(def_.settle * def_.rate) : 0;
    for (long tick = 1; tick <= settling; ++tick) {
      body_ = def_.motion(double(tick - settling) / def_.rate);
      place_pins();
      step();
    }
  } catch (...) {
    api_.world_destroy(world_);
    throw;
  }
}

Scene::~Scene() { api_.world_destroy(world_); }

void Scene::keep_log(uint32_t level, const char* line, void* user) {
  if (level == PLEAT_LOG_ERROR) static_cast<Scene*>(user)->complaint_ = line;
  if (level == PLEAT_LOG_WARNING) std::fprintf(stderr, "pleat: %s\n", line);
}

void Scene::check(pleat_result result, const char* what) const {
  if (result == PLEAT_OK) return;
  const std::string message = std::string(what) + ": " + (complaint_.empty() ? "refused" : complaint_);
  if (result == PLEAT_ERROR_MEMORY || result == PLEAT_ERROR_INTERNAL || result == PLEAT_ERROR_HANDLE) {
    throw std::runtime_error(def_.name + ": " + message);
  }
  throw InputError(def_.name, message);
}

void Scene::create_garment() {
  pleat_garment_def def;
  api_.garment_def_init(&def, sizeof def);
  def.positions = def_.garment.positions.data();
  def.vertex_count = uint32_t(def_.garment.vertex_count());
  def.triangles = def_.garment.triangles.data();
  def.triangle_count = uint32_t(def_.garment.triangle_count());
  def.uvs = def_.garment.uvs.empty() ? nullptr : def_.garment.uvs.data();
  def.pins = def_.pins.empty() ? nullptr : def_.pins.data();
  def.pin_count = uint32_t(def_.pins.size());
  check(api_.garment_create(world_, &def, nullptr, &garment_), "garment");
}

void Scene::create_copies() {
  for (const Eigen::Vector3d& origin : def_.origins) {
    pleat_cloth_def def;
    api_.cloth_def_init(&def, sizeof def);
    def.garment = garment_;
    def.settings = def_.settings;
    move_points(def_.garment.positions, origin, moved_);
    def.positions = moved_.data();
    check(api_.cloth_create(world_, &def, &cloths_.emplace_back()), "cloth");
    for (size_t part = 0; part < body_.touching; ++part) {
      pleat_collider_def part_def;
      api_.collider_def_init(&part_def, sizeof part_def);
      describe(body_.capsules[part], origin.cast<float>(), part_def);
      body_parts_.push_back(create_collider(part_def));
    }
    if (def_.body.positions.empty()) continue;
    TriangleMesh body = def_.body;
    move_points(def_.body.positions, origin, body.positions);
    pleat_collider_def body_def;
    api_.collider_def_init(&body_def, sizeof body_def);
    describe(body, body_def);
    meshes_.push_back(create_collider(body_def));
  }
}

pleat_collider Scene::create_collider(const pleat_collider_def& def) {
  pleat_collider collider;
  check(api_.collider_create(world_, &def, &collider), "collider");
  return collider;
}

void Scene::create_fixed_bodies() {
  for (const FixedBody& body : def_.fixed) {
    pleat_collider_def def;
    api_.collider_def_init(&def, sizeof def);
    def.friction = body.friction;
    def.thickness = body.thickness;
    if (const auto* capsule = std::get_if<CapsulePose>(&body.shape)) {
      describe(*capsule, Eigen::Vector3f::Zero(), def);
    } else if (const auto* mesh = std::get_if<TriangleMesh>(&body.shape)) {
      describe(*mesh, def);
    } else {
      describe(std::get<RigidBody>(body.shape), def);
    }
    create_collider(def);
  }
}

/// Pins keep their place in the hips frame.
void Scene::place_pins() {
  const Eigen::Isometry3d moved = body_.hips * from_first_hips_;
  pin_positions_.resize(3 * def_.pins.size());
  for (size_t i = 0; i < def_.pins.size(); ++i) {
    const float* rest = &def_.garment.positions[3 * def_.pins[i]];
    const Eigen::Vector3d now = moved * Eigen::Vector3d(rest[0], rest[1], rest[2]);
    for (size_t axis = 0; axis < 3; ++axis) pin_positions_[3 * i + axis] = float(now[Eigen::Index(axis)]);
  }
}

void Scene::pose_next() {
  ++frame_;
  if (!def_.motion) return;
  body_ = def_.motion(double(frame_) / def_.rate);
  place_pins();
}

void Scene::step() {
  const size_t parts = body_.touching;
  for (size_t k = 0; def_.motion && k < cloths_.size(); ++k) {
    const Eigen::Vector3f origin = def_.origins[k].cast<float>();
    if (!def_.pins.empty()) {
      move_points(pin_positions_, def_.origins[k], moved_);
      check(api_.cloth_move_pins(world_, cloths_[k], moved_.data(), 0, uint32_t(def_.pins.size())), "pins");
    }
    for (size_t part = 0; part < parts; ++part) {
      const Eigen::Vector3f a = body_.capsules[part].a + origin, b = body_.capsules[part].b + origin;
      check(api_.collider_move_capsule(world_, body_parts_[k * parts + part], a.data(), b.data()), "collider");
    }
    if (meshes_.empty()) continue;
    move_points(body_.vertices, def_.origins[k], moved_);
    check(api_.collider_move_mesh(world_, meshes_[k], moved_.data(), 0, uint32_t(def_.body.vertex_count())),
          "collider");
  }
  check(api_.world_step(world_, float(1.0 / def_.rate)), "step");
}

void Scene::advance() {
  pose_next();
  step();
}

pleat_cloth_info Scene::cloth_info(size_t cloth) const {
  pleat_cloth_info info;
  check(api_.cloth_info(world_, cloths_[cloth], &info), "cloth");
  return info;
}

void Scene::read_particles(size_t cloth, std::vector<float>& positions) const {
  positions.resize(def_.garment.positions.size());
  check(api_.cloth_read_particles(world_, cloths_[cloth], positions.data(), nullptr,
                                  uint32_t(def_.garment.vertex_count())),
        "particles");
}

}  // namespace pleat::demo
