#include "bench/bullet_scene.h"

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "demo/input_error.h"
#include "demo/motion/turn.h"

namespace pleat::bench {
namespace {

using demo::CapsulePose;
using demo::TriangleMesh;

btVector3 bullet(const Eigen::Vector3d& v) { return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())}; }

btVector3 point(std::span<const float> positions, size_t index) {
  return {positions[3 * index], positions[3 * index + 1], positions[3 * index + 2]};
}

/// Bullet's capsules stand about their middle, along y.
btTransform place(const CapsulePose& capsule, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d a = capsule.a.cast<double>() + origin, b = capsule.b.cast<double>() + origin;
  const Eigen::Quaterniond turn = demo::turn_from_y<double>(b - a);
  return btTransform({btScalar(turn.x()), btScalar(turn.y()), btScalar(turn.z()), btScalar(turn.w())},
                     bullet(0.5 * (a + b)));
}

std::unique_ptr<btCollisionShape> shape_of(const CapsulePose& capsule) {
  const btScalar length = (capsule.b - capsule.a).norm(), radius = capsule.radius;
  if (capsule.taper == 0.0f) return std::make_unique<btCapsuleShape>(radius, length);
  const btVector3 ends[] = {{0, -length / 2, 0}, {0, length / 2, 0}};
  const btScalar radii[] = {radius, radius + capsule.taper};
  return std::make_unique<btMultiSphereShape>(ends, radii, 2);
}

}  // namespace

struct BulletScene::World {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld dynamics{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;  // the moving ones first: copy by copy, in BodyPose's order
  std::vector<std::unique_ptr<btSoftBody>> cloths;   // one a copy

  World(const demo::SceneDef& def, const BulletSettings& settings) {
    dynamics.setGravity(bullet(def.gravity));
    btSoftBodyWorldInfo& info = dynamics.getWorldInfo();
    info.m_gravity = bullet(def.gravity);
    info.air_density = 0.0f;
    info.water_density = 0.0f;
    info.m_sparsesdf.setDefaultVoxelsz(btScalar(settings.voxel_size));
  }

  ~World() {
    for (const auto& cloth : cloths) dynamics.removeSoftBody(cloth.get());
    for (const auto& body : bodies) dynamics.removeRigidBody(body.get());
  }

  btRigidBody& add_body(std::unique_ptr<btCollisionShape> shape, const btTransform& pose, float friction) {
    btRigidBody::btRigidBodyConstructionInfo info(0.0f, nullptr, shape.get());
    info.m_startWorldTransform = pose;
    info.m_friction = friction;
    shapes.push_back(std::move(shape));
    bodies.push_back(std::make_unique<btRigidBody>(info));
    dynamics.addRigidBody(bodies.back().get());
    return *bodies.back();
  }

  void add_capsule(const CapsulePose& capsule, const Eigen::Vector3d& origin, float friction, bool moves) {
    btRigidBody& body = add_body(shape_of(capsule), place(capsule, origin), friction);
    if (!moves) return;
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
  }

