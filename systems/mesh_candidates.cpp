#include "systems/mesh_candidates.h"

#include <bit>
#include <utility>

#include "systems/contact_row.h"
#include "systems/mesh_pose.h"

namespace pleat {
namespace {

// m off its predicted path that a particle may be: twice as much as before where it was not enough, in time less.
constexpr float kLeastSlack = 0.005f, kMostSlack = 0.04f, kSlackKept = 0.9f;
constexpr float kHeadroom = 1.3f;  // of a margin that grows with the motion: cloth that falls gets faster

/// A face of the cloth, and around it what is wanted of the body as it moves against the face.
struct FaceAround {
  std::uint32_t index = 0;
  bool owns_particle[3], owns_edge[3];
  Vec3 x, normal;                                  // of a corner, m
  Vec3 drift;                                      // until the tick ends, m
  float slack = 0.0f;                              // m by which a point may come nearer than the drifts tell
  Box around, around_particle[3], around_edge[3];  // all that is wanted
  Box seen;                                        // around all of these
};

PLEAT_KERNEL BoxLanes lanes_of(const Box& box) { return {all(box.low), all(box.high)}; }

MeshSought sought_of(const MeshCollider& mesh, std::uint32_t groups) {
  return {mesh.meets(groups), mesh.thickness, mesh.depth};
}

/// Collects the candidates of one mesh.
struct Gatherer {
  const MeshCandidates& in;
  const MeshCollider& mesh;
  const BodyTopology& topology;
  std::uint32_t number;  // of the mesh
  float reach, search;   // m; of features, and of particles that start deep

  /// Of faces that lie together.
  void gather_cluster(const std::uint32_t* begin, const std::uint32_t* end) const {
    Box swept;
    float slack = 0.0f;
    for (const std::uint32_t* face = begin; face != end; ++face) {
      for (const auto& particle : in.garment->face_particle) {
        const std::uint32_t i = particle[*face];
        swept.include(in.position[i]);
        swept.include(in.position[i] + drift(i));
        slack = std::max(slack, in.candidates->slack[i]);
      }
    }
    swept = swept.grown(search + slack + box_rounding(in.origin)).moved(in.origin);
    if (!swept.overlaps(in.bodies->swept_box(number))) return;
    MeshCandidateColumns& out = *in.candidates;
    out.blocks.count = 0;
    const BoxTree& tree = in.bodies->triangle_boxes(number);
    run_wide(widest_vectors(), [&] {
      const BoxLanes around = lanes_of(swept);
      const auto near = [&](const BoxLanes& boxes) PLEAT_KERNEL_LAMBDA { return boxes.overlaps(around); };
      tree.for_each(near, [&](std::uint32_t leaf, std::uint32_t some) PLEAT_KERNEL_LAMBDA {
        if (out.blocks.count == out.blocks.room.size()) {
          out.complete = false;
        } else {
          place(tree.items(leaf), some, out.blocks.room[out.blocks.count++]);
        }
      });
    });
    for (const std::uint32_t* face = begin; face != end && out.complete; ++face) gather_face(*face);
    for (std::uint32_t b = 0; b < out.blocks.count; ++b) list_vertices(out.blocks.room[b]);
  }

 private:
  /// Of a particle, until the tick ends, m.
  Vec3 drift(std::uint32_t i) const { return in.candidates->drift.view()[i] * (1.0f - in.t1); }

  FaceAround measure(std::uint32_t face) const {
    const Garment& g = *in.garment;
    FaceAround f;
    f.index = face;
    Vec3 x[3], drifts[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t i = g.face_particle[c][face];
      x[c] = in.position[i];
      drifts[c] = drift(i);
      f.slack = std::max(f.slack, in.candidates->slack[i]);
      f.owns_particle[c] = owns_particle(g, in.inverse_mass, face, c);
      f.owns_edge[c] = owns_edge(g, face, c);
    }
    f.drift = (drifts[0] + drifts[1] + drifts[2]) * (1.0f / 3.0f);
    float spread2 = 0.0f;
    for (const Vec3& d : drifts) spread2 = std::max(spread2, dot(d - f.drift, d - f.drift));
    f.slack += box_rounding(in.origin) + 2.0f * mesh.bow + std::sqrt(spread2);
    for (std::size_t c = 0; c < 3; ++c) {
      f.around.include(x[c]);
      f.around_particle[c] = Box{x[c], x[c]}.grown(search + f.slack);
      f.around_edge[c].include(x[c]);
      f.around_edge[c].include(x[(c + 1) % 3]);
      f.around_edge[c] = f.around_edge[c].grown(reach + f.slack);
    }
    f.around = f.around.grown(reach + f.slack);
    f.seen = f.around;
    for (std::size_t c = 0; c < 3; ++c) {
      if (f.owns_particle[c]) f.seen = f.seen.with(f.around_particle[c]);
    }
    f.x = x[0];
    f.normal = normalized_or(cross(x[1] - x[0], x[2] - x[0]), Vec3{});
    return f;
  }

