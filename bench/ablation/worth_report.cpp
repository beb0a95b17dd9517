#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/ablation/worth.h"

namespace pleat::bench {
namespace {

struct FlawColumn {
  const char *name, *title;
  int decimals;
  std::optional<double> (*value)(const Flaws&);
};

constexpr FlawColumn kColumns[] = {
    {"stretch_percent", "stretch %", 2, [](const Flaws& f) { return std::optional(f.stretch_percent); }},
    {"inside_mm", "inside mm", 2, [](const Flaws& f) { return f.inside_mm; }},
    {"length_percent", "length %", 2, [](const Flaws& f) { return std::optional(f.length_percent); }},
    {"crossings", "crossings", 2, [](const Flaws& f) { return f.crossings; }},
    {"jitter_mm", "jitter mm", 4, [](const Flaws& f) { return f.jitter_mm; }}};

/// Of the columns that were measured, the flaws themselves or what `without` adds to them.
void print_flaws(const Flaws& with, const Flaws* without) {
  for (const FlawColumn& column : kColumns) {
    const std::optional<double> before = column.value(with);
    if (!before) continue;
    if (without) {
      std::printf(" %+10.*f", column.decimals, *column.value(*without) - *before);
    } else {
      std::printf(" %10.*f", column.decimals, *before);
    }
  }
}

nlohmann::ordered_json to_json(const Flaws& flaws) {
  nlohmann::ordered_json json;
  for (const FlawColumn& column : kColumns) {
    if (const auto value = column.value(flaws)) json[column.name] = *value;
  }
  return json;
}

}  // namespace

void print_worth(const SceneWorth& worth) {
  std::printf("%s: %u particles, %.1f us a frame, best of %u rounds\n", worth.scene.c_str(), worth.particles,
              worth.frame_us, worth.rounds);
  std::printf("  %-26s %10s", "left out", "saved us");
  for (const FlawColumn& column : kColumns) {
    if (column.value(worth.flaws)) std::printf(" %10s", column.title);
  }
  std::printf(" %10s %10s\n  %-26s %10s", "apart mm", "turned deg", "(as it is)", "");
  print_flaws(worth.flaws, nullptr);
  std::printf("\n");
  for (const Worth& part : worth.parts) {
    std::printf("%c %-26s %10.1f", part.ablation.put_in ? '+' : ' ', part.ablation.part->name.data(), part.saved_us);
    print_flaws(part.with, &part.without);
    std::printf(" %10.2f %10.2f\n", part.apart_mm, part.turned_deg);
  }
}

nlohmann::ordered_json worth_json(const SceneWorth& worth) {
  nlohmann::ordered_json rows;
  for (const Worth& part : worth.parts) {
    rows.push_back({{"name", part.ablation.part->name},
                    {"settings", part.ablation.part->without},
                    {"put_in", part.ablation.put_in},
                    {"saved_us", part.saved_us},
                    {"with", to_json(part.with)},
                    {"without", to_json(part.without)},
                    {"apart_mm", part.apart_mm},
                    {"turned_deg", part.turned_deg}});
  }
  return {{"scene", worth.scene},       {"particles", worth.particles},  {"rounds", worth.rounds},
          {"frame_us", worth.frame_us}, {"flaws", to_json(worth.flaws)}, {"parts", rows}};
}

}  // namespace pleat::bench
