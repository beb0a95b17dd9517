#include "systems/surface_clearance.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "systems/closest_points.h"
#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

constexpr float kClearance = 0.0025f;
constexpr float kRounding = 2e-6f;  // m

CapsulePose capsule(const Vec3& a, const Vec3& b, float radius) {
  return {.a = a, .b = b, .step_a = {}, .step_b = {}, .radius = radius, .friction = 1.0f, .index = 0};
}

struct Clearance {
  Surface& surface;
  std::vector<CapsulePose> capsules;
  std::vector<PlaneCollider> half_spaces = {};
  std::vector<ClearancePlane> planes = std::vector<ClearancePlane>(4096);
  std::uint32_t count = 0;

  SurfaceClearance system() {
    return {.garment = &surface.garment,
            .pattern = &surface.pattern,
            .position = surface.position.view(),
            .capsules = capsules.data(),
            .capsule_count = static_cast<std::uint32_t>(capsules.size()),
            .half_spaces = half_spaces.data(),
            .half_space_count = half_spaces.size(),
            .clearance = kClearance,
            .planes = {planes.data(), static_cast<std::uint32_t>(planes.size()), &count},
            .drawn_position = surface.drawn.view()};
  }
};

/// From the core to the drawn triangles, less the radius: by dense sampling of the core, independent of the system.
float least_distance(const Surface& s, ConstVec3View x, const CapsulePose& c) {
  constexpr int kSamples = 64;
  float least = std::numeric_limits<float>::max();
  for (std::size_t t = 0; t < s.pattern.indices.size(); t += 3) {
    const Vec3 p = x[s.pattern.indices[t]], q = x[s.pattern.indices[t + 1]], r = x[s.pattern.indices[t + 2]];
    for (int i = 0; i <= kSamples; ++i) {
      const Vec3 core = lerp(c.a, c.b, static_cast<float>(i) / kSamples);
      least = std::min(least, length(closest_on_triangle(core, p, q, r).point(p, q, r) - core) -
                                  (c.radius + c.taper * static_cast<float>(i) / kSamples));
    }
  }
  return least;
}

std::vector<Vec3> drawn(const Surface& s) {
  std::vector<Vec3> x;
  for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) x.push_back(s.drawn.view()[v]);
  return x;
}

/// A sheet of 1 m whose drawn surface sags towards a capsule under it, by at most `sag` between the particles.
struct SaggingSheet : Surface {
  explicit SaggingSheet(float sag, std::uint32_t level = 0) : Surface(sheet(5), level) {
    run();
    for (std::uint32_t v = garment.particle_count; v < pattern.vertex_count; ++v) {
      const Vec3 x = drawn.view()[v];
      drawn.view().set(v, x - Vec3{0.0f, sag * (0.6f + 0.4f * std::sin(40.0f * x.x) * std::cos(30.0f * x.z)), 0.0f});
    }
  }
};

// The axis lies 5 mm more than the radius under the sheet: what contact keeps.
CapsulePose log_under_sheet() { return capsule({-0.3f, -0.085f, 0.02f}, {0.31f, -0.085f, -0.1f}, 0.08f); }

TEST(SurfaceClearance, DrawnTrianglesKeepTheClearanceAtEveryLevelProperty) {
  for (const std::uint32_t level : {0u, 1u, 2u, 5u, 8u}) {
    SaggingSheet s(0.03f, level);
    Clearance c{s, {log_under_sheet()}};
    ASSERT_LT(least_distance(s, s.drawn.view(), c.capsules[0]), -0.01f);
    const SurfaceClearance system = c.system();
    ASSERT_TRUE(system.validate());
    system.run();
    EXPECT_GE(least_distance(s, s.drawn.view(), c.capsules[0]), kClearance - kRounding) << "level " << level;
  }
}

TEST(SurfaceClearance, RandomCapsulesBelowACurvedClothProperty) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> along(-0.4f, 0.4f), radius(0.02f, 0.15f), tilt(0.0f, 0.2f);
  for (int trial = 0; trial < 60; ++trial) {
    SaggingSheet s(0.05f);
    const float r = radius(random), top = -r - 0.005f;
    Clearance c{s,
                {capsule({along(random), top - tilt(random), along(random)}, {along(random), top, along(random)}, r)}};
    CapsulePose& body = c.capsules[0];
    if (trial % 2 == 0) body.taper = std::clamp(0.1f * along(random), -r, 0.5f * length(body.b - body.a));
    if (body.taper > 0.0f) body.b.y -= body.taper;
    c.system().run();
    EXPECT_GE(least_distance(s, s.drawn.view(), c.capsules[0]), kClearance - kRounding) << "trial " << trial;
  }
}

