#include "systems/frequency_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "components/hinge_gradient.h"

namespace pleat {
namespace {

constexpr float kSpare = 0.8f;  // of the longest stable step

/// Magnitudes of a hinge's gradient at rest, 1/m; see HingeBending. Zero for one that bends nothing.
std::array<float, 4> gradient(const Garment& g, std::uint32_t h) {
  const ConstVec3View x = g.rest_position.view();
  const auto at = [&](std::size_t k) { return x[g.hinge_particle[k][h]]; };
  const HingeGradient<float> hinge(at(0), at(1), at(2), at(3));
  if (!hinge.has_extent) return {};
  return {length(hinge.at[0]), length(hinge.at[1]), length(hinge.at[2]), length(hinge.at[3])};
}

float sum(const std::array<float, 4>& size) { return size[0] + size[1] + size[2] + size[3]; }

}  // namespace

bool FrequencyBound::validate() const { return garment != nullptr && inverse_mass != nullptr; }

FrequencyRates FrequencyBound::run() const {
  const Garment& g = *garment;
  std::vector<float> damping(g.particle_count), bend(g.particle_count), bend_damping(g.particle_count);
  std::vector<float> sums(g.hinge_count);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    const float weight = inverse_mass[i] + inverse_mass[j];
    if (weight > 0.0f) damping[i] += 1.0f / weight, damping[j] += 1.0f / weight;
  }
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) sums[h] = sum(gradient(g, h));
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    const std::array<float, 4> size = gradient(g, h);
    float moved = g.hinge_shape[h] * sums[h];
    for (std::size_t k = 0; k < 4; ++k) moved += std::abs(g.hinge_coupling[k][h]) * sums[g.hinge_beside[k][h]];
    float yielding = 0.0f;
    for (std::size_t k = 0; k < 4; ++k) yielding += inverse_mass[g.hinge_particle[k][h]] * size[k] * size[k];
    if (yielding == 0.0f) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      bend[g.hinge_particle[k][h]] += size[k] * moved;
      bend_damping[g.hinge_particle[k][h]] += size[k] * sums[h] / yielding;
    }
  }
  FrequencyRates rates;
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    const float w = inverse_mass[i];
    rates.stretch = std::max(rates.stretch, 2.0f * w * static_cast<float>(g.edges_at[i]));
    rates.bend = std::max(rates.bend, w * bend[i]);
    rates.edge_damping = std::max(rates.edge_damping, 2.0f * w * damping[i]);
    rates.bend_damping = std::max(rates.bend_damping, w * bend_damping[i]);
  }
  return rates;
}

bool StableStep::validate() const {
  return stiffness >= 0.0f && bend_stiffness >= 0.0f && edge_damping >= 0.0f && bend_damping >= 0.0f &&
         air_damping >= 0.0f;
}

float StableStep::room(float dt) const {
  // As EdgeDamping, HingeBending and AirDamping bound them.
  const float safe = 0.2f / dt;
  const float c = rates.edge_damping * std::min(edge_damping, safe) +
                  rates.bend_damping * std::min(bend_damping, safe) + std::min(air_damping, 0.5f / dt);
  const float fastest = 2.6f * kSpare / dt;
  const float alone =
      scheme == Scheme::kRungeKutta4 ? fastest * (fastest - c) : (4.0f * kSpare * kSpare - 2.0f * c * dt) / (dt * dt);
  // Damping at its bounds leaves little: then it, and not the spring, is what has to give way.
  const float least = 0.25f / (dt * dt);
  return std::max({alone - bend_stiffness * rates.bend, 0.5f * alone, least});
}

std::uint32_t StableStep::run(float dt, std::uint32_t least, std::uint32_t most) const {
  const float wanted = stiffness * rates.stretch;
  for (std::uint32_t n = least; n <= most; ++n) {
    const float step = dt / static_cast<float>(n);
    const bool bends = bend_stiffness * rates.bend <= 2.0f * kSpare * kSpare / (step * step);
    if (wanted <= room(step) && bends) return n;
  }
  return most + 1;
}

}  // namespace pleat
