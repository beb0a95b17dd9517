#include "bench/stability/events.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

namespace pleat::bench {
namespace {

constexpr double kSettle = 4.0;           // s, after each event
constexpr double kSwing = 60.0;           // s, until the square has come to rest
constexpr uint32_t kMiddle = 8 * 16 + 8;  // a particle in the middle of hanging_square:16

using Happen = std::function<void(EventStage&)>;

/// A particle's corner of the first triangle that has it, and the other two.
struct Corner {
  size_t at;  // in TriangleMesh::triangles
  uint32_t next, last;
};
Corner corner_of(const demo::TriangleMesh& mesh, uint32_t particle) {
  const size_t at = size_t(std::ranges::find(mesh.triangles, particle) - mesh.triangles.begin()), t = at - at % 3;
  return {at, mesh.triangles[t + (at + 1) % 3], mesh.triangles[t + (at + 2) % 3]};
}

/// One triangle gets a corner of its own, in the same place as that of its neighbours.
void duplicate_particle(RigDef& def) {
  std::vector<float>& x = def.mesh.positions;
  def.mesh.triangles[corner_of(def.mesh, kMiddle).at] = uint32_t(def.mesh.vertex_count());
  for (size_t k = 0; k < 3; ++k) x.push_back(x[3 * kMiddle + k]);
}

/// Moves the middle particle to `height` of its own from the middle of the opposite side of a triangle.
auto flatten_triangle(float height) {
  return [height](RigDef& def) {
    const Corner corner = corner_of(def.mesh, kMiddle);
    std::vector<float>& x = def.mesh.positions;
    for (size_t k = 0; k < 3; ++k) {
      const float foot = 0.5f * (x[3 * corner.next + k] + x[3 * corner.last + k]);
      x[3 * kMiddle + k] = foot + height * (x[3 * kMiddle + k] - foot);
    }
  };
}

void drag(RigDef& def) { def.settings.drag_coefficient = 1.0f; }

void gather(EventStage& stage) {
  stage.run(1.0);
  std::vector<float> x;
  for (uint32_t i = 0; i < stage.rig.count(); ++i) x.insert(x.end(), {0.0f, 1.5f, 0.0f});
  std::copy_n(stage.pins.begin(), 3, x.begin());
  std::copy_n(stage.pins.begin() + 3, 3, x.begin() + 3 * 15);
  stage.rig.need(
      stage.api.cloth_write_particles(stage.rig.world(), stage.rig.cloth(), x.data(), nullptr, stage.rig.count()),
      "positions");
}

auto jump(float way) {
  return [way](EventStage& stage) {
    stage.run(1.0);
    for (size_t k = 0; k < stage.pins.size(); k += 3) stage.pins[k] += way;
    stage.move_pins();
  };
}

/// About the upright axis between the two pins.
void spin(EventStage& stage) {
  constexpr double kTurns = 20.0;  // 1/s
  const std::vector<float> start = stage.pins;
  for (int i = 1; i <= 120; ++i) {
    const double angle = 2.0 * std::numbers::pi * kTurns * i * EventStage::kTick;
    for (size_t k = 0; k < start.size(); k += 3) {
      const double x = double(start[k]), z = double(start[k + 2] - start[2]);  // both pins have the same z
      stage.pins[k] = float(x * std::cos(angle) + z * std::sin(angle));
      stage.pins[k + 2] = float(double(start[2]) + z * std::cos(angle) - x * std::sin(angle));
    }
    stage.move_pins();
    stage.tick();
  }
}

auto blow(float speed) {
  return [speed](EventStage& stage) {
    const float wind[] = {0.3f * speed, 0.0f, 0.954f * speed}, calm[] = {0.0f, 0.0f, 0.0f};
    stage.rig.need(stage.api.world_set_wind(stage.rig.world(), wind), "wind");
    stage.run(2.0);
    stage.rig.need(stage.api.world_set_wind(stage.rig.world(), calm), "wind");
  };
}

void flip_gravity(EventStage& stage) {
  for (int i = 0; i < 120; ++i) {
    const float gravity[] = {0.0f, i % 2 == 0 ? 9.81f : -9.81f, 0.0f};
    stage.rig.need(stage.api.world_set_gravity(stage.rig.world(), gravity), "gravity");
    stage.tick();
  }
}

auto scale_stiffness(float factor) {
  return [factor](EventStage& stage) {
    stage.run(2.0);
    pleat_cloth_settings settings{};
    settings.size = sizeof settings;
    stage.rig.need(stage.api.cloth_get(stage.rig.world(), stage.rig.cloth(), &settings), "settings");
    settings.stiffness *= factor;
    stage.rig.need(stage.api.cloth_set(stage.rig.world(), stage.rig.cloth(), &settings), "settings");
  };
}

void alternate_ticks(EventStage& stage) {
  for (int i = 0; i < 120; ++i) stage.tick(i % 2 == 0 ? 1.0 / 240.0 : 1.0 / 10.0);
}

void capsule_appears(EventStage& stage) {
  stage.run(2.0);
  stage.add_capsule({-0.3f, 1.5f, stage.pins[2]}, {0.3f, 1.5f, stage.pins[2]}, 0.15f);
}

/// A body beside the cloth is elsewhere in the next tick: `way` m across it, from one side to the other or, where
/// `into`, to where the cloth is.
auto capsule_jumps(float way, bool into) {
  return [way, into](EventStage& stage) {
    const float from = into ? stage.pins[2] - way : stage.pins[2] - 0.5f * way;
    const pleat_collider capsule = stage.add_capsule({-0.6f, 1.5f, from}, {0.6f, 1.5f, from}, 0.15f);
    stage.run(2.0);
    const float to = from + way, a[] = {-0.6f, 1.5f, to}, b[] = {0.6f, 1.5f, to};
    stage.rig.need(stage.api.collider_move_capsule(stage.rig.world(), capsule, a, b), "capsule");
  };
}

/// The same with a body next to the cloth.
Happen with_capsule(const Happen& happen) {
  return [happen](EventStage& stage) {
    stage.add_capsule({-0.6f, 1.4f, 0.0f}, {0.6f, 1.4f, 0.0f}, 0.2f);
    happen(stage);
  };
}

void far_away(RigDef& def) {
  for (size_t i = 0; i < def.mesh.positions.size(); i += 3) def.mesh.positions[i] += 1e4f;
}

void bad_start(EventStage& stage, float bad) {
  std::vector<float> x(3 * stage.rig.count());
  stage.rig.need(
      stage.api.cloth_read_particles(stage.rig.world(), stage.rig.cloth(), x.data(), nullptr, stage.rig.count()),
      "particles");
  x[3 * kMiddle] = bad;
  pleat_cloth_def def;
  stage.rig.need(stage.api.cloth_def_init(&def, sizeof def), "cloth");
  def.garment = stage.rig.garment();
  def.positions = x.data();
  pleat_cloth cloth{};
  stage.expect_refusal(stage.api.cloth_create(stage.rig.world(), &def, &cloth), "positions");
  stage.expect_refusal(
      stage.api.cloth_write_particles(stage.rig.world(), stage.rig.cloth(), x.data(), nullptr, stage.rig.count()),
      "positions");
}

void bad_pin(EventStage& stage, float bad) {
  const std::vector<float> pins = {bad, 2.0f, 0.0f, 0.5f, 2.0f, 0.0f};
  stage.expect_refusal(stage.api.cloth_move_pins(stage.rig.world(), stage.rig.cloth(), pins.data(), 0, 2), "positions");
}

void bad_collider(EventStage& stage, float bad) {
  const pleat_collider capsule = stage.add_capsule({-0.6f, 0.9f, 0.0f}, {0.6f, 0.9f, 0.0f}, 0.1f);
  const float a[] = {0.0f, bad, 0.0f}, b[] = {0.0f, 1.0f, 0.0f};
  stage.expect_refusal(stage.api.collider_move_capsule(stage.rig.world(), capsule, a, b), "a[");
  pleat_collider_def def;
  stage.rig.need(stage.api.collider_def_init(&def, sizeof def), "capsule");
  def.radius = bad;
  pleat_collider other{};
  stage.expect_refusal(stage.api.collider_create(stage.rig.world(), &def, &other), "radius");
}

void bad_wind(EventStage& stage, float bad) {
  const float wind[] = {0.0f, 0.0f, bad};
  stage.expect_refusal(stage.api.world_set_wind(stage.rig.world(), wind), "wind");
}

void bad_dt(EventStage& stage, float bad) { stage.expect_refusal(stage.api.world_step(stage.rig.world(), bad), "dt"); }

struct BadInput {
  const char* name;
  void (*give)(EventStage&, float);
};
constexpr BadInput kBadInputs[] = {
    {"start_position", bad_start}, {"pin", bad_pin}, {"collider", bad_collider}, {"wind", bad_wind}, {"dt", bad_dt}};

}  // namespace

std::vector<Event> events(long rest_ticks) {
  std::vector<Event> all = {
      {"all_at_one_point", nullptr, gather},
      {"all_at_one_point_capsule", nullptr, with_capsule(gather)},
      {"duplicate_particle", duplicate_particle, nullptr},
      {"sliver_triangle", flatten_triangle(1e-3f), nullptr},
      {"zero_area_triangle", flatten_triangle(0.0f), nullptr},
      {"pins_jump_10_m", nullptr, jump(10.0f)},
      {"pins_jump_10_m_capsule", nullptr, with_capsule(jump(10.0f))},
      {"pins_jump_1000_m", nullptr, jump(1000.0f)},
      {"pins_spin_20_turns_per_s", nullptr, spin},
      {"pins_spin_20_turns_per_s_capsule", nullptr, with_capsule(spin)},
      {"wind_100_m_per_s", drag, blow(100.0f)},
      {"wind_1000_m_per_s", drag, blow(1000.0f)},
      {"gravity_flips", nullptr, flip_gravity},
      {"stiffness_times_1e6", nullptr, scale_stiffness(1e6f)},
      {"stiffness_by_1e6", [](RigDef& def) { def.settings.stiffness = 3e7f; }, scale_stiffness(1e-6f)},
      {"dt_alternates", nullptr, alternate_ticks},
      {"capsule_appears", nullptr, capsule_appears},
      {"capsule_jumps_1_m_past", nullptr, capsule_jumps(1.0f, false)},
      {"capsule_jumps_10_m_past", nullptr, capsule_jumps(10.0f, false)},
      {"capsule_jumps_1000_m_past", nullptr, capsule_jumps(1000.0f, false)},
      {"capsule_jumps_10_m_into_it", nullptr, capsule_jumps(10.0f, true)},
      {"capsule_jumps_1000_m_into_it", nullptr, capsule_jumps(1000.0f, true)},
      {"far_from_origin", far_away, nullptr},
  };
  if (rest_ticks > 0) {
    all.push_back({"long_rest", nullptr, [rest_ticks](EventStage& stage) {
                     stage.run(kSwing);
                     stage.watch_rest(rest_ticks);
                   }});
  }
  for (const BadInput& input : kBadInputs) {
    all.push_back({std::string("bad_") + input.name, nullptr, [give = input.give](EventStage& stage) {
                     stage.run(0.5);
                     give(stage, NAN);
                     give(stage, INFINITY);
                   }});
  }
  return all;
}

EventResult run_event(const pleat_api& api, const demo::SceneDef& scene, const Event& event) {
  RigDef def;
  def.mesh = scene.garment;
  def.pins = scene.pins;
  def.settings = scene.settings;
  if (event.prepare) event.prepare(def);
  EventResult result;
  try {
    EventStage stage(api, def);
    if (event.happen) event.happen(stage);
    stage.run(kSettle);
    result = stage.finish();
  } catch (const std::runtime_error& error) {
    result.outcome = "failed";
    result.said = error.what();
  }
  result.name = event.name;
  return result;
}

nlohmann::ordered_json events_json(std::span<const EventResult> results) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const EventResult& r : results) {
    nlohmann::ordered_json& event =
        all.emplace_back(nlohmann::ordered_json{{"name", r.name},
                                                {"peak_strain_percent", 100.0 * r.peak_strain},
                                                {"final_strain_percent", 100.0 * r.final_strain},
                                                {"nonfinite_out", r.nonfinite_out},
                                                {"interventions", nlohmann::ordered_json::object()},
                                                {"outcome", r.outcome}});
    for (const auto& [name, count] : r.interventions) event["interventions"][std::string(name)] = count;
    if (r.jitter_mm) event["jitter_mm"] = *r.jitter_mm;
    if (r.drift_mm) event["drift_mm"] = *r.drift_mm;
    if (!r.said.empty()) event["said"] = r.said;
  }
  return all;
}

void print_events(std::span<const EventResult> results) {
  std::printf("\n%-34s%12s%12s%12s  %-10s %s\n", "event", "peak, %", "final, %", "not finite", "outcome",
              "interventions");
  for (const EventResult& r : results) {
    std::printf("%-34s%12.2f%12.2f%12llu  %-10s", r.name.c_str(), 100.0 * r.peak_strain, 100.0 * r.final_strain,
                static_cast<unsigned long long>(r.nonfinite_out), r.outcome.c_str());
    for (const auto& [name, count] : r.interventions)
      std::printf(" %.*s %llu", int(name.size()), name.data(), static_cast<unsigned long long>(count));
    if (r.jitter_mm) std::printf(" jitter %.4f mm, drift %.4f mm", *r.jitter_mm, *r.drift_mm);
    if (!r.said.empty()) std::printf(" \"%s\"", r.said.c_str());
    std::printf("\n");
  }
}

}  // namespace pleat::bench
