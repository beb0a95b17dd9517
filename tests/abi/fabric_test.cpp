#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

pleat_cloth_settings defaults() { return made(api().cloth_def_init).settings; }

TEST(Fabric, SetsTheMaterialAndLeavesTheRest) {
  for (std::uint32_t fabric = PLEAT_FABRIC_POLYESTER; fabric <= PLEAT_FABRIC_NYLON; ++fabric) {
    pleat_cloth_settings s = defaults();
    s.friction = 0.7f;
    ASSERT_EQ(api().fabric_apply(fabric, &s), pleat_result{PLEAT_OK});
    EXPECT_EQ(s.friction, 0.7f);
    EXPECT_EQ(s.stretch_limit, defaults().stretch_limit);
    // (B / sigma g)^(1/3), the length over which cloth bends under its weight, is centimetres for every fabric.
    const float bending_length = std::cbrt(s.bend_stiffness / (s.density * 9.81f));
    EXPECT_GT(bending_length, 0.015f) << fabric;
    EXPECT_LT(bending_length, 0.05f) << fabric;
    EXPECT_GT(s.stiffness, 50.0f) << fabric;
  }
  pleat_cloth_settings denim = defaults();
  ASSERT_EQ(api().fabric_apply(PLEAT_FABRIC_DENIM, &denim), pleat_result{PLEAT_OK});
  EXPECT_FLOAT_EQ(denim.density, 0.324f);
  EXPECT_FLOAT_EQ(denim.stiffness, 545.596f);
  EXPECT_FLOAT_EQ(denim.bend_stiffness, 70e-6f);
}

TEST(Fabric, MistakesAreRefused) {
  pleat_cloth_settings s = defaults();
  const auto refused = [](std::uint32_t fabric, pleat_cloth_settings* settings, const char* field) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(api().fabric_apply(fabric, settings), pleat_result{PLEAT_ERROR_ARGUMENT});
    EXPECT_NE(testing::internal::GetCapturedStderr().find(field), std::string::npos);
  };
  refused(PLEAT_FABRIC_NYLON + 1, &s, "fabric");
  refused(PLEAT_FABRIC_DENIM, nullptr, "settings");
  s.size = offsetof(pleat_cloth_settings, bend_stiffness);
  refused(PLEAT_FABRIC_DENIM, &s, "settings.size");
  EXPECT_EQ(s.density, defaults().density);
}

}  // namespace
}  // namespace pleat::abi
