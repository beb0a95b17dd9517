#include "systems/collision_bodies.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <vector>

namespace pleat {
namespace {

static_assert(sizeof(btScalar) == 4, "Bullet must be the single precision build: it decides the layout of its types");

constexpr float kSlack = 0.05f;  // m by which a capsule's box is filed too large, so that small moves keep its place

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }
btDbvtVolume to_volume(const Box& box) { return btDbvtVolume::FromMM(to_bullet(box.low), to_bullet(box.high)); }

Box swept_box_of(const CapsuleColumns& capsules, std::size_t i) {
  Box box;
  for (const Vec3Column* end : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
    box.include(end->view()[i]);
  }
  return box.grown(capsules.radius[i] + std::max(capsules.taper[i], 0.0f) + capsules.thickness[i]);
}

/// The tree of one mesh. Bullet says once which triangles lie together, as it files the swept boxes at that time, each
/// as the "triangle" (low, high, high); BoxTree keeps that order and follows the boxes as they move, in a fraction of
/// the time in which Bullet does. One refit serves all poses between previous and next.
struct MeshTree {
  BodyTopology topology;
  BoxTree tree;
  Box bounds;
  bool moves = false;

  MeshTree(const MeshCollider& mesh, std::pmr::memory_resource* memory)
      : topology(build_body_topology(mesh, memory)), tree(memory) {
    const std::size_t count = mesh.triangles.size() / 3;
    Column<btScalar> corners(memory);
    Column<int> indices(memory);
    corners.resize(6 * count);
    indices.resize(3 * count);
    Box all_of_it;
    for (std::size_t t = 0; t < count; ++t) {
      Box box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.include(mesh.previous.view()[mesh.triangles[3 * t + k]]);
        box.include(mesh.next.view()[mesh.triangles[3 * t + k]]);
      }
      const float six[] = {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
      std::copy(six, six + 6, corners.data() + 6 * t);
      all_of_it.include(box.low);
      all_of_it.include(box.high);
      const int low = static_cast<int>(2 * t);
      indices[3 * t] = low;
      indices[3 * t + 1] = indices[3 * t + 2] = low + 1;
    }
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(count);
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = static_cast<int>(2 * count);
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(corners.data());
    part.m_vertexStride = 3 * sizeof(btScalar);
    btTriangleIndexVertexArray boxes;
    boxes.addIndexedMesh(part);
    btOptimizedBvh bullet;
    bullet.build(&boxes, true, to_bullet(all_of_it.low), to_bullet(all_of_it.high));
    std::vector<std::uint32_t> order;
    const QuantizedNodeArray& nodes = bullet.getQuantizedNodeArray();
    for (int n = 0; order.size() < count; ++n) {  // behind the last leaf is room that holds none
      if (nodes[n].isLeafNode()) order.push_back(static_cast<std::uint32_t>(nodes[n].getTriangleIndex()));
    }
    tree.build(order.data(), order.size());
    refit(mesh);
  }

  void refit(const MeshCollider& mesh) {
    const ConstVec3View previous = mesh.previous.view(), next = mesh.next.view();
    LaneMask moved{};
    tree.refit([&](const std::uint32_t* triangle) PLEAT_KERNEL_LAMBDA {
      BoxLanes box;
      for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t vertex[kLanes];
        for (std::size_t lane = 0; lane < kLanes; ++lane) vertex[lane] = mesh.triangles.data()[3 * triangle[lane] + k];
        const Vec3Lanes begin = gather(previous, vertex), end = gather(next, vertex);
        moved |= (begin.x != end.x) | (begin.y != end.y) | (begin.z != end.z);
        for (const Vec3Lanes& p : {begin, end}) {
          box.low = {min(box.low.x, p.x), min(box.low.y, p.y), min(box.low.z, p.z)};
          box.high = {max(box.high.x, p.x), max(box.high.y, p.y), max(box.high.z, p.z)};
        }
      }
      return box.grown(all(mesh.bow));
    });
    bounds = tree.bounds();
    moves = any(moved) || mesh.bow != 0.0f;
  }
};

}  // namespace

