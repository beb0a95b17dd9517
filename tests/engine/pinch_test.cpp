// Cloth that two bodies pinch: they come so close that there is no room for it, and part again.
#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_COLLISION

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 12;  // particles
constexpr float kRadius = 0.075f, kOpenGap = 0.15f, kStep = 1.0f / 60;

/// A sheet of 1 m2 that hangs in the plane z = 0 between two capsules.
class Pinch {
 public:
  /// One capsule rises along x by `slope`, the other falls.
  Pinch(float height, float slope) : height_(height), slope_(slope), cloth_(scene_.cloth(hanging_sheet(), settings())) {
    for (const int side : {0, 1}) {
      pleat_collider_def def;
      must(call::collider_def_init(&def, sizeof def));
      place(side, kOpenGap, def.a, def.b);
      def.radius = kRadius;
      must(call::collider_create(scene_, &def, &limbs_[side]));
    }
    x_ = scene_.particles(cloth_);
  }

  /// Half a second to the new gap between the surfaces, then `seconds` at rest.
  void close_to(float gap, float seconds) {
    const float from = gap_;
    const int moving = 30, ticks = moving + static_cast<int>(seconds * 60.0f);
    for (int i = 1; i <= ticks; ++i) {
      const float t = std::min(1.0f, static_cast<float>(i) / moving);
      gap_ = from + (gap - from) * t * t * (3.0f - 2.0f * t);
      for (const int side : {0, 1}) {
        float a[3], b[3];
        place(side, gap_, a, b);
        must(call::collider_move_capsule(scene_, limbs_[side], a, b));
      }
      step();
    }
  }

  void step() {
    const std::vector<float> before = x_;
    scene_.step(1, kStep);
    x_ = scene_.particles(cloth_);
    float sum = 0.0f;
    for (std::size_t i = 0; i < 3 * kSide * kSide; ++i) sum += (x_[i] - before[i]) * (x_[i] - before[i]);
    motion_ = std::sqrt(sum / (kSide * kSide));
    stretch_ = std::max(stretch_, longest_edge());
  }

  float motion() const { return motion_; }    // m, RMS of the last tick
  float stretch() const { return stretch_; }  // largest so far, fraction
  float off_plane() const {
    float most = 0.0f;
    for (std::size_t i = 0; i < kSide * kSide; ++i) most = std::max(most, std::abs(x_[3 * i + 2]));
    return most;
  }

 private:
  /// What hangs below the pinch soon stops swinging: all motion that is left is the contact's.
  static pleat_cloth_settings settings() {
    pleat_cloth_settings s = Scene::default_settings();
    s.air_damping = 2.0f;
    return s;
  }

  pleat_garment hanging_sheet() {
    std::vector<float> positions;
    std::vector<std::uint32_t> triangles, pins;
    for (std::uint32_t r = 0; r < kSide; ++r) {
      for (std::uint32_t c = 0; c < kSide; ++c) {
        const float spacing = 1.0f / (kSide - 1);
        positions.insert(positions.end(),
                         {spacing * static_cast<float>(c) - 0.5f, -spacing * static_cast<float>(r), 0.0f});
        const std::uint32_t i = r * kSide + c, below = i + kSide;
        if (r == 0) pins.push_back(i);
        if (r + 1 < kSide && c + 1 < kSide)
          triangles.insert(triangles.end(), {i, below, i + 1, i + 1, below, below + 1});
      }
    }
    pleat_garment_def def;
    must(call::garment_def_init(&def, sizeof def));
    def.positions = positions.data();
    def.vertex_count = kSide * kSide;
    def.triangles = triangles.data();
    def.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
    def.pins = pins.data();
    def.pin_count = kSide;
    pleat_garment garment{};
    must(call::garment_create(scene_, &def, nullptr, &garment));
    return garment;
  }

  void place(int side, float gap, float* a, float* b) const {
    const float sign = side == 0 ? -1.0f : 1.0f, rise = sign * slope_ * 0.6f, z = sign * (0.5f * gap + kRadius);
    a[0] = -0.6f, a[1] = height_ - rise, a[2] = z;
    b[0] = 0.6f, b[1] = height_ + rise, b[2] = z;
  }

  float longest_edge() {
    const Garment& g = scene_.inside().clothes[0].garment();
    const ConstVec3View x = scene_.inside().particles.position.view();
    float most = 0.0f;
    for (std::uint32_t e = 0; e < g.edge_count; ++e) {
      const float l = length(x[g.edge_particle[1][e]] - x[g.edge_particle[0][e]]);
      most = std::max(most, l / g.edge_rest_length[e] - 1.0f);
    }
    return most;
  }

  Scene scene_;
  float height_, slope_, gap_ = kOpenGap, motion_ = 0.0f, stretch_ = 0.0f;
  pleat_cloth cloth_;
  pleat_collider limbs_[2]{};
  std::vector<float> x_;
};

TEST(Pinch, OverlappingLimbsHoldTheClothCalmAndLetItGo) {
  for (const float gap : {0.0f, -0.01f, -0.02f}) {
    Pinch pinch(-0.4f, 0.0f);
    pinch.close_to(gap, 4.0f);
    SCOPED_TRACE(gap);
    float jitter = 0.0f;
    for (int i = 0; i < 60; ++i) {
      pinch.step();
      jitter = std::max(jitter, pinch.motion());
    }
    EXPECT_LT(jitter, 0.05e-3f);
    EXPECT_LT(pinch.stretch(), 0.08f);
    pinch.close_to(kOpenGap, 3.0f);
    EXPECT_LT(pinch.off_plane(), 0.03f);  // neither side was taken
  }
}

TEST(Pinch, CrossingLimbsStretchTheClothLittleAndHoldItCalm) {
  for (const float height : {-0.7f, -0.53f, -0.4f, -0.25f, -0.15f}) {  // from far below the pins to next to them
    for (const float slope : {0.1f, 0.4f}) {
      Pinch pinch(height, slope);
      pinch.close_to(-0.02f, 4.0f);
      SCOPED_TRACE(testing::Message() << "height " << height << ", slope " << slope);
      float jitter = 0.0f;
      for (int i = 0; i < 30; ++i) {
        pinch.step();
        jitter = std::max(jitter, pinch.motion());
      }
      EXPECT_LT(jitter, 0.05e-3f);
      EXPECT_LT(pinch.stretch(), 0.08f);
      pinch.close_to(kOpenGap, 1.0f);
      EXPECT_LT(pinch.off_plane(), 0.05f);  // neither side was taken
    }
  }
}

TEST(Pinch, CrossingLimbsThatAlsoCutThePinsDoNotTearTheClothThrough) {
  Pinch pinch(-0.4f, 0.85f);
  pinch.close_to(-0.02f, 4.0f);
  EXPECT_LT(pinch.stretch(), 0.08f);
  EXPECT_LT(pinch.motion(), 1e-3f);
  pinch.close_to(kOpenGap, 3.0f);
  EXPECT_LT(pinch.off_plane(), 0.1f);
}

}  // namespace
}  // namespace pleat

#endif
