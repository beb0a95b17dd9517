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

Vec3 whole_cells(const Vec3& a) { return {whole_cells(a.x), whole_cells(a.y), whole_cells(a.z)}; }

void recentre(World& world, ClothRecord& cloth) {
  const std::size_t particles = cloth.garment().particle_count, pins = cloth.garment().pins.size();
  const bool held = pins != 0 && cloth.garment().particle_area[cloth.garment().pins[0]] > 0.0f;
  const ConstVec3View position = world.particles.position.view().from(cloth.particle_begin);
  const Vec3 by = whole_cells(held ? Vec3(world.pin_next.view()[cloth.pin_begin]) : position[cloth.garment().stray_on]);
  if (by == Vec3{}) return;
  cloth.origin += by;
  for (Vec3Column* column : {&world.particles.position, &world.self.sought_at, &world.layers.sought_at}) {
    if (column->size() < cloth.particle_begin + particles) continue;
    shift(column->view().from(cloth.particle_begin), particles, by);
  }
  if (cloth.pattern() != nullptr && world.drawn.position.size() != 0) {  // of a cloth that sleeps on, not drawn anew
    shift(world.drawn.position.view().from(cloth.drawn_begin), cloth.pattern()->vertex_count, by);
  }
  for (Vec3Column* column : {&world.pin_previous, &world.pin_next}) {
    shift(column->view().from(cloth.pin_begin), pins, by);
  }
}

}  // namespace pleat
