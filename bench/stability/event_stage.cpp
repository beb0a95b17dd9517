#include "bench/stability/event_stage.h"

#include <algorithm>
#include <cmath>

namespace pleat::bench {
namespace {

constexpr double kMostStrain = 0.1;   // in the end
constexpr double kMostMotion = 0.05;  // mm, of a cloth at rest
constexpr uint32_t kVertex = 6;       // floats: position, normal
constexpr uint32_t kBytes = sizeof(float);

struct Counter {
  std::string_view name;
  uint64_t pleat_stats::*value;
};
constexpr Counter kCounters[] = {{"nonfinite_restored", &pleat_stats::nonfinite_restored},
                                 {"stiffness_lowered", &pleat_stats::stiffness_lowered},
                                 {"teleports", &pleat_stats::teleports},
                                 {"rollbacks", &pleat_stats::rollbacks},
                                 {"fallbacks", &pleat_stats::fallbacks},
                                 {"edges_skipped", &pleat_stats::edges_skipped},
                                 {"fast_bodies", &pleat_stats::fast_bodies},
                                 {"contacts_dropped", &pleat_stats::contacts_dropped}};

std::vector<Point> positions(const Rig& rig) {
  std::vector<Point> all(rig.count());
  for (uint32_t i = 0; i < rig.count(); ++i) all[i] = rig.position(i);
  return all;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

EventStage::EventStage(const pleat_api& library, const RigDef& def)
    : api(library), rig(library, def), edges_(api, rig) {
  for (const uint32_t pin : def.pins) {
    for (const double x : rig.position(pin)) pins.push_back(float(x));
  }
  pleat_cloth_info info{};
  info.size = sizeof info;
  rig.need(api.cloth_info(rig.world(), rig.cloth(), &info), "cloth");
  drawn_.resize(size_t{kVertex} * info.drawn_vertices);
  rig.need(api.vertex_target_init(&target_, sizeof target_), "vertex target");
  target_.data = drawn_.data();
  target_.stride = kVertex * kBytes;
  target_.capacity = info.drawn_vertices;
  target_.position_offset = 0;
  target_.normal_offset = 3 * kBytes;
  const pleat_mesh_report& mesh = rig.report();
  result_.outcome = mesh.degenerate_triangles + mesh.duplicate_triangles > 0 ? "repaired" : "recovered";
  look();
}

void EventStage::tick(double dt) {
  rig.step(dt);
  look();
}

void EventStage::run(double seconds, double dt) {
  for (long i = std::lround(seconds / dt); i > 0; --i) tick(dt);
}

void EventStage::move_pins() {
  rig.need(api.cloth_move_pins(rig.world(), rig.cloth(), pins.data(), 0, uint32_t(pins.size() / 3)), "pins");
}

pleat_collider EventStage::add_capsule(std::array<float, 3> a, std::array<float, 3> b, float radius) {
  pleat_collider_def def;
  rig.need(api.collider_def_init(&def, sizeof def), "capsule");
  std::ranges::copy(a, def.a);
  std::ranges::copy(b, def.b);
  def.radius = radius;
  pleat_collider capsule{};
  rig.need(api.collider_create(rig.world(), &def, &capsule), "capsule");
  return capsule;
}

void EventStage::expect_refusal(pleat_result result, std::string_view field) {
  const bool named = rig.complaint().find(field) != std::string::npos;
  const bool refused = result == PLEAT_ERROR_ARGUMENT && named && result_.outcome != "failed";
  result_.outcome = refused ? "refused" : "failed";
}

void EventStage::look() {
  const double strain = edges_.largest_strain(rig);
  if (!(strain <= result_.peak_strain)) result_.peak_strain = strain;
  result_.final_strain = strain;
  rig.need(api.cloth_read_vertices(rig.world(), rig.cloth(), &target_), "drawn vertices");
  const auto broken = [](double x) { return !std::isfinite(x); };
  result_.nonfinite_out += uint64_t(std::ranges::count_if(drawn_, broken));
  for (uint32_t i = 0; i < rig.count(); ++i) {
    result_.nonfinite_out += uint64_t(std::ranges::count_if(rig.position(i), broken));
    result_.nonfinite_out += uint64_t(std::ranges::count_if(rig.velocity(i), broken));
  }
}

void EventStage::watch_rest(long ticks) {
  const std::vector<Point> start = positions(rig);
  const double free = double(rig.count()) - double(pins.size() / 3);
  std::vector<Point> before = start;
  double sum = 0.0, drift = 0.0;
  for (long t = 0; t < ticks; ++t) {
    tick();
    for (uint32_t i = 0; i < rig.count(); ++i) {
      sum += std::pow(distance(rig.position(i), before[i]), 2);
      before[i] = rig.position(i);
    }
  }
  for (uint32_t i = 0; i < rig.count(); ++i) drift = std::max(drift, distance(before[i], start[i]));
  result_.jitter_mm = 1000.0 * std::sqrt(sum / (free * double(ticks)));
  result_.drift_mm = 1000.0 * drift;
}

EventResult EventStage::finish() {
  pleat_stats stats{};
  stats.size = sizeof stats;
  result_.said = rig.complaint();
  rig.need(api.world_stats(rig.world(), &stats), "stats");
  for (const Counter& counter : kCounters) {
    if (stats.*counter.value > 0) result_.interventions.emplace_back(counter.name, stats.*counter.value);
  }
  const bool still = result_.jitter_mm.value_or(0.0) <= kMostMotion && result_.drift_mm.value_or(0.0) <= kMostMotion;
  if (!(result_.final_strain <= kMostStrain) || result_.nonfinite_out > 0 || !still) result_.outcome = "failed";
  return result_;
}

}  // namespace pleat::bench