  void gather_face(std::uint32_t face) const {
    MeshCandidateColumns& out = *in.candidates;
    const FaceAround f = measure(face);
    std::uint32_t count = 0;
    run_wide(widest_vectors(), [&] {
      for (std::uint32_t b = 0; b < out.blocks.count; ++b) {
        MeshHits hits;
        if (!find_near(f, out.blocks.room.data()[b], hits)) continue;
        hits.block = b;
        out.hits.data()[count++] = hits;
      }
    });
    for (std::uint32_t h = 0; h < count; ++h) tell(out.blocks.room[out.hits[h].block]);
    bool room = true;
    const auto for_each = [&](const auto& near, const auto& add) {
      for (const MeshHits* h = out.hits.data(); h != out.hits.data() + count; ++h) {
        const MeshBlock& block = out.blocks.room.data()[h->block];
        for (std::uint32_t some = near(*h, block); some != 0; some &= some - 1) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(some));
          add(block, lane, mesh.triangles.data() + 3 * std::size_t{block.triangle[lane]});
        }
      }
    };
    // Feature by feature, so that the order of pairs does not depend on what else is in the lists.
    for (std::uint32_t c = 0; c < 3; ++c) {
      if (!f.owns_particle[c]) continue;
      for_each([&](const MeshHits& h, const MeshBlock&) { return std::uint32_t{h.particle[c]}; },
               [&](const MeshBlock& block, std::size_t lane, const std::uint32_t*) {
                 room = out.particles.add({3 * face + c, block.triangle[lane]}) && room;
               });
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      for_each([&](const MeshHits& h, const MeshBlock& block) { return std::uint32_t{h.vertex[k]} & block.corners[k]; },
               [&](const MeshBlock&, std::size_t, const std::uint32_t* corner) {
                 room = out.vertices.add({face, corner[k]}) && room;
               });
      for (std::uint32_t c = 0; c < 3; ++c) {
        if (!f.owns_edge[c]) continue;
        const std::uint32_t edge = in.garment->face_edge[c][face];
        const std::uint32_t end[2] = {in.garment->edge_particle[0][edge], in.garment->edge_particle[1][edge]};
        for_each(
            [&](const MeshHits& h, const MeshBlock& block) { return std::uint32_t{h.edges[c][k]} & block.edges[k]; },
            [&](const MeshBlock& block, std::size_t lane, const std::uint32_t* corner) {
              const std::uint32_t opposite = block.opposite[k][lane];
              room = out.edges.add(
                         {{end[0], end[1]}, {{corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3], opposite}}}) &&
                     room;
            });
      }
    }
    out.complete = room;
  }

  /// Which features of the triangles that are near count here.
  void tell(MeshBlock& block) const {
    for (std::uint32_t some = block.near & ~block.told; some != 0; some &= some - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(some));
      const auto bit = static_cast<std::uint8_t>(1u << lane);
      for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        Ridge ridge;
        if (topology.owns_corner(block.triangle[lane], k)) block.corners[at] |= bit;
        if (!topology.owns_edge(block.triangle[lane], k)) continue;
        if (!find_ridge(mesh, topology, block.triangle[lane], k, ridge)) continue;
        block.edges[at] |= bit, block.opposite[at][lane] = ridge.vertex[3];
      }
    }
    block.told = block.near;
  }

  /// The vertices of what is near.
  void list_vertices(const MeshBlock& block) const {
    MeshCandidateColumns& out = *in.candidates;
    const auto pose = [&](std::uint32_t v) {
      if (out.is_posed[v] != 0) return;
      out.is_posed[v] = out.posed.add(v) ? 1 : 0;
      out.complete = out.complete && out.is_posed[v] != 0;
    };
    for (std::uint32_t some = block.near; some != 0; some &= some - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(some));
      for (std::uint32_t k = 0; k < 3; ++k) {
        pose(mesh.triangles[3 * block.triangle[lane] + k]);
        if ((block.edges[k] >> lane & 1) != 0) pose(block.opposite[k][lane]);
      }
    }
  }

  /// Where those of eight triangles are whose bits are set. Other lanes are near nothing.
  PLEAT_KERNEL void place(const std::uint32_t* triangle, std::uint32_t some, MeshBlock& block) const {
    const ConstVec3View previous = mesh.previous.view(), next = mesh.next.view();
    const Vec3Lanes origin = all(in.origin);
    BoxLanes now, then;
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::uint32_t vertex[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) vertex[lane] = mesh.triangles.data()[3 * triangle[lane] + k];
      const Vec3Lanes begin = gather(previous, vertex), end = gather(next, vertex);
      block.now[k] = begin + (end - begin) * in.t1 - origin, block.then[k] = end - origin;
      now = now.with({block.now[k], block.now[k]}), then = then.with({block.then[k], block.then[k]});
    }
    std::copy_n(triangle, kLanes, block.triangle);
    block.near = block.told = 0;
    for (std::size_t k = 0; k < 3; ++k) block.corners[k] = block.edges[k] = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if ((some >> lane & 1) == 0) now.low.x[lane] = then.low.x[lane] = 1e30f;
    }
    block.now_low = now.low, block.now_high = now.high, block.then_low = then.low, block.then_high = then.high;
  }

  /// False where none is near.
  PLEAT_KERNEL bool find_near(const FaceAround& f, MeshBlock& block, MeshHits& hits) const {
    // The triangles as seen from the drifting face. Box k: what corner k sweeps.
    const Vec3Lanes drift = all(f.drift);
    const BoxLanes swept =
        BoxLanes{block.now_low, block.now_high}.with(BoxLanes{block.then_low, block.then_high}.moved(-drift));
    const LaneMask seen = swept.overlaps(lanes_of(f.seen));
    if (!any(seen)) return false;
    BoxLanes corner[3];
    Lanes low = all(1e30f), high = all(-1e30f);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3Lanes now = block.now[k], then = block.then[k] - drift;
      corner[k] = BoxLanes{now, now}.with({then, then});
      const Lanes h = dot(now - all(f.x), all(f.normal)), g = dot(then - all(f.x), all(f.normal));
      low = min(low, min(h, g)), high = max(high, max(h, g));
    }
    const Lanes height = max(low, -high) - f.slack;
    const LaneMask beside = seen & (height <= search);
    if (!any(beside)) return false;
    block.near = static_cast<std::uint8_t>(block.near | bits(beside));
    const LaneMask may_touch = beside & (height <= reach) & swept.overlaps(lanes_of(f.around));
    const BoxLanes edge[3] = {corner[0].with(corner[1]), corner[1].with(corner[2]), corner[2].with(corner[0])};
    for (std::size_t c = 0; c < 3; ++c) {
      hits.particle[c] =
          f.owns_particle[c] ? bits(beside & swept.overlaps(lanes_of(f.around_particle[c]))) : std::uint8_t{0};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      hits.vertex[k] = bits(may_touch & corner[k].overlaps(lanes_of(f.around)));
      for (std::size_t c = 0; c < 3; ++c) {
        hits.edges[c][k] =
            f.owns_edge[c] ? bits(may_touch & edge[k].overlaps(lanes_of(f.around_edge[c]))) : std::uint8_t{0};
      }
    }
    return true;
  }
};

