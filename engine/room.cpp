#include "engine/room.h"

#include <algorithm>
#include <memory>

#include "engine/layers.h"

namespace pleat {
namespace {

/// All columns get the size, or, where memory runs out, none.
template <class... Columns>
void resize_together(std::size_t size, Columns&... columns) {
  (columns.reserve(size), ...);
  (columns.resize(size), ...);
}

void make_dynamics_room(World& world, const ClothRecord& cloth) {
  const std::size_t particles = world.particles.mass.size();
  if (cloth.settings.inner_friction > 0.0f || world.held.size() != 0) world.held.resize(particles);
  if (resists_bending(cloth) || world.bending.size() != 0) world.bending.resize(particles);
  if (cloth.settings.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4 || world.runge_kutta.start_velocity.size() != 0) {
    resize_together(particles, world.runge_kutta.start_velocity, world.runge_kutta.position_slope,
                    world.runge_kutta.velocity_slope);
  }
  if (cloth.settings.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER) {
    std::vector<std::unique_ptr<ImplicitMatrix>>& matrices = cloth.source->implicit;
    while (matrices.size() < world.workers.size()) {
      matrices.push_back(std::make_unique<ImplicitMatrix>(cloth.garment()));
    }
  }
}

void make_surface_room(World& world, const ClothRecord& cloth) {
  const bool curved = cloth.settings.surface != PLEAT_SURFACE_FLAT && cloth.pattern() != nullptr;
  const ClothRecord& last = world.clothes.back();
  const std::size_t normals = last.normal_begin + padded(last.garment().normal_count);
  const std::size_t edges = last.edge_begin + padded(last.garment().edge_count);
  if (curved || world.surface.normal.size() != 0) world.surface.normal.resize(normals);
  const bool folded = curved && has_folds(static_cast<SurfaceMode>(cloth.settings.surface));
  if (folded || world.surface.fold.size() != 0) {
    resize_together(edges, world.surface.fold, world.surface.fold_height, world.surface.fold_side);
  }
  if ((cloth.settings.tangents != 0 && cloth.pattern() != nullptr) || world.drawn.tangent.size() != 0) {
    resize_together(world.drawn.position.size(), world.drawn.tangent, world.drawn.handedness);
  }
}

/// For cloth that touches cloth.
void make_cloth_contact_room(World& world, const ClothRecord& cloth) {
  const bool touches_itself = cloth.settings.self_distance > 0.0f;
  if (touches_itself || world.self.pairs.size() != 0) {
    const std::size_t particles = world.particles.mass.size();
    at_least(world.self.sought_at, particles);
    at_least(world.self.pairs, SelfColumns::kPairsPerParticle * particles);
  }
  make_layer_room(world, cloth);
}

}  // namespace

void make_room(World& world, const ClothRecord& cloth) {
  make_dynamics_room(world, cloth);
  make_surface_room(world, cloth);
  make_cloth_contact_room(world, cloth);
  for (Worker& worker : world.workers) make_room(worker, world, cloth);
}

}  // namespace pleat
