#include "systems/energy_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleat {
namespace {

constexpr float kAny = 10.0f;  // m/s: contact that pushes a deep start out, and what the strain limit makes of that

float longest_way(const ConstVec3View& from, const ConstVec3View& to, std::size_t count) {
  float most2 = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = to[i] - from[i];
    most2 = std::max(most2, dot(d, d));
  }
  return std::sqrt(most2);
}

}  // namespace

float rms_speed(std::size_t count, const float* mass, const float* inverse_mass, const ConstVec3View& velocity) {
  float energy = 0.0f, moving = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    const float m = inverse_mass[i] > 0.0f ? mass[i] : 0.0f;
    energy += m * dot(velocity[i], velocity[i]);
    moving += m;
  }
  return moving > 0.0f ? std::sqrt(energy / moving) : 0.0f;
}

bool SpeedBound::validate() const {
  return garment != nullptr && start.x != nullptr && mass != nullptr && inverse_mass != nullptr &&
         (garment->pins.size() == 0 || (pin_previous.x != nullptr && pin_next.x != nullptr)) &&
         bodies.capsules != nullptr && start_speed >= 0.0f && dt > 0.0f && substep > 0.0f;
}

float SpeedBound::least() const { return kAny + 2.0f * (start_speed + gravity * dt); }

float SpeedBound::run() const {
  float way = 0.0f;  // of the fastest body that the cloth meets, m
  const CapsuleColumns* const capsules = bodies.capsules;
  const ConstVec3View a0 = capsules->previous_a.view(), a1 = capsules->next_a.view();
  const ConstVec3View b0 = capsules->previous_b.view(), b1 = capsules->next_b.view();
  for (std::size_t i = 0; i < capsules->size(); ++i) {
    if (capsules->meets(i, bodies.collides_with)) way = std::max({way, length(a1[i] - a0[i]), length(b1[i] - b0[i])});
  }
  for (const MeshCollider* mesh : bodies.meshes) {
    if (!mesh->meets(bodies.collides_with)) continue;
    way = std::max(way, longest_way(mesh->previous.view(), mesh->next.view(), mesh->next.size()) + mesh->bow);
  }
  for (const PlaneCollider& plane : bodies.planes) {
    if (plane.meets(bodies.collides_with)) way = std::max(way, length(plane.next.position - plane.previous.position));
  }
  way += longest_way(pin_previous, pin_next, garment->pins.size());

  float excess = 0.0f, energy = 0.0f, moving = 0.0f;  // m, J, kg
  for (std::size_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = garment->edge_particle[0][e], j = garment->edge_particle[1][e];
    const float rest = garment->edge_rest_length[e], longer = length(start[j] - start[i]) - rest;
    const float carried = 0.5f * room * std::min(mass[i], mass[j]);  // no edge acts stiffer
    excess = std::max(excess, longer);
    energy += 0.5f * std::min(stiffness, carried) * longer * longer * std::max(1.0f, longer / std::max(rest, 1e-9f));
  }
  for (std::size_t t = 0; t < garment->tether_length.size(); ++t) {
    if (garment->tether_particle[t] == garment->slots.empty_place) continue;
    const Vec3 way_to_pin = start[garment->tether_pin[t]] - start[garment->tether_particle[t]];
    excess = std::max(excess, length(way_to_pin) - garment->tether_length[t]);
  }
  constexpr float kHalfTurn = std::numbers::pi_v<float>;
  for (std::size_t h = 0; h < garment->hinge_count; ++h) {
    energy += 0.5f * bend_stiffness * garment->hinge_bound[h] * kHalfTurn * kHalfTurn;
  }
  for (std::size_t i = 0; i < garment->particle_count; ++i) moving += inverse_mass[i] > 0.0f ? mass[i] : 0.0f;
  const float released = moving > 0.0f ? std::sqrt(2.0f * energy / moving) : 0.0f;
  return least() + 2.0f * (wind + way / dt + excess / substep + released);
}

}  // namespace pleat
