// A cloth with its curved surface, run stage by stage as the engine does.
#pragma once

#include <algorithm>
#include <memory_resource>
#include <random>
#include <vector>

#include "components/garment.h"
#include "components/shapes.h"
#include "systems/drawn_normals.h"
#include "systems/edge_length.h"
#include "systems/fold_sides.h"
#include "systems/particle_normals.h"
#include "systems/tessellation.h"

namespace pleat {

inline Garment garment_of(const Mesh& mesh, float crease_angle = 4.0f, std::span<const float> uvs = {}) {
  return build_garment({mesh.positions, mesh.triangles, uvs, {}, {}, crease_angle}, std::pmr::get_default_resource());
}

/// The skirt of the paper's size: 66 particles, 108 triangles.
inline Mesh skirt() {
  std::vector<Ring> rings;
  const std::uint32_t size[] = {8, 12, 14, 16, 16};
  for (std::uint32_t r = 0; r < 5; ++r) {
    const float row = static_cast<float>(r);
    rings.push_back({size[r], 0.14f + 0.0525f * row, 1.05f - 0.125f * row});
  }
  return make_rings(rings);
}

inline Mesh sheet(std::uint32_t n) { return make_grid({.rows = n, .columns = n, .alternate = true}); }

struct Surface {
  Garment garment;
  TessellationPattern pattern;
  Vec3Column position, normal, fold, drawn, drawn_normal;
  Column<float> fold_height, fold_side, bulge;
  Column<Vec4> normal_sum, place;
  FoldChoices choices;
  float kept = 0.0f;  // of the last frame's sides
  SurfaceMode mode = SurfaceMode::kPleat;

  explicit Surface(const Mesh& mesh, std::uint32_t level = 0) : Surface(garment_of(mesh), level) {}
  Surface(Garment&& cut, std::uint32_t level, std::pmr::memory_resource* m = std::pmr::get_default_resource())
      : garment(std::move(cut)),
        pattern(build_tessellation(garment, level, m)),
        position(m),
        normal(m),
        fold(m),
        drawn(m),
        drawn_normal(m),
        fold_height(m),
        fold_side(m),
        bulge(m),
        normal_sum(m),
        place(m),
        choices(m) {
    position.resize(garment.particle_count), place.resize(garment.particle_count);
    normal.resize(garment.normal_count);
    fold.resize(garment.edge_count);
    fold_height.resize(garment.edge_count), fold_side.resize(garment.edge_count);
    bulge.resize(garment.face_count);
    choices.make_room(garment.edge_count, garment.face_count);
    drawn.resize(pattern.vertex_count);
    drawn_normal.resize(pattern.shaded_count());
    normal_sum.resize(std::max(pattern.shaded_count() + kLanes, garment.normal_count));
    for (std::uint32_t i = 0; i < garment.particle_count; ++i) position.view().set(i, garment.rest_position.view()[i]);
  }

  template <class F>
  void move(F f) {
    for (std::uint32_t i = 0; i < garment.particle_count; ++i) position.view().set(i, f(position.view()[i]));
  }
  void jitter(float size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> d(-size, size);
    move([&](const Vec3& x) { return x + Vec3{d(random), d(random), d(random)}; });
  }

  ParticleNormals particle_normals() {
    return {mode, &garment, position.view(), normal.view(), normal_sum.data(), place.data()};
  }
  FoldSides fold_sides() { return {&garment, position.view(), normal.view(), &choices, kept, fold_side.data()}; }
  EdgeLength edge_length() {
    return {mode, &garment, position.view(), normal.view(), fold.view(), fold_height.data(), fold_side.data()};
  }
  Tessellation tessellation() {
    return {.mode = mode,
            .garment = &garment,
            .pattern = &pattern,
            .position = position.view(),
            .normal = normal.view(),
            .fold = fold.view(),
            .fold_height = fold_height.data(),
            .drawn_position = drawn.view(),
            .bulge = Tessellation::tells_bulge(mode) ? bulge.data() : nullptr};
  }
  DrawnNormals drawn_normals() { return {&pattern, drawn.view(), normal_sum.data(), drawn_normal.view()}; }

  /// The next run is `dt` seconds after the last one of `before`.
  void follow(const Surface& before, float dt) {
    std::ranges::copy(before.fold_side, fold_side.begin());
    kept = FoldSides::kept_after(dt);
  }
  void run() {
    particle_normals().run();
    if (mode == SurfaceMode::kPleat) fold_sides().run();
    if (has_folds(mode)) edge_length().run();
    tessellation().run();
    drawn_normals().run();
  }
};

}  // namespace pleat
