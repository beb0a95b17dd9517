#include "components/pn_edge.h"
#include "engine/border.h"
#include "engine/calls.h"
#ifdef PLEAT_WITH_SMOOTHING
#include "systems/particle_normals.h"
#endif

namespace pleat::call {
namespace {

constexpr std::uint32_t kGrey = 0x808080ffu, kBlue = 0x3f7fd1ffu;
#ifdef PLEAT_WITH_SMOOTHING
constexpr std::uint32_t kYellow = 0xf2d21fffu, kOrange = 0xf27a1fffu, kPurple = 0x9a3fd1ffu;
#endif

struct Lines {
  pleat_line_fn draw;
  void* user;
  Vec3 origin;  // of what is drawn, m in the world

  void line(const Vec3& begin, const Vec3& end, std::uint32_t rgba) const {
    const Vec3 from = begin + origin, to = end + origin;
    const float a[3] = {from.x, from.y, from.z}, b[3] = {to.x, to.y, to.z};
    draw(a, b, rgba, user);
  }
};

void draw_edges(const Garment& g, ConstVec3View x, const Lines& lines) {
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    lines.line(x[g.edge_particle[0][e]], x[g.edge_particle[1][e]], kGrey);
  }
}

#ifdef PLEAT_WITH_SMOOTHING
void draw_normals(const Garment& g, ConstVec3View x, ConstVec3View normal, std::uint32_t rgba, const Lines& lines) {
  const float stick = 0.3f * g.mean_edge_length;
  for (std::uint32_t i = 0; i < g.particle_count; ++i) lines.line(x[i], x[i] + normal[i] * stick, rgba);
}

/// The normals as they would be without normal control.
void draw_base_normals(const World& world, const ClothRecord& cloth, const Lines& lines) {
  const Garment& g = cloth.garment();
  const ConstVec3View x = world.particles.position.view().from(cloth.particle_begin);
  Vec3Column base(std::pmr::new_delete_resource());
  Column<Vec4> sum(std::pmr::new_delete_resource());
  base.resize(g.normal_count), sum.resize(g.normal_count);
  ParticleNormals{.mode = SurfaceMode::kPn, .garment = &g, .position = x, .normal = base.view(), .sum = sum.data()}
      .run();
  draw_normals(g, x, base.view(), kYellow, lines);
}

/// From where the PN curve of each folded edge has its middle to where edge length control has put it.
void draw_folds(const World& world, const ClothRecord& cloth, const Lines& lines) {
  const Garment& g = cloth.garment();
  const ConstVec3View x = world.particles.position.view().from(cloth.particle_begin);
  const ConstVec3View n = world.surface.normal.view().from(cloth.normal_begin);
  const ConstVec3View fold = world.surface.fold.view().from(cloth.edge_begin);
  const float* height = world.surface.fold_height.data() + cloth.edge_begin;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    if (height[e] == 0.0f) continue;
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    const Vec3 middle = PnEdge(x[i], x[j], n[g.edge_normal[0][e]], n[g.edge_normal[1][e]]).middle();
    lines.line(middle, middle + fold[e] * height[e], kPurple);
  }
}
#endif

void draw_colliders(const World& world, const Lines& lines) {
  for (std::size_t i = 0; i < world.capsules.size(); ++i) {
    lines.line(world.capsules.next_a.view()[i], world.capsules.next_b.view()[i], kBlue);
  }
  for (const PlaneCollider& plane : world.planes) {  // a square of 1 m with the normal in its middle
    const Vec3 corner[] = {{0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {-0.5f, 0, -0.5f}, {-0.5f, 0, 0.5f}};
    for (int k = 0; k < 4; ++k) lines.line(plane.next.apply(corner[k]), plane.next.apply(corner[(k + 1) % 4]), kBlue);
    lines.line(plane.next.position, plane.next.apply({0, 0.25f, 0}), kBlue);
  }
  for (const MeshRecord& record : world.meshes) {
    const MeshCollider& mesh = record.mesh;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const std::uint32_t from = mesh.triangles[k], to = mesh.triangles[k % 3 == 2 ? k - 2 : k + 1];
      if (from < to) lines.line(mesh.next.view()[from], mesh.next.view()[to], kBlue);
    }
  }
}

}  // namespace

pleat_result world_debug_draw(const pleat_world* handle, uint32_t what, pleat_line_fn draw, void* user) {
  return guarded(as_world(handle), "world_debug_draw", [&] {
    const World& world = need_world(handle);
    if (draw == nullptr) refuse("draw is null");
    const Busy busy(world);
    for (const ClothRecord& cloth : world.clothes) {
      const Lines lines{draw, user, cloth.origin};
      const ConstVec3View x = world.particles.position.view().from(cloth.particle_begin);
      if (what & PLEAT_DEBUG_COARSE_EDGES) draw_edges(cloth.garment(), x, lines);
#ifdef PLEAT_WITH_SMOOTHING
      if (!cloth.visible) continue;
      const std::uint32_t mode = cloth.settings.surface;
      if (what & PLEAT_DEBUG_BASE_NORMALS) draw_base_normals(world, cloth, lines);
      if ((what & PLEAT_DEBUG_FORCE_NORMALS) && mode != PLEAT_SURFACE_FLAT) {
        draw_normals(cloth.garment(), x, world.surface.normal.view().from(cloth.normal_begin), kOrange, lines);
      }
      if ((what & PLEAT_DEBUG_EDGE_LENGTH) && has_folds(static_cast<SurfaceMode>(mode))) {
        draw_folds(world, cloth, lines);
      }
#endif
    }
    if (what & PLEAT_DEBUG_COLLIDERS) draw_colliders(world, {draw, user, {}});
  });
}

}  // namespace pleat::call
