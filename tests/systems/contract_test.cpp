// Every dynamics system writes what its header declares and nothing else, neither other columns nor beyond its range.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "systems/air_damping.h"
#include "systems/air_drag.h"
#include "systems/edge_damping.h"
#include "systems/elastic_force.h"
#include "systems/elastic_projection.h"
#include "systems/finite_guard.h"
#include "systems/gravity.h"
#include "systems/hinge_bending.h"
#include "systems/implicit_solver.h"
#include "systems/inner_friction.h"
#include "systems/integration.h"
#include "systems/pin_motion.h"
#include "systems/rounding_hold.h"
#include "systems/stretch_constraint.h"
#include "systems/velocity_update.h"
#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kDt = 1.0f / 480;
constexpr std::uint32_t kPins[] = {0, 3};

struct Case {
  const char* name;
  void (*run)(Sheet&);
  std::vector<std::string> writes;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

Vec3Column& held_column() {
  static Vec3Column column = [] {
    Vec3Column c(std::pmr::new_delete_resource());
    c.resize(25);
    return c;
  }();
  return column;
}

Vec3Column& pin_targets() {
  static Vec3Column column = [] {
    Vec3Column c(std::pmr::new_delete_resource());
    c.resize(2);
    return c;
  }();
  return column;
}

void guard(Sheet& s) {
  s.position.set(5, {kNan, 0, 0});
  Stats stats;
  FiniteGuard{s.count, s.previous, s.position, s.velocity}.run(stats);
}
void stretch(Sheet& s) {
  Stats stats;
  s.run_packed(StretchConstraint{&s.garment.slots, 0.001f, 1.0f, s.ways(), &s.packed.position}, stats);
}

const Case kCases[] = {
    {"ElasticForce",
     [](Sheet& s) { ElasticForce{&s.garment, s.position, s.inverse_mass, {30.0f}, 1e6f, s.force}.run(); },
     {"force"}},
    {"HingeBending",
     [](Sheet& s) {
       HingeBending{&s.garment, s.position, s.velocity, s.inverse_mass,   1.0f,
                    4.0f,       kDt,        &s.packed,  &s.hinge_scratch, s.force}
           .run();
     },
     {"force"}},
    {"EdgeDamping",
     [](Sheet& s) {
       EdgeDamping{&s.garment, s.position, s.velocity, s.inverse_mass, 4.0f, kDt, &s.packed, s.force}.run();
     },
     {"force"}},
    {"Gravity",
     [](Sheet& s) {
       Gravity{s.count, s.mass, {0, -9.81f, 0}, s.force}.run();
     },
     {"force"}},
    {"AirDamping", [](Sheet& s) { AirDamping{s.count, s.mass, s.velocity, 1.0f, kDt, s.force}.run(); }, {"force"}},
    {"InnerFriction",
     [](Sheet& s) {
       InnerFriction{&s.garment, s.mass, s.velocity, 1.0f, kDt, kDt, held_column().view(), s.force}.run();
     },
     {"force"}},
    {"RoundingHold",
     [](Sheet& s) { RoundingHold{s.count, s.previous, s.position, s.velocity, kDt, kDt, held_column().view()}.run(); },
     {}},
    {"AirDrag",
     [](Sheet& s) {
       AirDrag{&s.garment, s.position, s.velocity, {1, 2, 3}, 1.2f, 1.0f, 0.5f, 0.2f, kDt, s.force}.run();
     },
     {"force"}},
    {"EulerIntegration",
     [](Sheet& s) { EulerIntegration{s.count, s.inverse_mass, s.force, kDt, true, s.position, s.velocity}.run(); },
     {"position", "velocity"}},
    {"PinMotion",
     [](Sheet& s) {
       const Vec3View pins = pin_targets().view();
       PinMotion{&s.garment, pins, pins, 0.0f, 1.0f, kDt, s.position, s.velocity}.run();
     },
     {"position", "velocity"}},
    {"ElasticProjection",
     [](Sheet& s) {
       s.run_packed(ElasticProjection{&s.garment, {30.0f}, 4.0f, kDt, s.ways(), &s.packed.position});
     },
     {"position"}},
    {"ImplicitIntegration",
     [](Sheet& s) {
       ImplicitMatrix matrix(s.garment);
       ImplicitIntegration{&s.garment, &matrix, s.inverse_mass, s.force, {30.0f}, kDt, s.position, s.velocity}.run();
     },
     {"position", "velocity"}},
    {"StretchConstraint", stretch, {"position"}},
    {"VelocityUpdate",
     [](Sheet& s) { VelocityUpdate{s.count, s.position, s.predicted, s.inverse_mass, kDt, s.velocity}.run(); },
     {"velocity"}},
    {"FiniteGuard", guard, {"position", "velocity"}},
};

struct Snapshot {
  std::string name;
  std::vector<float> values;  // with the padding
};

std::vector<Snapshot> snapshot(const Sheet& sheet) {
  std::vector<Snapshot> all;
  const auto add = [&](const std::string& name, const float* data) {
    if (all.empty() || all.back().name != name) all.push_back({name, {}});
    all.back().values.insert(all.back().values.end(), data, data + padded(sheet.count));
  };
  const ParticleColumns& p = sheet.particles;
  const std::pair<const char*, const Vec3Column*> vectors[] = {{"position", &p.position},
                                                               {"velocity", &p.velocity},
                                                               {"force", &p.force},
                                                               {"previous", &p.previous},
                                                               {"predicted", &p.predicted}};
  for (const auto& [name, column] : vectors) {
    add(name, column->x.data()), add(name, column->y.data()), add(name, column->z.data());
  }
  add("inverse_mass", p.inverse_mass.data());
  add("mass", p.mass.data());
  return all;
}

class SystemContract : public testing::TestWithParam<Case> {};

TEST_P(SystemContract, WritesWhatItDeclaresAndNothingElse) {
  Sheet sheet(make_grid({.rows = 5, .columns = 5}), kPins);
  shake(sheet.position, sheet.count, 0.1f, 1);
  shake(sheet.velocity, sheet.count, 1.0f, 2);
  shake(sheet.force, sheet.count, 1.0f, 3);
  shake(sheet.previous, sheet.count, 0.1f, 4);
  shake(sheet.predicted, sheet.count, 0.1f, 5);
  const std::vector<Snapshot> before = snapshot(sheet);
  GetParam().run(sheet);
  const std::vector<Snapshot> after = snapshot(sheet);
  for (std::size_t c = 0; c < before.size(); ++c) {
    const std::vector<float>&old = before[c].values, &now = after[c].values;
    const bool changed = std::memcmp(old.data(), now.data(), old.size() * sizeof(float)) != 0;
    const auto& writes = GetParam().writes;
    EXPECT_EQ(changed, std::find(writes.begin(), writes.end(), before[c].name) != writes.end()) << before[c].name;
    for (std::size_t i = 0; i < old.size(); ++i) {
      const bool padding = i % padded(sheet.count) >= sheet.count;
      EXPECT_TRUE(!padding || now[i] == 0.0f) << before[c].name << " padding";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SystemContract, testing::ValuesIn(kCases),
                         [](const testing::TestParamInfo<Case>& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace pleat
