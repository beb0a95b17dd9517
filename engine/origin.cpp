#include "engine/origin.h"

#include <cmath>

namespace pleat {
namespace {

constexpr float kCell = 8.0f;  // m

float whole_cells(float x) { return std::abs(x) > kCell ? kCell * std::round(x / kCell) : 0.0f; }

void shift(const Vec3View& points, std::size_t count, const Vec3& by) {
  for (std::size_t i = 0; i < count; ++i) points.set(i, points[i] - by);
}

}  // namespace

void recentre(World& world, ClothRecord& cloth) {
  const std::size_t particles = cloth.garment().particle_count, pins = cloth.garment().pins.size();
  const Vec3 place =
      pins != 0 ? world.pin_next.view()[cloth.pin_begin] : Vec3(world.particles.position.view()[cloth.particle_begin]);
  const Vec3 by{whole_cells(place.x), whole_cells(place.y), whole_cells(place.z)};
  if (by == Vec3{}) return;
  cloth.origin += by;
  for (Vec3Column* column : {&world.particles.position, &world.self.sought_at, &world.layers.sought_at}) {
    if (column->size() >= cloth.particle_begin + particles)
      shift(column->view().from(cloth.particle_begin), particles, by);
  }
  for (Vec3Column* column : {&world.pin_previous, &world.pin_next}) {
    shift(column->view().from(cloth.pin_begin), pins, by);
  }
}

}  // namespace pleat
