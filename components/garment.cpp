#include "components/garment.h"

#include <algorithm>
#include <map>
#include <vector>

#include "components/creases.h"
#include "components/edge_order.h"
#include "components/face_clusters.h"
#include "components/hinge_stiffness.h"
#include "components/rest_curve.h"
#include "components/tethers.h"

namespace pleat {
namespace {

float triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5f * length(cross(b - a, c - a)); }

void add_particles(const GarmentInput& input, Garment& g) {
  g.particle_count = static_cast<std::uint32_t>(input.positions.size());
  g.rest_position.resize(g.particle_count);
  for (std::size_t i = 0; i < g.particle_count; ++i) g.rest_position.view().set(i, input.positions[i]);
  g.uv.resize(input.uvs.size());
  std::copy(input.uvs.begin(), input.uvs.end(), g.uv.begin());
  g.particle_area.resize(g.particle_count);
  g.added_mass.resize(g.particle_count);
  std::copy(input.added_mass.begin(), input.added_mass.end(), g.added_mass.begin());
  g.pinned.resize(g.particle_count);
  g.pins.resize(input.pins.size());
  std::copy(input.pins.begin(), input.pins.end(), g.pins.begin());
  for (const std::uint32_t pin : input.pins) g.pinned[pin] = 1;
}

void add_faces(const GarmentInput& input, Garment& g) {
  g.face_count = static_cast<std::uint32_t>(input.triangles.size());
  g.face_rest_area.resize(g.face_count);
  for (int k = 0; k < 3; ++k) g.face_particle[k].resize(g.face_count), g.face_edge[k].resize(g.face_count);
  double area = 0.0;
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const Triangle& t = input.triangles[f];
    const float a = triangle_area(input.positions[t[0]], input.positions[t[1]], input.positions[t[2]]);
    g.face_rest_area[f] = a;
    area += a;
    for (std::size_t k = 0; k < 3; ++k) {
      g.face_particle[k][f] = t[k];
      g.particle_area[t[k]] += a / 3.0f;
    }
  }
  g.area = static_cast<float>(area);

  g.around_begin.resize(std::size_t{g.particle_count} + 1);
  g.faces_around.resize(std::size_t{3} * g.face_count);
  for (const Triangle& t : input.triangles) {
    for (const std::uint32_t v : t) ++g.around_begin[v + 1];
  }
  for (std::uint32_t i = 0; i < g.particle_count; ++i) g.around_begin[i + 1] += g.around_begin[i];
  std::vector<std::uint32_t> next(g.around_begin.begin(), g.around_begin.end());
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    for (const std::uint32_t v : input.triangles[f]) g.faces_around[next[v]++] = f;
  }
}

/// Of the particles with a face, the one nearest to the middle of all of them.
std::uint32_t middle_of(const Garment& g) {
  const ConstVec3View x = g.rest_position.view();
  std::vector<std::uint32_t> used;
  Vec3 sum;
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (g.particle_area[i] > 0.0f) used.push_back(i), sum += x[i];
  }
  const Vec3 middle = sum * (1.0f / static_cast<float>(used.size()));
  return *std::ranges::min_element(used, {}, [&](std::uint32_t i) { return length(x[i] - middle); });
}

void gather_strays(Garment& g) {
  g.stray_on = middle_of(g);
  const Vec3View x = g.rest_position.view();
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (g.particle_area[i] > 0.0f || g.pinned[i] != 0) continue;
    g.strays.push_back(i);
    x.set(i, x[g.stray_on]);
  }
}

/// Edges between two pins are left out: nothing moves their ends.
void add_slots(const std::vector<EdgeEnds>& all, Garment& g) {
  std::vector<EdgeEnds> edges;
  std::vector<float> lengths;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    if (g.pinned[all[e][0]] != 0 && g.pinned[all[e][1]] != 0) continue;
    edges.push_back(all[e]);
    lengths.push_back(g.edge_rest_length[e]);
  }
  fill_slots(g.particle_count, edges, lengths, g.slots);
}

/// Where edges begin to be solved: the pins or, without any, the particle in the middle.
std::vector<std::uint32_t> roots_of(const Garment& g) {
  if (g.pins.size() == 0) return {middle_of(g)};
  return {g.pins.begin(), g.pins.end()};
}