/// How far eight particles are off their predicted paths, squared, m2.
PLEAT_KERNEL Lanes off_path2(const MeshCandidates& in, std::size_t i) {
  const MeshCandidateColumns& then = *in.candidates;
  const Vec3Lanes off =
      load(in.position, i) - load(then.anchor.view(), i) - load(then.drift.view(), i) * (in.t1 - then.t_anchor);
  return dot(off, off);
}

}  // namespace

bool MeshCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && velocity.x != nullptr &&
         inverse_mass != nullptr && bodies != nullptr && (meshes != nullptr || bodies->mesh_count() == 0) &&
         thickness >= 0.0f && dt > 0.0f && t0 >= 0.0f && t0 < t1 && t1 <= 1.0f && candidates != nullptr &&
         candidates->anchor.size() >= garment->particle_count && candidates->drift.size() >= garment->particle_count &&
         candidates->slack.size() >= garment->particle_count && candidates->ends.size() >= bodies->mesh_count() &&
         candidates->sought.size() >= bodies->mesh_count() && candidates->hits.size() >= candidates->blocks.room.size();
}

void MeshCandidates::run() const {
  MeshCandidateColumns& out = *candidates;
  const std::uint32_t count = garment->particle_count;
  const float margin = contact_margin(position, previous, count);
  // Without room for all there is no point in trying again in the same tick.
  if (t0 > 0.0f ? !out.complete || still_hold(thickness + margin)
                : out.outlast_tick && out.complete && still_hold(thickness + margin))
    return;

  adapt_slack();
  const float ticks = 1.0f / (t1 - t0) * dt;  // s, of the tick
  // What hardly moves is better looked for around where it is, and may still be there in ticks to come.
  out.outlast_tick = t0 == 0.0f && !bodies->any_mesh_moves();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 drift = velocity[i] * ticks;
    out.outlast_tick = out.outlast_tick && length(drift) <= 0.5f * kMostSlack;
    out.anchor.view().set(i, position[i]);
    out.drift.view().set(i, drift);
  }
  Box box;
  float most_slack = 0.0f;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (out.outlast_tick) {
      out.slack[i] = std::max(out.slack[i], 2.0f * length(out.drift.view()[i]));
      out.drift.view().set(i, {});
    }
    most_slack = std::max(most_slack, out.slack[i]);
    box.include(position[i]);
    box.include(position[i] + out.drift.view()[i] * (1.0f - t1));
  }
  out.garment = garment, out.origin = origin, out.revision = bodies->revision();
  out.t_anchor = t1;
  out.reach = thickness + (margin > kLeastMargin ? kHeadroom * margin : margin);
  out.particles.count = out.vertices.count = out.edges.count = out.posed.count = 0;
  out.complete = true;
  for (std::uint32_t m = 0; m < bodies->mesh_count(); ++m) {
    const MeshCollider& mesh = *meshes[m];
    const float mesh_reach = out.reach + mesh.thickness, search = mesh_search(mesh, mesh_reach, t0);
    const std::uint32_t first = out.posed.count;
    if (mesh.meets(collides_with) &&
        box.grown(search + most_slack + box_rounding(origin)).moved(origin).overlaps(bodies->swept_box(m))) {
      const Gatherer gatherer{*this, mesh, bodies->topology(m), m, mesh_reach, search};
      const std::uint32_t* begin = garment->clustered_faces.data();
      for (const std::uint32_t end : garment->cluster_end) {
        if (out.complete) gatherer.gather_cluster(begin, garment->clustered_faces.data() + end);
        begin = garment->clustered_faces.data() + end;
      }
    }
    for (const std::uint32_t v : out.posed.between(first, out.posed.count)) out.is_posed[v] = 0;
    out.ends[m] = out.so_far();
    out.sought[m] = sought_of(mesh, collides_with);
  }
}

