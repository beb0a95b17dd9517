#include <cstddef>
#include <numbers>

#include "engine/border.h"
#include "engine/calls.h"

namespace pleat::call {
namespace {

struct Fabric {
  float density, modulus, bending;  // kg/m2, N/m, N m
};

/// In the order of PLEAT_FABRIC_*; sources in the header.
constexpr Fabric kFabrics[] = {
    {0.128f, 2080.0f, 38e-6f},   // polyester
    {0.220f, 2080.0f, 168e-6f},  // trousers
    {0.324f, 630.0f, 70e-6f},    // denim
    {0.228f, 220.0f, 168e-6f},   // blanket
    {0.187f, 150.0f, 23e-6f},    // interlock
    {0.284f, 120.0f, 30e-6f},    // ponte
    {0.224f, 110.0f, 34e-6f},    // sweat
    {0.204f, 86.0f, 44e-6f},     // nylon
};

}  // namespace

pleat_result fabric_apply(uint32_t fabric, pleat_cloth_settings* settings) {
  return guarded(nullptr, "fabric_apply", [&] {
    need_range("fabric", fabric, 0, static_cast<double>(std::size(kFabrics)) - 1);
    need_pointer("settings", settings);
    constexpr std::size_t kEnd = offsetof(pleat_cloth_settings, bend_stiffness) + sizeof(float);
    need_range("settings.size", settings->size, kEnd, sizeof(pleat_cloth_settings));
    settings->density = kFabrics[fabric].density;
    settings->stiffness = 0.5f * std::numbers::sqrt3_v<float> * kFabrics[fabric].modulus;
    settings->bend_stiffness = kFabrics[fabric].bending;
  });
}

}  // namespace pleat::call