void add_edges(const GarmentInput& input, Garment& g) {
  std::vector<EdgeEnds> edges;
  const auto side = [&](std::uint32_t f, std::uint32_t k) {
    const std::uint32_t a = input.triangles[f][k], b = input.triangles[f][(k + 1) % 3];
    return EdgeEnds{std::min(a, b), std::max(a, b)};
  };
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) edges.push_back(side(f, k));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  order_edges(g.particle_count, roots_of(g), edges);

  g.edge_count = static_cast<std::uint32_t>(edges.size());
  for (int k = 0; k < 2; ++k) g.edge_particle[k].resize(g.edge_count), g.edge_face[k].resize(g.edge_count);
  g.edge_rest_length.resize(g.edge_count);
  g.edge_rest_curve_length.resize(g.edge_count);
  g.edges_at.resize(g.particle_count);
  std::map<EdgeEnds, std::uint32_t> index;
  double total = 0.0;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const auto [i, j] = edges[e];
    index[edges[e]] = e;
    g.edge_particle[0][e] = i, g.edge_particle[1][e] = j;
    g.edge_face[0][e] = g.edge_face[1][e] = kNone;
    ++g.edges_at[i], ++g.edges_at[j];
    g.edge_rest_length[e] = length(input.positions[j] - input.positions[i]);
    total += g.edge_rest_length[e];
  }
  g.mean_edge_length = static_cast<float>(total / g.edge_count);
  add_slots(edges, g);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t e = index[side(f, k)];
      g.face_edge[k][f] = e;
      g.edge_face[g.edge_face[0][e] == kNone ? 0 : 1][e] = f;
    }
  }
  g.border_edge_count = static_cast<std::uint32_t>(std::count(g.edge_face[1].begin(), g.edge_face[1].end(), kNone));
}

void add_hinges(Garment& g) {
  g.hinge_count = g.edge_count - g.border_edge_count;
  for (auto& column : g.hinge_particle) column.resize(g.hinge_count);
  g.hinge_rest_angle.resize(g.hinge_count);

  const ConstVec3View x = std::as_const(g.rest_position).view();
  std::uint32_t h = 0;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t fa = g.edge_face[0][e], fb = g.edge_face[1][e];
    if (fb == kNone) continue;
    const auto side_of = [&](std::uint32_t f) {
      std::uint32_t k = 0;
      while (g.face_edge[k][f] != e) ++k;
      return k;
    };
    const std::uint32_t ka = side_of(fa), kb = side_of(fb);
    const std::uint32_t p[4] = {g.face_particle[ka][fa], g.face_particle[(ka + 1) % 3][fa],
                                g.face_particle[(ka + 2) % 3][fa], g.face_particle[(kb + 2) % 3][fb]};
    for (std::size_t k = 0; k < 4; ++k) g.hinge_particle[k][h] = p[k];

    const Vec3 edge = x[p[1]] - x[p[0]];
    const Vec3 na = cross(edge, x[p[2]] - x[p[0]]), nb = cross(x[p[3]] - x[p[0]], edge);
    g.hinge_rest_angle[h] = std::atan2(dot(cross(na, nb), normalized_or(edge, {})), dot(na, nb));
    ++h;
  }
}

}  // namespace

Garment::Garment(std::pmr::memory_resource* m)
    : rest_position(m),
      uv(m),
      particle_area(m),
      added_mass(m),
      pinned(m),
      pins(m),
      edges_at(m),
      strays(m),
      face_particle{Column<std::uint32_t>(m), Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
      face_edge{Column<std::uint32_t>(m), Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
      face_rest_area(m),
      clustered_faces(m),
      cluster_end(m),
      edge_particle{Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
      edge_face{Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
      edge_rest_length(m),
      edge_rest_curve_length(m),
      slots(m),
      coarse(m),
      tether_particle(m),
      tether_pin(m),
      tether_length(m),
      hinge_particle{Column<std::uint32_t>(m), Column<std::uint32_t>(m), Column<std::uint32_t>(m),
                     Column<std::uint32_t>(m)},
      hinge_rest_angle(m),
      hinge_shape(m),
      hinge_coupling{Column<float>(m), Column<float>(m), Column<float>(m), Column<float>(m)},
      hinge_beside{Column<std::uint32_t>(m), Column<std::uint32_t>(m), Column<std::uint32_t>(m),
                   Column<std::uint32_t>(m)},
      hinge_bound(m),
      edge_is_crease(m),
      face_normal{Column<std::uint32_t>(m), Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
      edge_normal{Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
      part_particle(m),
      end_part{Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
      around_begin(m),
      faces_around(m) {}

Garment build_garment(const GarmentInput& input, std::pmr::memory_resource* memory) {
  Garment garment(memory);
  add_particles(input, garment);
  add_faces(input, garment);
  find_face_clusters(garment);
  gather_strays(garment);
  add_edges(input, garment);
  add_hinges(garment);
  measure_hinges(garment);
  measure_tethers(garment);
  add_coarse_levels(garment);
  find_creases(input.seams, input.crease_angle, garment);
  measure_rest_curves(garment);
  return garment;
}

}  // namespace pleat
