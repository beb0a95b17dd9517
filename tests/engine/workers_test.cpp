// The same bits from any number of workers, whoever's threads they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr int kTicks = 24;
constexpr float kTick = 1.0f / 30.0f;  // s, so that what is calm sleeps before the end

/// What a host might have: it deals tasks out to new threads, backwards.
void host_parallel_for(pleat_task_fn task, std::uint32_t count, void* context, void* user) {
  const std::uint32_t workers = *static_cast<std::uint32_t*>(user);
  std::vector<std::thread> threads;
  for (std::uint32_t worker = 0; worker < workers; ++worker) {
    threads.emplace_back([=] {
      for (std::uint32_t i = count; i-- > 0;) {
        if (i % workers == worker) task(i, worker, context);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

/// Cloths of different sizes, integrators, surfaces and layers, against bodies, themselves and each other, in gusts;
/// one is carried elsewhere, one breaks and one sleeps.
struct Mess {
  std::vector<std::string> log;
  Scene scene;
  std::vector<pleat_cloth> cloths;
  std::uint64_t self_contacts = 0;  // of all ticks
#ifdef PLEAT_WITH_COLLISION
  pleat_collider ball;
#endif

  pleat_world_def def(std::uint32_t workers, pleat_parallel_for_fn parallel_for, void* user) {
    pleat_world_def def = Scene::default_def();
    def.log = [](std::uint32_t, const char* line, void* lines) {
      static_cast<std::vector<std::string>*>(lines)->push_back(line);
    };
    def.log_user = &log;
    def.workers = workers;
    def.parallel_for = parallel_for, def.parallel_user = user;
    def.wind[0] = 2.0f, def.gust = 1.0f;
    return def;
  }
  explicit Mess(std::uint32_t workers, pleat_parallel_for_fn parallel_for = nullptr, void* user = nullptr)
      : scene(def(workers, parallel_for, user)) {
    const pleat_garment garments[] = {scene.sheet(4), scene.sheet(6), scene.sheet(9)};
    for (std::uint32_t k = 0; k < 14; ++k) {
      pleat_cloth_settings s = Scene::default_settings();
      s.integrator = k % 5;
      s.drag_coefficient = 1.0f;
      s.level = k % 4;
#ifdef PLEAT_WITH_SMOOTHING
      s.surface = k % 7;
#endif
#ifdef PLEAT_WITH_COLLISION
      s.self_distance = k % 4 == 2 ? 0.02f : 0.0f;
      s.layer = k % 4 == 1 ? k / 4 + 1 : 0;
#endif
      if (k == 5)
        s.integrator = PLEAT_INTEGRATOR_EXPLICIT_EULER, s.stiffness = 1e5f, s.edge_damping = s.air_damping = 0.0f,
        s.stretch_limit = 1e6f, s.layer = 0;
      if (k == 12) s.drag_coefficient = 0.0f, s.sleep_speed = 1.0f, s.air_damping = 50.0f;
      cloths.push_back(scene.cloth(garments[k % 3], s));
    }
    cloths.push_back(scene.cloth(scene.sheet(18)));  // so deep that it has coarse levels
#ifdef PLEAT_WITH_COLLISION
    scene.sphere(0.2f, -0.6f, -0.1f, 0.2f);
    ball = scene.sphere(-0.8f, -0.2f, 0.0f, 0.15f);
    pleat_collider_def box;
    must(call::collider_def_init(&box, sizeof box));
    box.shape = PLEAT_COLLIDER_BOX;
    box.position[0] = -0.2f, box.position[1] = -0.5f, box.position[2] = 0.3f;
    for (float& half : box.half_extents) half = 0.15f;
    pleat_collider id{};
    must(call::collider_create(scene, &box, &id));
#endif
  }
  void step(int tick) {
#ifdef PLEAT_WITH_COLLISION
    const float at[] = {-0.8f + 0.2f * static_cast<float>(std::min(tick, 6)), -0.2f, 0.0f};
    must(call::collider_move_capsule(scene, ball, at, at));
#else
    (void)tick;
#endif
    const float here[] = {0, 0, 0}, there[] = {3, 0, 0};
    if (tick == 4) must(call::cloth_teleport(scene, cloths[3], here, there, nullptr));
    const float apart = 0.5f - 0.02f * static_cast<float>(tick);  // folds this one
    const float pins[] = {-apart, 0, -0.5f, apart, 0, -0.5f};
    must(call::cloth_move_pins(scene, cloths[2], pins, 0, 2));
    scene.step(1, kTick);
    self_contacts += scene.stats().self_contacts;
  }
  void run() {
    for (int tick = 1; tick <= kTicks; ++tick) step(tick);
  }
  std::vector<float> everything() {
    std::vector<float> all;
    for (const pleat_cloth cloth : cloths) {
      for (const std::vector<float>& part : {scene.particles(cloth), scene.vertices(cloth)}) {
        all.insert(all.end(), part.begin(), part.end());
      }
    }
    return all;
  }
  float lowest() {
    float y = 0.0f;
    for (const pleat_cloth cloth : cloths) {
      const std::vector<float> state = scene.particles(cloth);
      for (std::size_t i = 1; i < state.size() / 2; i += 3) y = std::min(y, state[i]);
    }
    return y;
  }
};

void expect_same_counts(pleat_stats a, pleat_stats b) {
  a.allocations = a.bytes = a.peak_bytes = b.allocations = b.bytes = b.peak_bytes = 0;  // more scratch
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST(Workers, AnyNumberGivesTheSameBits) {
  Mess alone(1);
  alone.run();
  const std::vector<float> expected = alone.everything();
  const float lowest = alone.lowest();
  EXPECT_LT(lowest, -0.2f);  // they have fallen
  EXPECT_GT(lowest, -2.0f);  // and hang
  const pleat_stats counts = alone.scene.stats();
  EXPECT_GT(counts.teleports, 0u);
  EXPECT_GT(counts.rollbacks, 0u);
  EXPECT_GT(counts.sleeping, 0u);
  EXPECT_FALSE(alone.log.empty());
#ifdef PLEAT_WITH_COLLISION
  EXPECT_GT(counts.particle_contacts, 0u);
  EXPECT_GT(counts.face_contacts, 0u);
  EXPECT_GT(alone.self_contacts, 0u);
#endif
  for (std::uint32_t workers : {2u, 3u, 8u}) {
    Mess own(workers);
    own.run();
    EXPECT_TRUE(same_bits(own.everything(), expected)) << workers;
    EXPECT_EQ(own.lowest(), lowest);
    expect_same_counts(own.scene.stats(), counts);
    EXPECT_EQ(own.log, alone.log);
    Mess hosted(workers, host_parallel_for, &workers);
    hosted.run();
    EXPECT_TRUE(same_bits(hosted.everything(), expected)) << workers << " of the host's";
    expect_same_counts(hosted.scene.stats(), counts);
    EXPECT_EQ(hosted.log, alone.log);
  }
}

TEST(Workers, AllocateNothingInATick) {
  Mess mess(3);
  for (int tick = 1; tick <= 8; ++tick) mess.step(tick);
  mess.log.reserve(100);
  const std::uint64_t before = global_allocations(), host = mess.scene.stats().allocations;
  for (int tick = 9; tick <= kTicks; ++tick) mess.step(tick);
  EXPECT_EQ(mess.scene.stats().allocations, host);
  EXPECT_EQ(global_allocations(), before);
}

TEST(Workers, ACarelessHostLosesNothing) {
  // Forgets every second task, and names a worker that is not there.
  const auto forgets = [](pleat_task_fn task, std::uint32_t count, void* context, void*) {
    for (std::uint32_t i = 0; i < count; i += 2) task(i, i % 3, context);
    if (count > 1) task(count + 5, 0, context);
  };
  Mess alone(1), careless(2, forgets);
  alone.run();
  careless.run();
  EXPECT_TRUE(same_bits(careless.everything(), alone.everything()));
}

}  // namespace
}  // namespace pleat