  void add_cloth(const demo::SceneDef& def, const Eigen::Vector3d& origin, const BulletSettings& settings) {
    const TriangleMesh& garment = def.garment;
    std::vector<btVector3> nodes;
    for (size_t i = 0; i < garment.vertex_count(); ++i) nodes.push_back(point(garment.positions, i) + bullet(origin));
    auto cloth = std::make_unique<btSoftBody>(&dynamics.getWorldInfo(), int(nodes.size()), nodes.data(), nullptr);
    for (size_t t = 0; t < garment.triangle_count(); ++t) {
      int corners[3];
      for (size_t c = 0; c < 3; ++c) corners[c] = int(garment.triangles[3 * t + c]);
      for (size_t c = 0; c < 3; ++c) cloth->appendLink(corners[c], corners[(c + 1) % 3], nullptr, true);
      cloth->appendFace(corners[0], corners[1], corners[2]);
    }
    cloth->m_materials[0]->m_kLST = btScalar(settings.stiffness);
    if (settings.bending > 0.0) {
      btSoftBody::Material* bending = cloth->appendMaterial();
      bending->m_kLST = btScalar(settings.bending);
      cloth->generateBendingConstraints(2, bending);
    }
    cloth->m_cfg.piterations = settings.iterations;
    cloth->m_cfg.kKHR = btScalar(settings.hardness);
    cloth->m_cfg.kDF = def.settings.friction;
    cloth->m_cfg.kDP = btScalar(1.0 - std::exp(-double(def.settings.air_damping) / def.rate));
    cloth->getCollisionShape()->setMargin(def.settings.thickness);
    double area = 0.0;
    for (int f = 0; f < cloth->m_faces.size(); ++f) {
      const btSoftBody::Face& face = cloth->m_faces[f];
      area += 0.5 * double((face.m_n[1]->m_x - face.m_n[0]->m_x).cross(face.m_n[2]->m_x - face.m_n[0]->m_x).length());
    }
    cloth->setTotalMass(btScalar(area) * def.settings.density, true);
    for (const uint32_t pin : def.pins) cloth->setMass(int(pin), 0.0f);
    cloth->randomizeConstraints();
    dynamics.addSoftBody(cloth.get());
    cloths.push_back(std::move(cloth));
  }
};

BulletScene::BulletScene(demo::SceneDef scene_def, const BulletSettings& settings)
    : RunningScene(std::move(scene_def)), world_(std::make_unique<World>(def(), settings)) {
  const auto is_capsule = [](const demo::FixedBody& fixed) { return std::holds_alternative<CapsulePose>(fixed.shape); };
  if (!def().body.positions.empty() || !std::ranges::all_of(def().fixed, is_capsule)) {
    throw demo::InputError(def().name, "Bullet's soft body runs scenes without bodies or with capsules here");
  }
  for (const Eigen::Vector3d& origin : def().origins) {
    for (size_t part = 0; part < body().touching; ++part) {
      world_->add_capsule(body().capsules[part], origin, 1.0f, true);
    }
  }
  for (const demo::FixedBody& fixed : def().fixed) {
    world_->add_capsule(std::get<CapsulePose>(fixed.shape), Eigen::Vector3d::Zero(), fixed.friction, false);
  }
  for (const Eigen::Vector3d& origin : def().origins) world_->add_cloth(def(), origin, settings);
  settle();
}

BulletScene::~BulletScene() = default;

void BulletScene::step() {
  for (size_t k = 0; def().motion && k < copies(); ++k) {
    const Eigen::Vector3d& origin = def().origins[k];
    for (size_t i = 0; i < def().pins.size(); ++i) {
      world_->cloths[k]->m_nodes[int(def().pins[i])].m_x = point(pin_positions(), i) + bullet(origin);
    }
    for (size_t part = 0; part < body().touching; ++part) {
      world_->bodies[k * body().touching + part]->setWorldTransform(place(body().capsules[part], origin));
    }
  }
  const btScalar dt = btScalar(1.0 / def().rate);
  world_->dynamics.stepSimulation(dt, 1, dt);
}

void BulletScene::write_particles(size_t copy, std::span<const float> positions) {
  btSoftBody& cloth = *world_->cloths[copy];
  for (int i = 0; i < cloth.m_nodes.size(); ++i) {
    btSoftBody::Node& node = cloth.m_nodes[i];
    node.m_x = node.m_q = point(positions, size_t(i));
    node.m_v = node.m_f = btVector3(0, 0, 0);
  }
  cloth.updateBounds();
}

void BulletScene::read_particles(size_t copy, std::vector<float>& positions) const {
  const btSoftBody& cloth = *world_->cloths[copy];
  positions.resize(3 * size_t(cloth.m_nodes.size()));
  for (int i = 0; i < cloth.m_nodes.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) positions[size_t(3 * i + axis)] = cloth.m_nodes[i].m_x[axis];
  }
}

std::string BulletScene::version() {
  return std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
}

}  // namespace pleat::bench
