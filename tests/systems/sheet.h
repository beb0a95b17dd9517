// Cloth without an engine: a garment and its particles, for systems to be run on by hand.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "components/garment.h"
#include "components/hinge_scratch.h"
#include "components/lanes.h"
#include "components/particles.h"
#include "components/shapes.h"
#include "components/vec4.h"
#include "systems/edge_ways.h"

namespace pleat {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Sheet {
  Garment garment;
  ParticleColumns particles;
  Vec4Columns packed;
  Vec3Column edge_way;
  HingeScratch hinge_scratch;
  std::uint32_t count;
  Vec3View position, velocity, force, previous, predicted;
  float* inverse_mass;
  float* mass;

  explicit Sheet(const Mesh& mesh, std::span<const std::uint32_t> pins = {}, float density = 0.2f)
      : garment(build_garment({mesh.positions, mesh.triangles, {}, pins, {}}, std::pmr::new_delete_resource())),
        particles(std::pmr::new_delete_resource()),
        packed(std::pmr::new_delete_resource()),
        edge_way(std::pmr::new_delete_resource()),
        hinge_scratch(std::pmr::new_delete_resource()),
        count(garment.particle_count) {
    for (Vec3Column* column :
         {&particles.position, &particles.velocity, &particles.force, &particles.previous, &particles.predicted}) {
      column->resize(count);
    }
    packed.make_room(count);
    edge_way.resize(garment.way_count);
    hinge_scratch.make_room(garment.hinge_count);
    particles.inverse_mass.resize(count);
    particles.mass.resize(count);
    position = particles.position.view(), velocity = particles.velocity.view(), force = particles.force.view();
    previous = particles.previous.view(), predicted = particles.predicted.view();
    inverse_mass = particles.inverse_mass.data(), mass = particles.mass.data();
    for (std::uint32_t i = 0; i < count; ++i) {
      position.set(i, mesh.positions[i]);
      mass[i] = density * garment.particle_area[i];
      inverse_mass[i] = garment.pinned[i] ? 0.0f : 1.0f / mass[i];
    }
  }

  /// Where the edges point at `previous`.
  ConstVec3View ways() {
    pack(previous, nullptr, count, packed.previous.data());
    EdgeWays{&garment, &packed.previous, edge_way.view()}.run();
    return edge_way.view();
  }
  /// system.run(...) on the packed positions.
  template <class System, class... Arguments>
  void run_packed(const System& system, Arguments&&... arguments) {
    pack(position, inverse_mass, count, packed.position.data());
    system.run(arguments...);
    unpack(packed.position.data(), count, position);
  }
  void clear_force() {
    for (std::uint32_t i = 0; i < count; ++i) force.set(i, {});
  }
};

/// Adds to each vector a random one with components up to `most`. The same for the same seed on every machine.
inline void shake(Vec3View v, std::uint32_t count, float most, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto next = [&] { return most * (static_cast<float>(random() >> 8) / 8388608.0f - 1.0f); };
  for (std::uint32_t i = 0; i < count; ++i) {
    const float x = next(), y = next(), z = next();
    v.add(i, {x, y, z});
  }
}

using Vec3d = Vec3T<double>;
inline Vec3d wide(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Sum of forces and of their torques about the origin, in double.
struct Totals {
  Vec3d force, torque;
  double size = 0.0;  // sum of |F| and |x| |F|: what rounding is to be measured by
};

inline Totals totals(ConstVec3View position, ConstVec3View force, std::uint32_t count) {
  Totals sum;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d x = wide(position[i]), f = wide(force[i]);
    sum.force += f;
    sum.torque += cross(x, f);
    sum.size += length(f) * (1.0 + length(x));
  }
  return sum;
}

}  // namespace pleat
