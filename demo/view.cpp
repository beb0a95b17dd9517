#include "demo/view.h"

#include <algorithm>
#include <iterator>

namespace pleat::demo {
namespace {

constexpr float kFieldOfView = 0.55f;  // rad
constexpr std::uint32_t kInk = 0x2b2b33ff;
constexpr std::uint32_t kBody = 0xc9c3baff;

/// Of clothes over each other, from the innermost on; all others have the first.
constexpr struct {
  std::uint32_t front, back;
} kCloth[] = {{0xb23a35ff, 0x8a4a50ff}, {0x35629eff, 0x4a5a80ff}, {0xc29a45ff, 0x8c7650ff}, {0x4a8a5aff, 0x507a62ff}};

Mesh mesh_of_surface(const DrawnSurface& surface) {
  Mesh mesh;
  mesh.vertices.reserve(6 * surface.vertices.size());
  for (const DrawnSurface::Vertex& vertex : surface.vertices) {
    mesh.vertices.insert(mesh.vertices.end(), vertex.position, vertex.position + 3);
    mesh.vertices.insert(mesh.vertices.end(), vertex.normal, vertex.normal + 3);
  }
  mesh.indices = surface.indices;
  return mesh;
}

/// Shaded by its own triangles' normals.
Mesh flat_mesh(std::span<const float> positions, std::span<const uint32_t> triangles) {
  Mesh mesh;
  for (size_t v = 0; 3 * v < positions.size(); ++v) {
    mesh.vertices.insert(mesh.vertices.end(), {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 0, 1, 0});
  }
  mesh.indices.assign(triangles.begin(), triangles.end());
  mesh.flat = true;
  return mesh;
}

Mesh coloured(Mesh mesh, const Scene& scene, size_t cloth) {
  const auto& colour = kCloth[scene.def().layered ? cloth % std::size(kCloth) : 0];
  mesh.front = colour.front;
  mesh.back = colour.back;
  return mesh;
}

Capsule capsule_at(const CapsulePose& pose, const Eigen::Vector3f& origin) {
  return {pose.a + origin, pose.b + origin, pose.radius, kBody, pose.taper};
}

}  // namespace

Eigen::Vector3d followed(const SceneDef& def, uint32_t frame) {
  if (!def.motion) return Eigen::Vector3d::Zero();
  constexpr int kSamples = 9;
  constexpr double kWindow = 0.8;  // s
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const double time = double(frame) / def.rate + kWindow * (double(i) / (kSamples - 1) - 0.5);
    sum += def.motion(std::max(0.0, time)).hips.translation();
  }
  return sum / kSamples - def.motion(0.0).hips.translation();
}

Eigen::AlignedBox3d cloth_box(const Scene& scene) {
  const Eigen::Vector3d target = followed(scene.def(), scene.frame());
  Eigen::AlignedBox3d box;
  std::vector<float> particles;
  for (size_t k = 0; k < scene.cloths().size(); ++k) {
    scene.read_particles(k, particles);
    for (size_t i = 0; i < particles.size(); i += 3) {
      box.extend(Eigen::Vector3d(particles[i], particles[i + 1], particles[i + 2]) - target);
    }
  }
  return box;
}

View::View(const Scene& scene, const Eigen::AlignedBox3d& box, float aspect) {
  camera_ = frame_box(box.cast<float>(), scene.def().view.cast<float>(), kFieldOfView, aspect);
  for (const FixedBody& body : scene.def().fixed) {
    if (const TriangleMesh* shape = body.outline()) {
      Mesh mesh = flat_mesh(shape->positions, shape->triangles);
      mesh.front = mesh.back = kBody;
      fixed_.push_back(std::move(mesh));
    }
  }
  for (size_t k = 0; k < scene.cloths().size(); ++k) surfaces_.push_back(make_surface(scene, k));
}

Frame View::bodies(const Scene& scene) const {
  Frame frame;
  const Eigen::Vector3f shift = followed(scene.def(), scene.frame()).cast<float>();
  frame.camera = camera_;
  frame.camera.eye += shift;
  frame.camera.target += shift;
  if (scene.def().ground) frame.ground = float(*scene.def().ground);
  frame.meshes = fixed_;
  for (const FixedBody& body : scene.def().fixed) {
    const auto* capsule = std::get_if<CapsulePose>(&body.shape);
    if (capsule) frame.capsules.push_back(capsule_at(*capsule, Eigen::Vector3f::Zero()));
  }
  if (!scene.body().vertices.empty()) {
    Mesh mesh = flat_mesh(scene.body().vertices, scene.def().body.triangles);
    mesh.front = mesh.back = kBody;
    frame.meshes.push_back(std::move(mesh));
  }
  for (const Eigen::Vector3d& origin : scene.def().origins) {
    for (const CapsulePose& capsule : scene.body().capsules) {
      frame.capsules.push_back(capsule_at(capsule, origin.cast<float>()));
    }
  }
  return frame;
}

Frame View::frame(const Scene& scene) {
  Frame frame = bodies(scene);
  for (size_t k = 0; k < surfaces_.size(); ++k) {
    read_vertices(scene, k, surfaces_[k]);
    frame.meshes.push_back(coloured(mesh_of_surface(surfaces_[k]), scene, k));
  }
  return frame;
}

Frame View::coarse(const Scene& scene) const {
  Frame frame = bodies(scene);
  std::vector<float> particles;
  for (size_t k = 0; k < surfaces_.size(); ++k) {
    scene.read_particles(k, particles);
    frame.meshes.push_back(coloured(flat_mesh(particles, scene.def().garment.triangles), scene, k));
    frame.meshes.back().wire = kInk;
  }
  return frame;
}

}  // namespace pleat::demo
