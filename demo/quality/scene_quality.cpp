#include "demo/quality/scene_quality.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "demo/program/progress.h"

namespace pleat::demo {
namespace {

constexpr double kHold = 5.0, kWatch = 1.0;  // s

ExactCapsule exact(const CapsulePose& capsule, const Eigen::Vector3d& origin) {
  return {capsule.a.cast<double>() + origin, capsule.b.cast<double>() + origin, capsule.radius, capsule.taper};
}

}  // namespace

SceneQuality::SceneQuality(const Scene& scene) {
  const pleat_api& api = scene.api();
  pleat_garment_info info{};
  info.size = sizeof info;
  scene.check(api.garment_info(scene.world(), scene.garment(), &info), "garment");
  mesh_.edges.resize(2 * size_t(info.edges));
  mesh_.rest_lengths.resize(info.edges);
  mesh_.triangles.resize(3 * size_t(info.triangles));
  scene.check(
      api.garment_read_edges(scene.world(), scene.garment(), mesh_.edges.data(), mesh_.rest_lengths.data(), info.edges),
      "edges");
  scene.check(api.garment_read_triangles(scene.world(), scene.garment(), mesh_.triangles.data(),
                                         uint32_t(mesh_.triangles.size())),
              "triangles");
  mesh_.pinned.resize(info.particles);
  for (const uint32_t pin : scene.def().pins) mesh_.pinned[pin] = true;
  for (const FixedBody& body : scene.def().fixed) {
    if (const auto* capsule = std::get_if<CapsulePose>(&body.shape)) {
      fixed_.capsules.push_back(exact(*capsule, Eigen::Vector3d::Zero()));
    } else {
      const TriangleMesh& shape = *body.outline();
      fixed_.meshes.push_back(std::make_shared<SolidMesh>(shape.positions, shape.triangles));
    }
  }
}

Bodies SceneQuality::bodies_of(const RunningScene& scene, size_t copy) const {
  Bodies bodies = fixed_;
  const BodyPose& body = scene.body();
  for (size_t part = 0; part < body.touching; ++part) {
    bodies.capsules.push_back(exact(body.capsules[part], scene.def().origins[copy]));
  }
  if (!body.vertices.empty()) {
    std::vector<float> vertices = body.vertices;
    const Eigen::Vector3f origin = scene.def().origins[copy].cast<float>();
    for (size_t i = 0; i < vertices.size(); ++i) vertices[i] += origin[Eigen::Index(i % 3)];
    bodies.meshes.push_back(std::make_shared<SolidMesh>(vertices, scene.def().body.triangles));
  }
  return bodies;
}

namespace {

/// Puts a surface behind others, in one mesh.
void append(std::vector<float>& positions, std::vector<uint32_t>& triangles, std::span<const float> more_positions,
            std::span<const uint32_t> more_triangles) {
  const auto first = uint32_t(positions.size() / 3);
  positions.insert(positions.end(), more_positions.begin(), more_positions.end());
  for (const uint32_t corner : more_triangles) triangles.push_back(first + corner);
}

}  // namespace

/// Of each layer with itself, and of all with each other.
void SceneQuality::add_crossings_of_layers(const RunningScene& scene, std::span<const DrawnSurface> surfaces) {
  std::vector<float> coarse, drawn;
  std::vector<uint32_t> coarse_triangles, drawn_triangles;
  for (size_t k = 0; k < surfaces.size(); ++k) {
    scene.read_particles(k, particles_);
    append(coarse, coarse_triangles, particles_, mesh_.triangles);
    append(drawn, drawn_triangles, surfaces[k].positions(), surfaces[k].indices);
  }
  meter_.add_crossings(find_crossings(coarse, coarse_triangles), find_crossings(drawn, drawn_triangles));
}

void SceneQuality::add_frame(const RunningScene& scene, std::span<const DrawnSurface> surfaces) {
  meter_.begin_frame();
  if (scene.def().crossings && scene.def().layered) add_crossings_of_layers(scene, surfaces);
  for (size_t k = 0; k < scene.copies(); ++k) {
    scene.read_particles(k, particles_);
    if (k >= surfaces.size()) {
      meter_.add_cloth(mesh_, {particles_, {}, {}}, bodies_of(scene, k));
      continue;
    }
    const std::vector<float> drawn = surfaces[k].positions();
    meter_.add_cloth(mesh_, {particles_, drawn, surfaces[k].indices}, bodies_of(scene, k));
    if (!scene.def().crossings || scene.def().layered) continue;
    meter_.add_crossings(find_crossings(particles_, mesh_.triangles), find_crossings(drawn, surfaces[k].indices));
  }
}

void SceneQuality::measure_rest(RunningScene& scene) {
  const long hold = std::lround(kHold * scene.def().rate), watch = std::lround(kWatch * scene.def().rate);
  Progress progress("coming to rest, frame", uint32_t(hold + watch));
  for (long frame = 0; frame < hold; ++frame) {
    scene.hold();
    progress.step();
  }
  std::vector<std::vector<float>> before(scene.copies());
  for (size_t k = 0; k < before.size(); ++k) scene.read_particles(k, before[k]);
  for (long frame = 0; frame < watch; ++frame) {
    scene.hold();
    for (size_t k = 0; k < before.size(); ++k) {
      scene.read_particles(k, particles_);
      meter_.add_rest_motion(mesh_, before[k], particles_, 1.0 / scene.def().rate);
      before[k].swap(particles_);
    }
    progress.step();
  }
}

nlohmann::ordered_json to_json(const Quality& quality) {
  nlohmann::ordered_json json;
  json["strain_max_percent"] = quality.strain_max_percent;
  json["strain_p99_percent"] = quality.strain_p99_percent;
  json["strain_rms_percent"] = quality.strain_rms_percent;
  json["stretch_rms_percent"] = quality.stretch_rms_percent;
  const auto put = [&json](const char* key, const std::optional<double>& value) {
    if (value) json[key] = *value;
  };
  put("penetration_particle_mm", quality.penetration_particle_mm);
  put("penetration_interior_mm", quality.penetration_interior_mm);
  put("penetration_pinned_mm", quality.penetration_pinned_mm);
  put("penetration_drawn_mm", quality.penetration_drawn_mm);
  put("crossings_per_frame", quality.crossings_per_frame);
  put("crossing_depth_mm", quality.crossing_depth_mm);
  put("crossings_drawn_per_frame", quality.crossings_drawn_per_frame);
  put("crossing_drawn_depth_mm", quality.crossing_drawn_depth_mm);
  put("rest_jitter_mm", quality.rest_jitter_mm);
  put("rest_speed_cm_s", quality.rest_speed_cm_s);
  return json;
}

}  // namespace pleat::demo