TEST(SurfaceClearance, DrawnVerticesStayAboveAPlaneNextToACapsule) {
  SaggingSheet s(0.05f);
  PlaneCollider ground;
  ground.next.position = {0, -0.3f, 0};  // where it will be counts later
  ground.previous.position = {0, -0.02f, 0};
  Clearance c{s, {log_under_sheet()}, {ground}};
  SurfaceClearance system = c.system();
  system.t = 0.0f;
  system.run();
  EXPECT_GE(least_distance(s, s.drawn.view(), c.capsules[0]), kClearance - kRounding);
  float lowest = 1.0f;
  for (const Vec3& x : drawn(s)) lowest = std::min(lowest, x.y);
  EXPECT_NEAR(lowest, -0.02f + kClearance, kRounding);
}

TEST(SurfaceClearance, SurfaceThatFellBehindTheCoreReturnsToItsSide) {
  SaggingSheet s(0.25f);  // three radii
  Clearance c{s, {log_under_sheet()}};
  c.system().run();
  EXPECT_GE(least_distance(s, s.drawn.view(), c.capsules[0]), kClearance - kRounding);
  for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) {
    const Vec3 x = s.drawn.view()[v];
    if (std::abs(x.x) < 0.2f && std::abs(x.z + 0.04f) < 0.03f) {
      EXPECT_GT(x.y, -0.01f);
    }
  }
}

TEST(SurfaceClearance, BothSidesOfAPinchAreKept) {
  SaggingSheet s(0.03f);
  Clearance c{s, {log_under_sheet(), capsule({-0.1f, 0.085f, -0.3f}, {0.1f, 0.085f, 0.3f}, 0.08f)}};
  for (std::uint32_t v = s.garment.particle_count; v < s.pattern.vertex_count; ++v) {
    if (s.drawn.view()[v].z > 0.0f) s.drawn.view().add(v, {0.0f, 0.06f, 0.0f});
  }
  c.system().run();
  for (const CapsulePose& body : c.capsules) {
    EXPECT_GE(least_distance(s, s.drawn.view(), body), kClearance - 2e-5f);
  }
}

TEST(SurfaceClearance, OverlappingCapsulesAreBothKept) {
  SaggingSheet s(0.04f);
  Clearance c{s, {log_under_sheet(), capsule({0.0f, -0.085f, -0.3f}, {0.0f, -0.085f, 0.3f}, 0.08f)}};
  c.system().run();
  for (const CapsulePose& body : c.capsules) {
    EXPECT_GE(least_distance(s, s.drawn.view(), body), kClearance - 2e-5f);
  }
}

TEST(SurfaceClearance, LegalSurfacesAreUntouchedBitForBit) {
  // A round sleeve close around a capsule, curved outward: every vertex is outside already, those at particles too.
  for (const SurfaceMode mode : {SurfaceMode::kFlat, SurfaceMode::kPn, SurfaceMode::kPleat}) {
    Surface s(make_rings(std::vector<Ring>{{12, 0.12f, 0.3f}, {12, 0.12f, 0.2f}, {12, 0.12f, 0.1f}}));
    s.mode = mode;
    s.run();
    const std::vector<Vec3> before = drawn(s);
    Clearance c{s, {capsule({0, 0, 0}, {0, 0.4f, 0}, 0.11f)}};
    c.system().run();
    EXPECT_EQ(before, drawn(s));
  }
  SaggingSheet s(0.03f);  // sags, but not as far as this one
  const std::vector<Vec3> before = drawn(s);
  Clearance c{s, {capsule({-0.3f, -0.2f, 0}, {0.3f, -0.2f, 0}, 0.1f)}};
  c.system().run();
  EXPECT_EQ(before, drawn(s));
}

TEST(SurfaceClearance, ParticlesOutsideStayWhereTheyAre) {
  SaggingSheet s(0.04f);
  Clearance c{s, {log_under_sheet()}};
  c.system().run();
  for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) EXPECT_EQ(s.drawn.view()[i], s.position.view()[i]);
}

TEST(SurfaceClearance, MovesNoVertexFurtherThanItFellProperty) {
  // No shell around the body: what was not behind the surface by more than the tangent gap stays.
  SaggingSheet s(0.03f);
  const std::vector<Vec3> before = drawn(s);
  Clearance c{s, {log_under_sheet()}};
  c.system().run();
  for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) {
    const Vec3 x = s.drawn.view()[v], moved = x - before[v];
    EXPECT_LT(length(moved), 0.035f);
    EXPECT_LT(x.y, 0.005f);  // the sheet itself is at 0
  }
}

