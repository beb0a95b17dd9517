#include "systems/layer_detection.h"

#include "systems/closeness.h"
#include "systems/closest_points.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// The particles of a pair, the first feature's first; [own, own + own_count) are the cloth's own.
struct Corners {
  std::uint32_t particle[4];
  int own, own_count;
};

Corners corners_of(const NearPair& pair, const Garment& own, const Garment& other) {
  if (pair.kind == NearKind::kEdges) {
    const auto &a = own.edge_particle, &b = other.edge_particle;
    return {{a[0][pair.first], a[1][pair.first], b[0][pair.second], b[1][pair.second]}, 0, 2};
  }
  const bool own_face = pair.kind == NearKind::kOtherParticleFace;
  const auto& face = (own_face ? own : other).face_particle;
  return {{pair.first, face[0][pair.second], face[1][pair.second], face[2][pair.second]},
          own_face ? 1 : 0,
          own_face ? 3 : 1};
}

}  // namespace

bool LayerDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr && t0 < t1 &&
         pairs.pairs != nullptr && pairs.count != nullptr && friction >= 0.0f && dt > 0.0f && contacts.count != nullptr;
}

void LayerDetection::run(Stats& stats) const {
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  for (NearPair* pair = pairs.pairs; pair != pairs.pairs + *pairs.count; ++pair) {
    const LayerCloth& other = clothes[pair->cloth];
    if (pair->kind == NearKind::kOtherParticleFace && other.garment->particle_area[pair->first] == 0.0f) continue;
    const Corners corners = corners_of(*pair, *garment, *other.garment);
    const auto is_own = [&](int k) { return k >= corners.own && k < corners.own + corners.own_count; };
    Vec3 x[4], before[4];
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t i = corners.particle[k];
      x[k] = is_own(k) ? position[i] : other.at(i, t1, origin);
      before[k] = is_own(k) ? previous[i] : other.at(i, t0, origin);
    }
    Closeness near;
    if (!closeness(pair->kind, x, before, pair->side, near)) continue;
    if (near.distance > 2.0f * pair->distance) continue;

    const float sign = corners.own == 0 ? 1.0f : -1.0f;  // so that the weights of the own feature sum to 1
    ContactRow row{.particle = {},
                   .weight = {},
                   .normal = near.normal * sign,
                   .offset = pair->distance,
                   .body_step = {},
                   .friction = friction,
                   .share = {},
                   .count = static_cast<std::uint32_t>(corners.own_count),
                   .push = 0.0f,
                   .rubbed = 0.0f};
    for (int k = 0; k < 4; ++k) {
      if (is_own(k)) {
        row.particle[k - corners.own] = corners.particle[k];
        row.weight[k - corners.own] = sign * near.weight[k];
      } else {
        row.offset -= near.weight[k] * dot(near.normal, x[k]);
        row.body_step += (x[k] - before[k]) * (-sign * near.weight[k]);
      }
    }
    rows.add(row, stats);
  }
}

}  // namespace pleat
