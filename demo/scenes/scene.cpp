#include "demo/scenes/scene.h"

#include <chrono>
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

}  // namespace

Scene::Scene(const pleat_api& api, SceneDef scene_def, pleat_stage_fn stage, void* stage_user)
    : RunningScene(std::move(scene_def)), api_(api) {
  pleat_world_def world_def;
  api_.world_def_init(&world_def, sizeof world_def);
  copy(def().gravity.cast<float>(), world_def.gravity);
  copy(def().wind.cast<float>(), world_def.wind);
  world_def.gust = float(def().gust);
  world_def.gust_frequency = float(def().gust_frequency);
  world_def.gust_seed = def().gust_seed;
  world_def.log = keep_log;
  world_def.log_user = this;
  world_def.stage = stage;
  world_def.stage_user = stage_user;
  world_def.workers = def().workers;
  check(api_.world_create(&world_def, &world_), "world");
  try {
    create_garment();
    create_copies();
    create_fixed_bodies();
    settle();
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
    throw std::runtime_error(def().name + ": " + message);
  }
  throw InputError(def().name, message);
}

void Scene::create_garment() {
  pleat_garment_def garment;
  api_.garment_def_init(&garment, sizeof garment);
  garment.positions = def().garment.positions.data();
  garment.vertex_count = uint32_t(def().garment.vertex_count());
  garment.triangles = def().garment.triangles.data();
  garment.triangle_count = uint32_t(def().garment.triangle_count());
  garment.uvs = def().garment.uvs.empty() ? nullptr : def().garment.uvs.data();
  garment.pins = def().pins.empty() ? nullptr : def().pins.data();
  garment.pin_count = uint32_t(def().pins.size());
  check(api_.garment_create(world_, &garment, nullptr, &garment_), "garment");
}

void Scene::create_copies() {
  for (const Eigen::Vector3d& origin : def().origins) {
    pleat_cloth_def cloth;
    api_.cloth_def_init(&cloth, sizeof cloth);
    cloth.garment = garment_;
    cloth.settings = def().settings;
    if (def().layered) cloth.settings.layer = uint32_t(cloths_.size()) + 1;
    move_points(def().garment.positions, origin, moved_);
    cloth.positions = moved_.data();
    check(api_.cloth_create(world_, &cloth, &cloths_.emplace_back()), "cloth");
    check(api_.cloth_set_importance(world_, cloths_.back(), 1.0f / float(cloths_.size())), "importance");
    if (cloths_.size() > def().seen) check(api_.cloth_set_visible(world_, cloths_.back(), 0), "visible");
    for (size_t part = 0; part < body().touching; ++part) {
      pleat_collider_def part_def;
      api_.collider_def_init(&part_def, sizeof part_def);
      describe(body().capsules[part], origin.cast<float>(), part_def);
      body_parts_.push_back(create_collider(part_def));
    }
    if (def().body.positions.empty()) continue;
    TriangleMesh mesh = def().body;
    move_points(def().body.positions, origin, mesh.positions);
    pleat_collider_def body_def;
    api_.collider_def_init(&body_def, sizeof body_def);
    describe(mesh, body_def);
    meshes_.push_back(create_collider(body_def));
  }
}

pleat_collider Scene::create_collider(const pleat_collider_def& def) {
  pleat_collider collider;
  check(api_.collider_create(world_, &def, &collider), "collider");
  return collider;
}

void Scene::create_fixed_bodies() {
  for (const FixedBody& fixed : def().fixed) {
    pleat_collider_def part;
    api_.collider_def_init(&part, sizeof part);
    part.friction = fixed.friction;
    part.thickness = fixed.thickness;
    part.groups = fixed.groups;
    if (const auto* capsule = std::get_if<CapsulePose>(&fixed.shape)) {
      describe(*capsule, Eigen::Vector3f::Zero(), part);
    } else if (const auto* mesh = std::get_if<TriangleMesh>(&fixed.shape)) {
      describe(*mesh, part);
    } else {
      describe(std::get<RigidBody>(fixed.shape), part);
    }
    create_collider(part);
  }
}

void Scene::step() {
  const size_t parts = body().touching;
  for (size_t k = 0; def().motion && k < cloths_.size(); ++k) {
    const Eigen::Vector3f origin = def().origins[k].cast<float>();
    if (!def().pins.empty()) {
      move_points(pin_positions(), def().origins[k], moved_);
      check(api_.cloth_move_pins(world_, cloths_[k], moved_.data(), 0, uint32_t(def().pins.size())), "pins");
    }
    for (size_t part = 0; part < parts; ++part) {
      const Eigen::Vector3f a = body().capsules[part].a + origin, b = body().capsules[part].b + origin;
      check(api_.collider_move_capsule(world_, body_parts_[k * parts + part], a.data(), b.data()), "collider");
    }
    if (meshes_.empty()) continue;
    move_points(body().vertices, def().origins[k], moved_);
    check(api_.collider_move_mesh(world_, meshes_[k], moved_.data(), 0, uint32_t(def().body.vertex_count())),
          "collider");
  }
  const auto start = std::chrono::steady_clock::now();
  check(api_.world_step(world_, float(1.0 / def().rate)), "step");
  if (def().budget == 0.0) return;
  const std::chrono::duration<float, std::milli> cost = std::chrono::steady_clock::now() - start;
  check(api_.world_keep_budget(world_, float(def().budget), cost.count()), "budget");
}

pleat_cloth_info Scene::cloth_info(size_t cloth) const {
  pleat_cloth_info info{};
  info.size = sizeof info;
  check(api_.cloth_info(world_, cloths_[cloth], &info), "cloth");
  return info;
}

pleat_stats Scene::stats() const {
  pleat_stats stats;
  stats.size = sizeof stats;
  check(api_.world_stats(world_, &stats), "statistics");
  return stats;
}

void Scene::read_particles(size_t cloth, std::vector<float>& positions) const {
  positions.resize(def().garment.positions.size());
  check(api_.cloth_read_particles(world_, cloths_[cloth], positions.data(), nullptr,
                                  uint32_t(def().garment.vertex_count())),
        "particles");
}

}  // namespace pleat::demo