struct CollisionBodies::Trees {
  std::pmr::memory_resource* memory;
  btDbvt capsules;
  std::vector<btDbvtNode*> leaves;  // one a capsule, null where it is disabled
  std::vector<std::unique_ptr<MeshTree>> meshes;
  std::uint64_t revision = 0;  // of the meshes
};

CollisionBodies::CollisionBodies(std::pmr::memory_resource* memory) : trees_(std::make_unique<Trees>()) {
  trees_->memory = memory;
}
CollisionBodies::~CollisionBodies() = default;
CollisionBodies::CollisionBodies(CollisionBodies&&) noexcept = default;
CollisionBodies& CollisionBodies::operator=(CollisionBodies&&) noexcept = default;

void CollisionBodies::update_capsules(const CapsuleColumns& capsules) {
  btDbvt& tree = trees_->capsules;
  std::vector<btDbvtNode*>& leaves = trees_->leaves;
  for (std::size_t i = capsules.size(); i < leaves.size(); ++i) {
    if (leaves[i] != nullptr) tree.remove(leaves[i]);
  }
  leaves.resize(capsules.size(), nullptr);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (capsules.enabled[i] == 0) {
      if (leaves[i] != nullptr) tree.remove(leaves[i]);
      leaves[i] = nullptr;
      continue;
    }
    btDbvtVolume volume = to_volume(swept_box_of(capsules, i));
    if (leaves[i] != nullptr) {
      tree.update(leaves[i], volume, kSlack);
    } else {
      volume.Expand({kSlack, kSlack, kSlack});
      leaves[i] = tree.insert(volume, nullptr);
      leaves[i]->dataAsInt = static_cast<int>(i);
    }
  }
}

void CollisionBodies::add_mesh(const MeshCollider& mesh) {
  trees_->meshes.push_back(std::make_unique<MeshTree>(mesh, trees_->memory));
  ++trees_->revision;
}

void CollisionBodies::remove_mesh(std::size_t index) {
  trees_->meshes.erase(trees_->meshes.begin() + static_cast<std::ptrdiff_t>(index));
  ++trees_->revision;
}

void CollisionBodies::update_mesh(std::size_t index, const MeshCollider& mesh) {
  trees_->meshes[index]->refit(mesh);
  ++trees_->revision;
}

std::size_t CollisionBodies::mesh_count() const { return trees_->meshes.size(); }
std::uint64_t CollisionBodies::revision() const { return trees_->revision; }
bool CollisionBodies::any_mesh_moves() const {
  return std::ranges::any_of(trees_->meshes, [](const auto& mesh) { return mesh->moves; });
}
const BodyTopology& CollisionBodies::topology(std::size_t mesh) const { return trees_->meshes[mesh]->topology; }
const Box& CollisionBodies::swept_box(std::size_t mesh) const { return trees_->meshes[mesh]->bounds; }
const BoxTree& CollisionBodies::triangle_boxes(std::size_t mesh) const { return trees_->meshes[mesh]->tree; }

void CollisionBodies::find_capsules(const Box& box, Visitor visitor) const {
  struct Leaves : btDbvt::ICollide {
    Visitor visitor;
    explicit Leaves(Visitor v) : visitor(v) {}
    void Process(const btDbvtNode* leaf) override {
      visitor.call(visitor.visit, static_cast<std::uint32_t>(leaf->dataAsInt));
    }
  } leaves(visitor);
  trees_->capsules.collideTV(trees_->capsules.m_root, to_volume(box), leaves);
}

void CollisionBodies::find_triangles(std::size_t mesh, const Box& box, Visitor visitor) const {
  const BoxTree& tree = trees_->meshes[mesh]->tree;
  run_wide(widest_vectors(), [&] {
    const BoxLanes around{all(box.low), all(box.high)};
    const auto near = [&](const BoxLanes& boxes) PLEAT_KERNEL_LAMBDA { return boxes.overlaps(around); };
    tree.for_each(near, [&](std::uint32_t leaf, std::uint32_t some) PLEAT_KERNEL_LAMBDA {
      for (; some != 0; some &= some - 1) visitor.call(visitor.visit, tree.items(leaf)[std::countr_zero(some)]);
    });
  });
}

}  // namespace pleat
