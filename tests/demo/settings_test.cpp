#include "demo/scenes/settings.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pleat::demo {
namespace {

pleat_cloth_settings defaults() {
  pleat_cloth_def def;
  pleat_get_api(PLEAT_API_MAJOR)->cloth_def_init(&def, sizeof def);
  return def.settings;
}

TEST(Settings, EveryFieldCanBeSetByName) {
  // Every field but `size` and `reserved`: one that the table lacks could be changed by no scene.
  EXPECT_EQ(4 * (kSettings.size() + 2), sizeof(pleat_cloth_settings));
  pleat_cloth_settings settings = defaults();
  set_setting(settings, "stiffness", "12.5");
  set_setting(settings, "substeps", "7");
  set_setting(settings, "surface", "paper");
  set_setting(settings, "level", "8");
  set_setting(settings, "integrator", "runge-kutta-4");
  EXPECT_EQ(settings.stiffness, 12.5f);
  EXPECT_EQ(settings.substeps, 7u);
  EXPECT_EQ(settings.surface, uint32_t(PLEAT_SURFACE_PAPER));
  EXPECT_EQ(settings.level, PLEAT_LEVEL_MAX);
  EXPECT_EQ(settings.integrator, uint32_t(PLEAT_INTEGRATOR_RUNGE_KUTTA_4));
  set_setting(settings, "level", "fan");
  EXPECT_EQ(settings.level, PLEAT_LEVEL_FAN);
}

TEST(Settings, RefusesWhatItCannotRead) {
  const char* cases[][2] = {
      {"stiffnes", "1"},    {"", "1"},           {"stiffness", ""},  {"stiffness", "1x"}, {"stiffness", "nan"},
      {"stiffness", "inf"}, {"substeps", "1.5"}, {"substeps", "-1"}, {"surface", "3"},    {"level", "9"},
      {"level", "0"},       {"friction", "1e99"}};
  for (const auto& [name, value] : cases) {
    pleat_cloth_settings settings = defaults();
    EXPECT_THROW(set_setting(settings, name, value), std::invalid_argument) << name << "=" << value;
  }
}

TEST(Settings, ANumberOutOfRangeIsCalledThat) {
  pleat_cloth_settings settings = defaults();
  for (const auto& [name, value] : {std::pair{"friction", "1e99"}, {"substeps", "4294967296"}}) {
    try {
      set_setting(settings, name, value);
      FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("out of range"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace pleat::demo
