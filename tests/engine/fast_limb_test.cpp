// A limb that crosses the cloth faster than substeps of the usual length can see.
#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_COLLISION

namespace pleat {
namespace {

constexpr float kSpeed = 20.0f, kRadius = 0.045f, kDt = 1.0f / 30;

/// The surface of a limb along x at height y: a bar of eight sides.
struct MeshLimb {
  std::vector<float> positions;
  std::vector<std::uint32_t> triangles;

  explicit MeshLimb(float y) {
    constexpr std::uint32_t kRings = 13, kSides = 8;
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      for (std::uint32_t k = 0; k < kSides; ++k) {
        const float angle = 6.2831853f * static_cast<float>(k) / kSides;
        const float x = -0.6f + 0.1f * static_cast<float>(ring);
        positions.insert(positions.end(), {x, y + kRadius * std::cos(angle), kRadius * std::sin(angle)});
      }
    }
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      for (std::uint32_t k = 0; k < kSides; ++k) {
        const std::uint32_t a = ring * kSides + k, b = ring * kSides + (k + 1) % kSides;
        triangles.insert(triangles.end(), {a, b, b + kSides, a, b + kSides, a + kSides});
      }
    }
    for (std::uint32_t k = 1; k + 1 < kSides; ++k) {
      const std::uint32_t last = (kRings - 1) * kSides;
      triangles.insert(triangles.end(), {0, k + 1, k, last, last + k, last + k + 1});
    }
  }
};

enum class Limb { kCapsule, kMesh };

/// A sheet that hangs from two corners, and a limb that goes up through it at 20 m/s and stops 12 cm above.
float cloth_above_limb(Limb kind, std::uint32_t substeps, std::uint64_t& fast_bodies, std::uint32_t& taken,
                       bool visible = true) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = substeps;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
  must(call::cloth_set_visible(scene, cloth, visible ? 1 : 0));
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def));
  float y = -0.55f;
  def.a[0] = -0.6f, def.b[0] = 0.6f;
  def.a[1] = def.b[1] = y;
  def.radius = kRadius;
  const MeshLimb start(y);
  if (kind == Limb::kMesh) {
    def.shape = PLEAT_COLLIDER_MESH;
    def.positions = start.positions.data(), def.vertex_count = static_cast<std::uint32_t>(start.positions.size() / 3);
    def.triangles = start.triangles.data(), def.triangle_count = static_cast<std::uint32_t>(start.triangles.size() / 3);
  }
  pleat_collider limb{};
  must(call::collider_create(scene, &def, &limb));
  taken = 0;
  for (int tick = 0; tick < 3; ++tick) {
    if (tick == 0) y += kSpeed * kDt;
    const float a[3] = {-0.6f, y, 0}, b[3] = {0.6f, y, 0};
    if (kind == Limb::kCapsule) {
      must(call::collider_move_capsule(scene, limb, a, b));
    } else {
      must(call::collider_move_mesh(scene, limb, MeshLimb(y).positions.data(), 0, def.vertex_count));
    }
    scene.step(1, kDt);
    taken = std::max(taken, scene.info(cloth).substeps);
  }
  fast_bodies = scene.stats().fast_bodies;
  // The sheet's middle row lies along the limb: above it, or left behind below.
  const std::vector<float> x = scene.particles(cloth);
  float lowest = 1e9f;
  for (std::uint32_t c = 2; c < 6; ++c)
    lowest = std::min(lowest, std::max(x[3 * (3 * 8 + c) + 1], x[3 * (4 * 8 + c) + 1]));
  return lowest - y;
}

TEST(FastLimb, AtTwentyMetresASecondTakesTheClothAlong) {
  for (const Limb kind : {Limb::kCapsule, Limb::kMesh}) {
    SCOPED_TRACE(kind == Limb::kMesh ? "mesh" : "capsule");
    std::uint64_t fast_bodies = 0;
    std::uint32_t taken = 0;
    EXPECT_GT(cloth_above_limb(kind, 0, fast_bodies, taken), 0.0f);
    EXPECT_GT(taken, 16u);  // 1/30 s usually takes 16
    // A mesh is seen from 15 mm on, not from half a limb: with the cloth thrown as fast again, at up to 28 m/s in both
    // ticks after, that is over the most.
    EXPECT_EQ(fast_bodies, kind == Limb::kMesh ? 2u : 0u);
  }
}

TEST(FastLimb, TakesTheClothAlongWhereNobodySeesIt) {
  for (const Limb kind : {Limb::kCapsule, Limb::kMesh}) {
    SCOPED_TRACE(kind == Limb::kMesh ? "mesh" : "capsule");
    std::uint64_t fast_bodies = 0;
    std::uint32_t taken = 0;
    EXPECT_GT(cloth_above_limb(kind, 0, fast_bodies, taken, false), 0.0f);
    EXPECT_GT(taken, 12u) << "more than a quarter";
  }
}

TEST(FastLimb, TooFewSubstepsBySettingAreReported) {
  for (const Limb kind : {Limb::kCapsule, Limb::kMesh}) {
    std::uint64_t fast_bodies = 0;
    std::uint32_t taken = 0;
    cloth_above_limb(kind, 4, fast_bodies, taken);
    EXPECT_EQ(taken, 4u);
    EXPECT_GT(fast_bodies, 0u);
  }
}

}  // namespace
}  // namespace pleat

#endif
