#include "demo/scenes/scene_reader.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "demo/input_error.h"
#include "demo/scenes/body_reader.h"
#include "demo/scenes/garment_reader.h"
#include "demo/scenes/json_value.h"
#include "demo/scenes/scene_files.h"
#include "demo/scenes/settings.h"

namespace pleat::demo {
namespace {

using Eigen::Vector3d;

constexpr uint32_t kMostFrames = 1000000, kMostCopies = 100000;

/// `drape_sphere:32` is the scene `drape_sphere` of size 32.
struct SizedName {
  std::string name;
  std::optional<uint32_t> size;
};

SizedName split_size(const std::string& name) {
  const size_t colon = name.rfind(':');
  std::error_code ignored;
  if (colon == std::string::npos || std::filesystem::exists(name, ignored)) return {name, std::nullopt};
  uint32_t size = 0;
  const char *first = name.data() + colon + 1, *last = name.data() + name.size();
  const auto [end, error] = std::from_chars(first, last, size);
  if (error != std::errc() || end != last || size == 0 || size > kMostCopies) {
    throw InputError(name, "the size after `:` should be a whole number from 1 to " + std::to_string(kMostCopies));
  }
  return {name.substr(0, colon), size};
}

/// Puts the scene's size wherever the file says "N" or "N-1".
void fill_in_size(nlohmann::json& value, uint32_t size) {
  if (value == "N") value = size;
  if (value == "N-1") value = size - 1;
  if (value.is_structured()) {
    for (nlohmann::json& child : value) fill_in_size(child, size);
  }
}

void set_size(nlohmann::json& document, const SizedName& sized, const std::string& file) {
  const JsonValue scene(document, file);
  const auto standard = scene.find("N");
  if (!standard && sized.size) throw InputError(file, "this scene has no size `:N`");
  if (!standard) return;
  fill_in_size(document, sized.size.value_or(standard->integer(1, kMostCopies)));
}

void read_settings(const JsonValue& settings, pleat_cloth_settings& into) {
  for (const std::string& key : settings.keys()) {
    const JsonValue value = settings.at(key);
    if (!value.raw().is_string() && !value.raw().is_number()) value.fail("should be a number or a text");
    try {
      set_setting(into, key, value.raw().is_string() ? value.text() : value.raw().dump());
    } catch (const std::invalid_argument& error) {
      value.fail(error.what());
    }
  }
}

void read_gust(const JsonValue& gust, SceneDef& def) {
  gust.allow_keys({"speed", "frequency", "seed"});
  def.gust = gust.at("speed").number(0.0, 1e3);
  if (const auto frequency = gust.find("frequency")) def.gust_frequency = frequency->number(1e-3, 1e3);
  if (const auto seed = gust.find("seed")) def.gust_seed = seed->integer(0, UINT32_MAX);
}

void read_fabric(const JsonValue& fabric, const pleat_api& api, pleat_cloth_settings& into) {
  const auto word = std::ranges::find(kFabrics, fabric.text(), &SettingWord::name);
  if (word == kFabrics.end()) {
    std::vector<std::string> known;
    for (const SettingWord& w : kFabrics) known.emplace_back(w.name);
    fabric.fail("unknown fabric `" + fabric.text() + "`; known are " + join(known));
  }
  api.fabric_apply(word->value, &into);
}

/// A camera whose upright is y cannot look along it.
Vector3d read_view(const JsonValue& view) {
  const Vector3d towards = view.vector(-1.0, 1.0);
  if (towards.cross(Vector3d::UnitY()).norm() < 1e-3 * std::max(1e-3, towards.norm()))
    view.fail("should not be zero, nor straight up or down");
  return towards;
}

/// Copies stand in rows of `columns`, `spacing` apart in x and z.
std::vector<Vector3d> read_copies(const JsonValue& copies) {
  copies.allow_keys({"count", "columns", "spacing"});
  const uint32_t count = copies.at("count").integer(1, kMostCopies);
  const uint32_t columns = copies.at("columns").integer(1, kMostCopies);
  const double spacing = copies.at("spacing").number(0.01, 100.0);
  std::vector<Vector3d> origins;
  for (uint32_t k = 0; k < count; ++k) origins.push_back(spacing * Vector3d(k % columns, 0.0, k / columns));
  return origins;
}

/// The same garment again and again, `spacing` above each other.
std::vector<Vector3d> read_layers(const JsonValue& layers) {
  layers.allow_keys({"count", "spacing"});
  const uint32_t count = layers.at("count").integer(2, 15);
  const double spacing = layers.at("spacing").number(0.001, 1.0);
  std::vector<Vector3d> origins;
  for (uint32_t k = 0; k < count; ++k) origins.push_back(spacing * Vector3d(0.0, k, 0.0));
  return origins;
}

}  // namespace

SceneDef load_scene(const pleat_api& api, const SceneRequest& request) {
  const SizedName sized = split_size(request.scene);
  const SceneFile file(sized.name);
  nlohmann::json document = parse_json(file.text(), file.name());
  set_size(document, sized, file.name());
  const JsonValue scene(document, file.name());
  scene.allow_keys({"description", "N", "rate", "frames", "gravity", "wind", "gust", "garment", "fabric", "settings",
                    "colliders", "motion", "copies", "layers", "crossings", "ground", "view"});

  SceneDef def;
  def.name = request.scene;
  if (const auto rate = scene.find("rate")) def.rate = rate->number(1.0, 10000.0);
  if (request.rate) def.rate = *request.rate;
  if (const auto gravity = scene.find("gravity")) def.gravity = gravity->vector(-1e3, 1e3);
  if (const auto wind = scene.find("wind")) def.wind = wind->vector(-1e3, 1e3);
  if (const auto gust = scene.find("gust")) read_gust(*gust, def);

  MotionDef motion;
  if (const auto value = scene.find("motion")) {
    motion = read_motion(*value, file, request.clip);
  } else if (!request.clip.empty()) {
    throw InputError(file.name(), "this scene has no motion that --clip could replace");
  }
  if (request.speed != 1.0 && !motion.motion) {
    throw InputError(file.name(), "this scene has no motion that --speed could change");
  }
  def.motion = motion.motion;
  if (request.speed != 1.0) {
    def.motion = [at = motion.motion, speed = request.speed](double s) { return at(s < 0.0 ? s : speed * s); };
    if (motion.duration) *motion.duration /= request.speed;
  }
  def.body = std::move(motion.body);
  if (!def.body.positions.empty()) def.body.positions = def.motion(-motion.settle).vertices;
  def.settle = motion.settle;
  def.ground = motion.ground;
  std::optional<uint32_t> frames;
  if (const auto own = scene.find("frames"); own && request.clip.empty()) frames = own->integer(1, kMostFrames);
  if (request.frames) frames = request.frames;
  if (!frames && motion.duration) {
    const double all = *motion.duration * def.rate;
    if (all > kMostFrames) {
      throw InputError(request.clip.empty() ? file.name() : request.clip,
                       "the motion takes more than " + std::to_string(kMostFrames) + " frames; --frames says how many");
    }
    frames = std::max(1u, uint32_t(all));
  }
  def.frames = frames.value_or(def.frames);
  if (const auto crossings = scene.find("crossings")) def.crossings = crossings->boolean();
  if (const auto ground = scene.find("ground")) def.ground = ground->number(-1e4, 1e4);
  if (const auto view = scene.find("view")) def.view = read_view(*view);

  std::optional<Wearer> wearer;
  if (motion.figure) wearer = Wearer{&*motion.figure, motion.motion(-motion.settle).hips};
  Garment garment = read_garment(scene.at("garment"), file, api, wearer ? &*wearer : nullptr);
  def.garment = std::move(garment.mesh);
  def.pins = std::move(garment.pins);
  if (const auto colliders = scene.find("colliders")) {
    for (const JsonValue& body : colliders->items()) def.fixed.push_back(read_fixed_body(body, file));
  }
  if (const auto copies = scene.find("copies")) def.origins = read_copies(*copies);

  if (const auto layers = scene.find("layers")) {
    if (def.motion || scene.find("copies")) layers->fail("cannot be combined with `motion` or `copies`");
    def.origins = read_layers(*layers);
    def.layered = true;
  }

  pleat_cloth_def cloth;
  api.cloth_def_init(&cloth, sizeof cloth);
  def.settings = cloth.settings;
  if (const auto fabric = scene.find("fabric")) read_fabric(*fabric, api, def.settings);
  if (const auto settings = scene.find("settings")) read_settings(*settings, def.settings);
  for (const std::string& assignment : request.settings) apply_option(assignment, def.settings);
  return def;
}

std::string scene_description(const std::string& scene) {
  const SceneFile file(scene);
  const nlohmann::json document = parse_json(file.text(), file.name());
  return JsonValue(document, file.name()).at("description").text();
}

}  // namespace pleat::demo
