// What is near a mesh body is looked for once and held while the cloth hardly moves: that must not show.
#include <algorithm>

#include "components/wide.h"
#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_COLLISION

namespace pleat {
namespace {

/// Two tetrahedra side by side, `high` above their place and `away` beside it, as a mesh body.
std::vector<float> peaks(float high, float away) {
  constexpr Vec3 kCorners[] = {{-0.2f, -0.6f, -0.2f}, {0.2f, -0.6f, -0.2f}, {0, -0.6f, 0.3f}, {0, -0.1f, 0}};
  std::vector<float> x;
  for (const float aside : {-0.2f, 0.2f}) {
    for (const Vec3& p : kCorners) x.insert(x.end(), {p.x + aside + away, p.y + high, p.z});
  }
  return x;
}

pleat_collider add_peaks(Scene& scene, float away) {
  constexpr std::uint32_t kFaces[] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 4, 5, 6, 4, 7, 5, 5, 7, 6, 6, 7, 4};
  const std::vector<float> x = peaks(0, away);
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def));
  def.shape = PLEAT_COLLIDER_MESH;
  def.positions = x.data(), def.vertex_count = 8;
  def.triangles = kFaces, def.triangle_count = 8;
  pleat_collider collider{};
  must(call::collider_create(scene, &def, &collider));
  return collider;
}

/// A cloth that comes to rest on a body, into which another body moves, whose pins then jerk, and which the
/// first body then keeps further away.
struct Resting {
  Scene scene;
  pleat_cloth cloth = scene.cloth(scene.sheet(8));
  pleat_collider under = add_peaks(scene, 0), far = add_peaks(scene, 1.5f);

  void play(int tick) {
    if (tick >= 250 && tick < 290) {
      const std::vector<float> x = peaks(0.05f, 1.5f - 0.02f * static_cast<float>(tick - 249));
      must(call::collider_move_mesh(scene, far, x.data(), 0, 8));
    }
    if (tick == 300) {
      std::vector<float> pins(6);
      const std::vector<float> x = scene.particles(cloth);
      std::copy_n(x.begin(), 3, pins.begin()), std::copy_n(x.begin() + 21, 3, pins.begin() + 3);
      pins[1] += 0.02f, pins[4] -= 0.02f;
      must(call::cloth_move_pins(scene, cloth, pins.data(), 0, 2));
    }
    if (tick == 330) {
      pleat_collider_settings s{};
      s.size = sizeof s;
      must(call::collider_get(scene, under, &s));
      s.thickness = 0.03f;
      must(call::collider_set(scene, under, &s));
    }
    scene.step();
  }
};

TEST(HeldCandidates, AreLookedForAnewWhereTheWorkerHasAnotherClothAndTheBitsAreTheSame) {
  Resting alone, beside;
  beside.scene.cloth(beside.scene.sheet(5));
  std::uint64_t held = 0, touched = 0;
  const MeshCandidateColumns& kept = alone.scene.inside().workers.front().mesh_candidates;
  for (int tick = 0; tick < 400; ++tick) {
    const float* const anchor = kept.anchor.x.data();
    const float before = anchor == nullptr ? 0.0f : anchor[60];
    alone.play(tick);
    beside.play(tick);
    touched += alone.scene.stats().face_contacts > 0;
    held += kept.outlast_tick && kept.anchor.x[60] == before;
    ASSERT_EQ(alone.scene.particles(alone.cloth), beside.scene.particles(beside.cloth)) << tick;
  }
  EXPECT_GT(held, 60u);
  EXPECT_GT(touched, 200u);
}

/// Three cloths of one garment in one place, the last in many substeps, through which a body flies in a single tick:
/// what one worker has looked for with the first of them is of no use to the others.
TEST(HeldCandidates, AreNotThoseOfAnotherClothOfTheSameGarment) {
  const auto stage = [](std::uint32_t workers) {
    pleat_world_def def = Scene::default_def();
    def.workers = workers;
    std::fill_n(def.gravity, 3, 0.0f);
    return def;
  };
  struct Three {
    Scene scene;
    pleat_cloth last{};
    pleat_collider body = add_peaks(scene, 0);

    explicit Three(const pleat_world_def& def) : scene(def) {
      const pleat_garment garment = scene.sheet(12);
      pleat_cloth_settings s = Scene::default_settings();
      for (const std::uint32_t substeps : {1u, 1u, 16u}) {
        s.substeps = substeps;
        last = scene.cloth(garment, s);
      }
    }
    std::uint64_t play(int tick) {
      if (tick == 10) {
        const std::vector<float> x = peaks(1.2f, 0);
        must(call::collider_move_mesh(scene, body, x.data(), 0, 8));
      }
      scene.step();
      return scene.stats().face_contacts;
    }
  };
  Three one(stage(1)), three(stage(3));
  std::uint64_t touched = 0;
  for (int tick = 0; tick < 14; ++tick) {
    touched += one.play(tick);
    three.play(tick);
    ASSERT_EQ(one.scene.particles(one.last), three.scene.particles(three.last)) << tick;
  }
  EXPECT_GT(touched, 100u);
}

TEST(HeldCandidates, EveryVectorSetGivesTheSameBits) {
  Resting by_set[std::size(kVectorSets)];
  const VectorSet most = widest_vectors();
  for (int tick = 0; tick < 400; ++tick) {
    for (std::size_t k = 0; k < std::size(kVectorSets); ++k) {
      if (kVectorSets[k] > most) continue;
      vector_limit = kVectorSets[k];
      by_set[k].play(tick);
      ASSERT_EQ(by_set[k].scene.particles(by_set[k].cloth), by_set[0].scene.particles(by_set[0].cloth)) << tick;
    }
  }
}

}  // namespace
}  // namespace pleat

#endif