TEST(SurfaceClearance, ContinuousInTheMotionOfTheCapsuleProperty) {
  constexpr float kStep = 1e-4f;
  std::vector<Vec3> last;
  float largest = 0.0f;
  for (int i = 0; i <= 1500; ++i) {  // rises from out of reach up to contact and slides along
    SaggingSheet s(0.03f);
    const float shift = kStep * static_cast<float>(i);
    CapsulePose body = log_under_sheet();
    const float rise = std::max(-0.06f + shift, -0.06f) < 0.0f ? -0.06f + shift : 0.0f;
    const Vec3 move{0.0f, rise, shift};
    body.a += move, body.b += move;
    Clearance c{s, {body}};
    c.system().run();
    const std::vector<Vec3> now = drawn(s);
    for (std::size_t v = 0; v < last.size(); ++v) largest = std::max(largest, length(now[v] - last[v]));
    last = now;
  }
  EXPECT_GT(largest, 0.0f);
  EXPECT_LT(largest, 20.0f * kStep);  // a pop would be millimetres
}

TEST(SurfaceClearance, AListTooSmallIsSettledInTurn) {
  SaggingSheet s(0.03f);
  Clearance c{s, {log_under_sheet()}};
  c.planes.resize(7);
  c.system().run();
  EXPECT_GE(least_distance(s, s.drawn.view(), c.capsules[0]), kClearance - kRounding);
}

TEST(SurfaceClearance, BulgesThatAreToldAreAsGoodAsMeasuredOnes) {
  for (const std::uint32_t level : {0u, 3u}) {
    for (const std::size_t room : {4096u, 7u}) {
      std::vector<std::vector<Vec3>> found;
      for (const bool told : {false, true}) {
        Surface s(skirt(), level);
        s.jitter(0.02f, 4);
        s.run();
        const std::vector<Vec3> before = drawn(s);
        Clearance c{s, {capsule({0, 1.1f, 0}, {0, 0.8f, 0}, 0.12f), capsule({0.1f, 1, 0}, {0.2f, 0.5f, 0}, 0.1f)}};
        c.planes.resize(room);
        SurfaceClearance system = c.system();
        system.bulge = told ? s.bulge.data() : nullptr;
        system.run();
        found.push_back(drawn(s));
        EXPECT_NE(found.back(), before);
      }
      EXPECT_EQ(found[0], found[1]);
    }
  }
}

TEST(SurfaceClearance, ManyBodiesAreKeptByAListTooSmall) {
  SaggingSheet s(0.04f);
  Clearance c{s, {}};
  for (int k = -4; k <= 4; ++k) {
    const float x = 0.1f * static_cast<float>(k);
    c.capsules.push_back(capsule({x, -0.085f, -0.4f}, {x, -0.085f, 0.4f}, 0.08f));
  }
  c.planes.resize(8);
  c.system().run();
  for (const CapsulePose& body : c.capsules) {
    EXPECT_GE(least_distance(s, s.drawn.view(), body), kClearance - 2e-5f);
  }
}

TEST(SurfaceClearance, SpheresPointsAndClothThroughTheCoreStayFinite) {
  for (const CapsulePose& body :
       {capsule({0, -0.05f, 0}, {0, -0.05f, 0}, 0.045f), capsule({0, 0, 0}, {0, 0, 0}, 0.1f),
        capsule({-0.3f, 0, 0}, {0.3f, 0, 0}, 0.05f), capsule({0.1f, -0.2f, 0.1f}, {0.1f, 0.2f, 0.1f}, 0.0f)}) {
    SaggingSheet s(0.03f);
    Clearance c{s, {body}};
    c.system().run();
    for (const Vec3& x : drawn(s)) {
      ASSERT_TRUE(is_finite(x));
      ASSERT_LT(length(x), 2.0f);
    }
  }
  Surface collapsed(sheet(3));
  collapsed.move([](const Vec3&) { return Vec3{0.01f, 0.0f, 0.0f}; });
  collapsed.run();
  Clearance c{collapsed, {capsule({0, 0, 0}, {0, 0.1f, 0}, 0.05f)}};
  c.system().run();
  for (const Vec3& x : drawn(collapsed)) EXPECT_NEAR(std::hypot(x.x, x.z), 0.0525f, 1e-5f);
}

TEST(SurfaceClearance, ValidateNamesWhatIsMissing) {
  SaggingSheet s(0.03f);
  Clearance c{s, {log_under_sheet()}};
  const SurfaceClearance good = c.system();
  EXPECT_TRUE(good.validate());
  SurfaceClearance bad = good;
  bad.capsules = nullptr;
  EXPECT_FALSE(bad.validate());
  bad.capsule_count = 0;
  EXPECT_TRUE(bad.validate());
  bad = good, bad.planes.planes = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.planes.capacity = 0;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.clearance = -1.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat
