#include "bench/validation/rig.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace pleat::bench {

pleat_cloth_settings bare_settings(const pleat_api& api) {
  pleat_cloth_def def;
  api.cloth_def_init(&def, sizeof def);
  pleat_cloth_settings& s = def.settings;
  s.integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
  s.buckling_strain = 1.0f;  // linear springs
  s.substeps = s.sweeps = 1;
  s.stiffness = s.bend_stiffness = 0.0f;
  s.edge_damping = s.bend_damping = s.air_damping = s.inner_friction = 0.0f;
  s.stretch_limit = 1.0f;
  s.surface = PLEAT_SURFACE_FLAT;
  s.level = 1;
  return s;
}

Rig::Rig(const pleat_api& api, const RigDef& def) : api_(api) {
  pleat_world_def world_def;
  need(api_.world_def_init(&world_def, sizeof world_def), "world");
  std::ranges::copy(def.gravity, world_def.gravity);
  world_def.log = keep_log;
  world_def.log_user = this;
  need(api_.world_create(&world_def, &world_), "world");
  try {
    create(def);
  } catch (...) {
    api_.world_destroy(world_);
    throw;
  }
}

Rig::~Rig() { api_.world_destroy(world_); }

void Rig::create(const RigDef& def) {
  pleat_garment_def garment_def;
  need(api_.garment_def_init(&garment_def, sizeof garment_def), "garment");
  garment_def.positions = def.mesh.positions.data();
  garment_def.vertex_count = uint32_t(def.mesh.vertex_count());
  garment_def.triangles = def.mesh.triangles.data();
  garment_def.triangle_count = uint32_t(def.mesh.triangle_count());
  garment_def.pins = def.pins.data();
  garment_def.pin_count = uint32_t(def.pins.size());
  garment_def.added_mass = def.added_mass.empty() ? nullptr : def.added_mass.data();
  report_.size = sizeof report_;
  need(api_.garment_create(world_, &garment_def, &report_, &garment_), "garment");

  pleat_cloth_def cloth_def;
  need(api_.cloth_def_init(&cloth_def, sizeof cloth_def), "cloth");
  cloth_def.garment = garment_;
  cloth_def.settings = def.settings;
  need(api_.cloth_create(world_, &cloth_def, &cloth_), "cloth");
  state_.resize(6 * def.mesh.vertex_count());
  if (!def.start.empty() || !def.start_motion.empty()) {
    const std::vector<float>& start = def.start.empty() ? def.mesh.positions : def.start;
    const float* motion = def.start_motion.empty() ? nullptr : def.start_motion.data();
    need(api_.cloth_write_particles(world_, cloth_, start.data(), motion, count()), "start");
  }
  if (!def.body.positions.empty()) {
    pleat_collider_def body;
    need(api_.collider_def_init(&body, sizeof body), "body");
    body.shape = PLEAT_COLLIDER_MESH;
    body.positions = def.body.positions.data();
    body.vertex_count = uint32_t(def.body.vertex_count());
    body.triangles = def.body.triangles.data();
    body.triangle_count = uint32_t(def.body.triangle_count());
    pleat_collider collider{};
    need(api_.collider_create(world_, &body, &collider), "body");
  }
  read();
}

void Rig::need(pleat_result result, const char* what) const {
  if (result != PLEAT_OK) throw std::runtime_error(std::string("the library refuses the ") + what + ": " + complaint_);
}

void Rig::keep_log(uint32_t, const char* line, void* user) { static_cast<Rig*>(user)->complaint_ = line; }

void Rig::read() {
  need(api_.cloth_read_particles(world_, cloth_, state_.data(), state_.data() + 3 * count(), count()), "particles");
}

void Rig::step(double dt, int ticks) {
  for (int i = 0; i < ticks; ++i) need(api_.world_step(world_, float(dt)), "step");
  read();
}

}  // namespace pleat::bench
