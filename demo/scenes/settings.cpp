#include "demo/scenes/settings.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

using S = pleat_cloth_settings;

constexpr SettingWord kIntegratorWords[] = {{"symplectic-euler", PLEAT_INTEGRATOR_SYMPLECTIC_EULER},
                                            {"explicit-euler", PLEAT_INTEGRATOR_EXPLICIT_EULER},
                                            {"runge-kutta-4", PLEAT_INTEGRATOR_RUNGE_KUTTA_4},
                                            {"projected", PLEAT_INTEGRATOR_PROJECTED},
                                            {"implicit-euler", PLEAT_INTEGRATOR_IMPLICIT_EULER}};
constexpr SettingWord kSurfaceWords[] = {{"flat", PLEAT_SURFACE_FLAT},    {"pn", PLEAT_SURFACE_PN},
                                         {"paper", PLEAT_SURFACE_PAPER},  {"pleat", PLEAT_SURFACE_PLEAT},
                                         {"phong", PLEAT_SURFACE_PHONG},  {"spherigon", PLEAT_SURFACE_SPHERIGON},
                                         {"arc-pn", PLEAT_SURFACE_ARC_PN}};
constexpr SettingWord kFaceResponseWords[] = {{"weighted", PLEAT_FACE_RESPONSE_WEIGHTED},
                                              {"whole", PLEAT_FACE_RESPONSE_WHOLE}};
constexpr SettingWord kLevelWords[] = {
    {"fan", PLEAT_LEVEL_FAN}, {"1", 1}, {"2", 2}, {"3", 3}, {"4", 4}, {"5", 5}, {"6", 6}, {"7", 7}, {"8", 8}};

constexpr SettingWord kFabricWords[] = {{"polyester", PLEAT_FABRIC_POLYESTER}, {"trousers", PLEAT_FABRIC_TROUSERS},
                                        {"denim", PLEAT_FABRIC_DENIM},         {"blanket", PLEAT_FABRIC_BLANKET},
                                        {"interlock", PLEAT_FABRIC_INTERLOCK}, {"ponte", PLEAT_FABRIC_PONTE},
                                        {"sweat", PLEAT_FABRIC_SWEAT},         {"nylon", PLEAT_FABRIC_NYLON}};

constexpr Setting kTable[] = {{"integrator", &S::integrator, kIntegratorWords},
                              {"substeps", &S::substeps},
                              {"sweeps", &S::sweeps},
                              {"density", &S::density},
                              {"stiffness", &S::stiffness},
                              {"stretch_limit", &S::stretch_limit},
                              {"bend_stiffness", &S::bend_stiffness},
                              {"edge_damping", &S::edge_damping},
                              {"bend_damping", &S::bend_damping},
                              {"air_damping", &S::air_damping},
                              {"drag_coefficient", &S::drag_coefficient},
                              {"lift_coefficient", &S::lift_coefficient},
                              {"thickness", &S::thickness},
                              {"friction", &S::friction},
                              {"face_response", &S::face_response, kFaceResponseWords},
                              {"surface", &S::surface, kSurfaceWords},
                              {"level", &S::level, kLevelWords},
                              {"inner_friction", &S::inner_friction},
                              {"fold_sweeps", &S::fold_sweeps},
                              {"self_distance", &S::self_distance},
                              {"tangents", &S::tangents},
                              {"layer", &S::layer},
                              {"buckling_strain", &S::buckling_strain},
                              {"teleport_speed", &S::teleport_speed},
                              {"sleep_speed", &S::sleep_speed},
                              {"collides_with", &S::collides_with}};

template <typename Named>
std::string names_of(std::span<const Named> list) {
  std::string joined;
  for (const Named& named : list) joined += (joined.empty() ? "" : ", ") + std::string(named.name);
  return joined;
}

template <typename Number>
Number parse(std::string_view name, std::string_view text, const char* kind) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size())
    throw std::invalid_argument("`" + std::string(name) + "` is out of range: `" + std::string(text) + "`");
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(double(value))) {
    throw std::invalid_argument("`" + std::string(name) + "` should be " + kind + ", is `" + std::string(text) + "`");
  }
  return value;
}

uint32_t value_of_word(const Setting& setting, std::string_view text) {
  for (const SettingWord& word : setting.words) {
    if (word.name == text) return word.value;
  }
  throw std::invalid_argument("`" + std::string(setting.name) + "` cannot be `" + std::string(text) + "`; known are " +
                              names_of(setting.words));
}

}  // namespace

const std::span<const Setting> kSettings = kTable;
const std::span<const SettingWord> kIntegrators = kIntegratorWords;
const std::span<const SettingWord> kSurfaces = kSurfaceWords;
const std::span<const SettingWord> kLevels = kLevelWords;
const std::span<const SettingWord> kFabrics = kFabricWords;

void set_setting(pleat_cloth_settings& settings, std::string_view name, std::string_view text) {
  for (const Setting& setting : kTable) {
    if (setting.name != name) continue;
    if (const auto* real = std::get_if<float S::*>(&setting.field)) {
      settings.*(*real) = parse<float>(name, text, "a number");
    } else {
      settings.*std::get<uint32_t S::*>(setting.field) =
          setting.words.empty() ? parse<uint32_t>(name, text, "a whole number") : value_of_word(setting, text);
    }
    return;
  }
  throw std::invalid_argument("unknown setting `" + std::string(name) + "`; known are " + names_of(kSettings));
}

void apply_option(const std::string& assignment, pleat_cloth_settings& into) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos) throw InputError("--set " + assignment, "should be key=value");
  try {
    set_setting(into, assignment.substr(0, equals), assignment.substr(equals + 1));
  } catch (const std::invalid_argument& error) {
    throw InputError("--set " + assignment, error.what());
  }
}

}  // namespace pleat::demo
