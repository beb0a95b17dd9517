// What the contact tests share: cloths made of a few triangles, bodies, and the steps of a substep around contact.
#pragma once

#include <map>
#include <memory_resource>
#include <utility>
#include <vector>

#include "components/capsule_block.h"
#include "components/capsule_candidates.h"
#include "components/colliders.h"
#include "components/contacts.h"
#include "components/garment.h"
#include "components/lanes.h"
#include "systems/contact_row.h"

namespace pleat::test {

inline std::pmr::memory_resource* memory() { return std::pmr::new_delete_resource(); }

/// run(positions side by side), as sweeps have them.
template <class Run>
void with_packed(Vec3View position, const Column<float>& inverse_mass, const Run& run) {
  Column<Vec4> packed(memory());
  packed.resize(padded(inverse_mass.size()) + 2);
  pack(position, inverse_mass.data(), inverse_mass.size(), packed.data());
  run(packed);
  unpack(packed.data(), inverse_mass.size(), position);
}

/// A cloth with everything that contact reads and writes. Particles weigh 1 g and start at rest where they were built.
struct ContactCloth {
  Garment garment;
  Vec3Column position{memory()}, previous{memory()}, velocity{memory()}, predicted{memory()}, force{memory()};
  Column<float> inverse_mass{memory()};
  CapsuleCandidateColumns candidates{memory()};
  Column<CapsuleBlock> blocks{memory()};
  Column<Vec4> packed_now{memory()}, packed_before{memory()};
  std::vector<ContactRow> rows = std::vector<ContactRow>(4096);
  std::uint32_t row_count = 0;

  ContactCloth(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
               const std::vector<std::uint32_t>& pins = {})
      : garment(build_garment({positions, triangles, {}, pins, {}}, memory())) {
    for (Vec3Column* c : {&position, &previous, &velocity, &predicted, &force}) c->resize(positions.size());
    inverse_mass.resize(positions.size());
    packed_now.resize(positions.size()), packed_before.resize(positions.size());
    for (std::uint32_t i = 0; i < garment.particle_count; ++i) {
      put(i, positions[i], positions[i]);
      inverse_mass[i] = garment.pinned[i] != 0 ? 0.0f : 1000.0f;
    }
  }
  void put(std::uint32_t i, const Vec3& now, const Vec3& before) {
    position.view().set(i, now);
    previous.view().set(i, before);
  }
  const Vec4* packed_position() {
    pack(position.view(), inverse_mass.data(), inverse_mass.size(), packed_now.data());
    return packed_now.data();
  }
  const Vec4* packed_previous() {
    pack(previous.view(), nullptr, inverse_mass.size(), packed_before.data());
    return packed_before.data();
  }
  float margin() const { return capsule_margin(position.view(), previous.view(), garment.particle_count); }
  Vec3 x(std::uint32_t i) const { return position.view()[i]; }
  /// system.run(...) on the packed positions.
  template <class System, class... Counters>
  void run(System system, Counters&... counters) {
    with_packed(position.view(), inverse_mass, [&](Column<Vec4>& packed) {
      system.position = packed.data();
      system.run(counters...);
    });
  }
  ContactList contacts() { return {rows.data(), static_cast<std::uint32_t>(rows.size()), &row_count}; }
};

/// Makes every feature of a cloth a candidate for every capsule.
inline void list_everything(const Garment& g, std::uint32_t capsules, CapsuleCandidateColumns& candidates) {
  for (std::uint32_t c = 0; c < capsules; ++c) {
    for (const FeatureKind kind : kFeatureKinds) candidates.of(c, kind) = {NearFeatures::kAll, count_of(g, kind)};
  }
}

/// A mesh that stands still at `positions`.
inline MeshCollider make_body(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles) {
  MeshCollider mesh(memory());
  mesh.previous.resize(positions.size());
  mesh.next.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    mesh.previous.view().set(i, positions[i]);
    mesh.next.view().set(i, positions[i]);
  }
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) mesh.triangles.push_back(v);
  }
  return mesh;
}

struct BodyShape {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

/// 20 * 4^level triangles with corners on the sphere around the origin.
inline BodyShape icosphere(int level, float radius) {
  const float g = (1.0f + std::sqrt(5.0f)) / 2.0f;
  BodyShape s{{{-1, g, 0},
               {1, g, 0},
               {-1, -g, 0},
               {1, -g, 0},
               {0, -1, g},
               {0, 1, g},
               {0, -1, -g},
               {0, 1, -g},
               {g, 0, -1},
               {g, 0, 1},
               {-g, 0, -1},
               {-g, 0, 1}},
              {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(s.positions.size()));
      if (fresh) s.positions.push_back((s.positions[a] + s.positions[b]) * 0.5f);
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(t);
    }
    s.triangles = finer;
  }
  for (Vec3& p : s.positions) p = normalized_or(p, Vec3{}) * radius;
  return s;
}

/// An axis-aligned box around the origin, 12 triangles.
inline BodyShape box_shape(const Vec3& half) {
  BodyShape s;
  for (unsigned i = 0; i < 8; ++i) {
    s.positions.push_back({i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  }
  s.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return s;
}

}  // namespace pleat::test