bool MeshCandidates::still_hold(float reach) const {
  const MeshCandidateColumns& in = *candidates;
  if (in.garment != garment || in.origin != origin || in.revision != bodies->revision() || reach > in.reach)
    return false;
  for (std::uint32_t m = 0; m < bodies->mesh_count(); ++m) {
    if (in.sought[m] != sought_of(*meshes[m], collides_with)) return false;
  }
  float off2 = 0.0f;  // m2, more than the slack
  run_wide(widest_vectors(), [&] {
    off2 = largest(garment->particle_count, [&](std::size_t i) PLEAT_KERNEL_LAMBDA {
      const Lanes slack = load(in.slack.data() + i);
      return off_path2(*this, i) - slack * slack;
    });
  });
  return off2 <= 0.0f;
}

void MeshCandidates::adapt_slack() const {
  MeshCandidateColumns& out = *candidates;
  const bool told = out.garment == garment && (t0 > 0.0f || out.outlast_tick);
  run_wide(widest_vectors(), [&] {
    for (std::size_t i = 0; i < garment->particle_count; i += kLanes) {
      const Lanes slack = load(out.slack.data() + i);
      const LaneMask short_of = (told ? LaneMask{} - 1 : LaneMask{}) & (off_path2(*this, i) > slack * slack);
      store(max(all(kLeastSlack), min(all(kMostSlack), slack * (short_of ? all(2.0f) : all(kSlackKept)))),
            out.slack.data() + i);
    }
  });
}

}  // namespace pleat
