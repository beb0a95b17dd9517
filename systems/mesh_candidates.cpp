#include "systems/mesh_candidates.h"

#include "systems/contact_row.h"
#include "systems/mesh_pose.h"

namespace pleat {
namespace {

constexpr float kSlack = 0.01f;     // m off its predicted path that a particle may be
constexpr float kRounding = 1e-5f;  // m

/// Collects the candidates of one mesh.
struct Gatherer {
  const MeshCandidates& in;
  MeshPose pose;
  std::uint32_t mesh;
  float reach, search;  // m; of features, and of particles that start deep

  void gather_face(std::uint32_t face) const {
    Face f;
    Vec3 drift[3];
    Box swept;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t i = in.garment->face_particle[c][face];
      f.x[c] = in.position[i];
      drift[c] = in.candidates->drift.view()[i] * (1.0f - in.t1);
      swept.include(f.x[c]);
      swept.include(f.x[c] + drift[c]);
    }
    f.own = features_of_face(*in.garment, in.inverse_mass, face);
    f.drift = (drift[0] + drift[1] + drift[2]) * (1.0f / 3.0f);
    float spread2 = 0.0f;
    for (const Vec3& d : drift) spread2 = std::max(spread2, dot(d - f.drift, d - f.drift));
    f.slack = kSlack + kRounding + 2.0f * pose.mesh.bow + std::sqrt(spread2);
    for (std::size_t c = 0; c < 3; ++c) {
      f.around.include(f.x[c]);
      f.around_particle[c] = Box{f.x[c], f.x[c]}.grown(search + f.slack);
      f.around_edge[c].include(f.x[c]);
      f.around_edge[c].include(f.x[(c + 1) % 3]);
      f.around_edge[c] = f.around_edge[c].grown(reach + f.slack);
    }
    f.around = f.around.grown(reach + f.slack);
    f.normal = normalized_or(cross(f.x[1] - f.x[0], f.x[2] - f.x[0]), Vec3{});
    const Box box = swept.grown(search + kSlack + kRounding);
    if (!box.moved(in.origin).overlaps(in.bodies->swept_box(mesh))) return;
    in.bodies->for_each_triangle(mesh, box.moved(in.origin), [&](std::uint32_t t) { consider(f, face, t); });
  }

 private:
  struct Face {
    Vec3 x[3];
    Vec3 normal, drift;
    float slack = 0.0f;                              // m by which a point may come nearer than the drifts tell
    Box around, around_particle[3], around_edge[3];  // all that is wanted
    std::uint32_t own = 0;
  };

  void consider(const Face& f, std::uint32_t face, std::uint32_t t) const {
    // The triangle now and at the end of the tick, as seen from the drifting face.
    Vec3 now[3], then[3];
    float low = 1e30f, high = -1e30f;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = pose.corner(t, k);
      now[k] = pose.vertex(v);
      then[k] = pose.next_vertex(v) - f.drift;
      for (const Vec3& p : {now[k], then[k]}) {
        const float height = dot(p - f.x[0], f.normal);
        low = std::min(low, height);
        high = std::max(high, height);
      }
    }
    const float height = std::max(low, -high) - f.slack;
    if (height > search) return;
    std::uint32_t wanted = f.own & features_of_body(pose.topology, t);
    if (height > reach) wanted &= MeshCandidate::kParticles;
    // Box k: what edge k of the triangle sweeps.
    Box corner[3], edge[3], all;
    for (int k = 0; k < 3; ++k) {
      corner[k].include(now[k]);
      corner[k].include(then[k]);
      all.include(now[k]);
      all.include(then[k]);
    }
    for (int k = 0; k < 3; ++k) edge[k] = corner[k].with(corner[(k + 1) % 3]);
    std::uint32_t near = 0;
    for (; wanted != 0; wanted &= wanted - 1) {
      const auto [kind, c, k] = MeshCandidate::first(wanted);
      const bool meet = kind == MeshCandidate::Kind::kParticle ? f.around_particle[c].overlaps(all)
                        : kind == MeshCandidate::Kind::kVertex ? f.around.overlaps(corner[k])
                                                               : f.around_edge[c].overlaps(edge[k]);
      if (meet) near |= wanted & (~wanted + 1);
    }
    if (near == 0) return;
    MeshCandidateColumns& out = *in.candidates;
    if (out.count == out.pairs.size()) {
      out.complete = false;
    } else {
      out.pairs[out.count++] = {mesh, face, t, near};
    }
  }
};

}  // namespace

bool MeshCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && velocity.x != nullptr &&
         inverse_mass != nullptr && bodies != nullptr && (meshes != nullptr || bodies->mesh_count() == 0) &&
         thickness >= 0.0f && dt > 0.0f && t0 >= 0.0f && t0 < t1 && t1 <= 1.0f && candidates != nullptr &&
         candidates->anchor.size() >= garment->particle_count && candidates->drift.size() >= garment->particle_count;
}

void MeshCandidates::run() const {
  MeshCandidateColumns& out = *candidates;
  const std::uint32_t count = garment->particle_count;
  const float reach = thickness + contact_margin(position, previous, count);
  const auto still_hold = [&] {
    if (reach > out.reach) return false;
    const ConstVec3View anchor = out.anchor.view(), drift = out.drift.view();
    float off2 = 0.0f;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3 off = position[i] - anchor[i] - drift[i] * (t1 - out.t_anchor);
      off2 = std::max(off2, dot(off, off));
    }
    return off2 <= kSlack * kSlack;
  };
  // Without room for all there is no point in trying again in the same tick.
  if (t0 > 0.0f && (!out.complete || still_hold())) return;

  const float ticks = 1.0f / (t1 - t0) * dt;  // s, of the tick
  Box box;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 drift = velocity[i] * ticks;
    out.anchor.view().set(i, position[i]);
    out.drift.view().set(i, drift);
    box.include(position[i]);
    box.include(position[i] + drift * (1.0f - t1));
  }
  out.t_anchor = t1;
  out.reach = reach;
  out.count = 0;
  out.complete = true;
  for (std::uint32_t m = 0; m < bodies->mesh_count(); ++m) {
    const MeshCollider& mesh = *meshes[m];
    const float mesh_reach = reach + mesh.thickness, search = mesh_search(mesh, mesh_reach, t0);
    if (!mesh.enabled || !box.grown(search + kSlack + kRounding).moved(origin).overlaps(bodies->swept_box(m))) continue;
    const Gatherer gatherer{*this, {mesh, bodies->topology(m), t0, t1, origin}, m, mesh_reach, search};
    for (std::uint32_t f = 0; f < garment->face_count && out.complete; ++f) gatherer.gather_face(f);
  }
}

}  // namespace pleat
