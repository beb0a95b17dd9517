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

/// The tree of one mesh. Bullet refits it from the corners of triangles; given the "triangle" (low, high, high) of each
/// swept box it keeps exactly those boxes. So one refit serves all poses between previous and next.
struct MeshTree {
  BodyTopology topology;
  Column<btScalar> corners;  // low and high of each triangle's swept box
  Column<int> indices;
  Box bounds;
  btTriangleIndexVertexArray boxes;
  btOptimizedBvh tree;
  BoxTree wide;  // the same, in the order of its leaves

  MeshTree(const MeshCollider& mesh, std::pmr::memory_resource* memory)
      : topology(build_body_topology(mesh, memory)), corners(memory), indices(memory), wide(memory) {
    const std::size_t count = mesh.triangles.size() / 3;
    corners.resize(6 * count);
    indices.resize(3 * count);
    for (std::size_t t = 0; t < count; ++t) {
      const int low = static_cast<int>(2 * t);
      indices[3 * t] = low;
      indices[3 * t + 1] = indices[3 * t + 2] = low + 1;
    }
    sweep(mesh);
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(count);
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = static_cast<int>(2 * count);
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(corners.data());
    part.m_vertexStride = 3 * sizeof(btScalar);
    boxes.addIndexedMesh(part);
    tree.build(&boxes, true, to_bullet(bounds.low), to_bullet(bounds.high));
    std::vector<std::uint32_t> order;
    const QuantizedNodeArray& nodes = tree.getQuantizedNodeArray();
    for (int n = 0; order.size() < count; ++n) {  // behind the last leaf is room that holds none
      if (nodes[n].isLeafNode()) order.push_back(static_cast<std::uint32_t>(nodes[n].getTriangleIndex()));
    }
    wide.build(order.data(), order.size());
    wide.refit(corners.data());
  }

  void refit(const MeshCollider& mesh) {
    sweep(mesh);
    tree.refit(&boxes, to_bullet(bounds.low), to_bullet(bounds.high));
    wide.refit(corners.data());
  }

 private:
  void sweep(const MeshCollider& mesh) {
    const ConstVec3View previous = mesh.previous.view(), next = mesh.next.view();
    bounds = Box{};
    for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
      Box box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.include(previous[mesh.triangles[3 * t + k]]);
        box.include(next[mesh.triangles[3 * t + k]]);
      }
      box = box.grown(mesh.bow);
      bounds.include(box.low);
      bounds.include(box.high);
      const float six[] = {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
      std::copy(six, six + 6, corners.data() + 6 * t);
    }
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
const BodyTopology& CollisionBodies::topology(std::size_t mesh) const { return trees_->meshes[mesh]->topology; }
const Box& CollisionBodies::swept_box(std::size_t mesh) const { return trees_->meshes[mesh]->bounds; }
const BoxTree& CollisionBodies::triangle_boxes(std::size_t mesh) const { return trees_->meshes[mesh]->wide; }

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
  struct Leaves : btNodeOverlapCallback {
    Visitor visitor;
    explicit Leaves(Visitor v) : visitor(v) {}
    void processNode(int, int triangle) override { visitor.call(visitor.visit, static_cast<std::uint32_t>(triangle)); }
  } leaves(visitor);
  trees_->meshes[mesh]->tree.reportAabbOverlappingNodex(&leaves, to_bullet(box.low), to_bullet(box.high));
}

}  // namespace pleat
