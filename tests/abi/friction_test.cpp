// A patch of cloth on an inclined plane, through the C interface with the default settings: Coulomb's law.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

constexpr float kGravity = 9.81f, kTick = 1.0f / 60.0f, kFriction = 0.5f;
constexpr std::uint32_t kSide = 4, kParticles = kSide * kSide;

/// The patch lies on the plane, at the distance that contact keeps, and slides along its own x.
class Incline {
 public:
  explicit Incline(float angle) : down_{std::cos(angle), -std::sin(angle)} {
    pleat_world_def world_def = made(api().world_def_init);
    EXPECT_EQ(api().world_create(&world_def, &world_), pleat_result{PLEAT_OK});
    pleat_shape_def shape = made(api().shape_def_init);
    shape.rows = shape.columns = kSide;
    shape.width = shape.depth = 0.3f;
    std::vector<float> positions(3 * kParticles);
    std::uint32_t vertices = 0, count = 0;
    EXPECT_EQ(api().shape_size(&shape, &vertices, &count), pleat_result{PLEAT_OK});
    std::vector<std::uint32_t> triangles(3 * count);
    EXPECT_EQ(api().shape_build(&shape, positions.data(), triangles.data()), pleat_result{PLEAT_OK});
    pleat_cloth_def cloth_def = made(api().cloth_def_init);
    for (std::size_t i = 0; i < 3 * kParticles; i += 3) {
      const float x = positions[i], above = cloth_def.settings.thickness;
      positions[i] = x * down_[0] - above * down_[1];
      positions[i + 1] = x * down_[1] + above * down_[0];
    }
    pleat_garment_def garment_def = made(api().garment_def_init);
    garment_def.positions = positions.data();
    garment_def.vertex_count = vertices;
    garment_def.triangles = triangles.data();
    garment_def.triangle_count = count;
    EXPECT_EQ(api().garment_create(world_, &garment_def, nullptr, &cloth_def.garment), pleat_result{PLEAT_OK});
    cloth_def.settings.air_damping = 0.0f;
    EXPECT_EQ(api().cloth_create(world_, &cloth_def, &cloth_), pleat_result{PLEAT_OK});
    pleat_collider_def plane = made(api().collider_def_init);
    plane.shape = PLEAT_COLLIDER_PLANE;
    plane.rotation[2] = -std::sin(0.5f * angle), plane.rotation[3] = std::cos(0.5f * angle);
    plane.friction = kFriction / cloth_def.settings.friction;
    EXPECT_EQ(api().collider_create(world_, &plane, &plane_), pleat_result{PLEAT_OK});
  }
  ~Incline() { api().world_destroy(world_); }

  void step(int ticks) {
    for (int i = 0; i < ticks; ++i) EXPECT_EQ(api().world_step(world_, kTick), pleat_result{PLEAT_OK});
  }
  /// The plane goes along with the given speed down its own slope for a tick.
  void step_with_belt(int tick, float angle, float speed) {
    const float s = speed * kTick * static_cast<float>(tick);
    const float at[3] = {s * down_[0], s * down_[1], 0};
    const float turn[4] = {0, 0, -std::sin(0.5f * angle), std::cos(0.5f * angle)};
    EXPECT_EQ(api().collider_move_rigid(world_, plane_, at, turn), pleat_result{PLEAT_OK});
    step(1);
  }
  struct Mean {
    float place, speed;  // down the slope, m, m/s
  };
  Mean mean() const {
    std::vector<float> x(3 * kParticles), v(3 * kParticles);
    EXPECT_EQ(api().cloth_read_particles(world_, cloth_, x.data(), v.data(), kParticles), pleat_result{PLEAT_OK});
    Mean sum{};
    for (std::size_t i = 0; i < 3 * kParticles; i += 3) {
      sum.place += (x[i] * down_[0] + x[i + 1] * down_[1]) / kParticles;
      sum.speed += (v[i] * down_[0] + v[i + 1] * down_[1]) / kParticles;
    }
    return sum;
  }

 private:
  float down_[2];  // the slope's direction in x and y
  pleat_world* world_ = nullptr;
  pleat_cloth cloth_{};
  pleat_collider plane_{};
};

class Friction : public testing::Test {
 protected:
  void SetUp() override {
    if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "collision is compiled out";
  }
};

TEST_F(Friction, SticksBelowTheAngleOfFriction) {
  for (const float below : {0.02f, 0.2f}) {
    Incline incline(std::atan(kFriction) - below);
    const float start = incline.mean().place;
    incline.step(120);
    EXPECT_NEAR(incline.mean().place, start, 1e-3f) << below;
    EXPECT_NEAR(incline.mean().speed, 0.0f, 1e-3f) << below;
  }
}

TEST_F(Friction, AcceleratesByCoulombsLawAboveIt) {
  for (const float above : {0.1f, 0.3f}) {
    const float angle = std::atan(kFriction) + above;
    Incline incline(angle);
    incline.step(30);
    const Incline::Mean begin = incline.mean();
    incline.step(30);
    const Incline::Mean end = incline.mean();
    const float expected = kGravity * (std::sin(angle) - kFriction * std::cos(angle)), seconds = 30 * kTick;
    EXPECT_NEAR((end.speed - begin.speed) / seconds, expected, 0.02f * expected) << above;
    EXPECT_NEAR((end.place - begin.place) / seconds, 0.5f * (begin.speed + end.speed), 0.02f * end.speed) << above;
  }
}

TEST_F(Friction, AMovingPlaneTakesItAlong) {
  const float angle = 0.2f, speed = 0.3f;
  Incline incline(angle);
  for (int tick = 1; tick <= 60; ++tick) incline.step_with_belt(tick, angle, speed);
  EXPECT_NEAR(incline.mean().speed, speed, 0.02f * speed);
}

}  // namespace
}  // namespace pleat::abi
