#include "components/creases.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pleat {
namespace {

std::uint32_t find_edge(const Garment& g, std::array<std::uint32_t, 2> ends) {
  std::sort(ends.begin(), ends.end());
  for (std::uint32_t k = g.around_begin[ends[0]]; k < g.around_begin[ends[0] + 1]; ++k) {
    for (const auto& side : g.face_edge) {
      const std::uint32_t e = side[g.faces_around[k]];
      if (g.edge_particle[0][e] == ends[0] && g.edge_particle[1][e] == ends[1]) return e;
    }
  }
  return kNone;
}

void mark_creases(std::span<const std::array<std::uint32_t, 2>> seams, float crease_angle, Garment& g) {
  g.edge_is_crease.resize(g.edge_count);
  std::uint32_t hinge = 0;  // one for each inner edge, in the edges' order
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    if (g.edge_face[1][e] == kNone) continue;
    if (std::abs(g.hinge_rest_angle[hinge++]) > crease_angle) g.edge_is_crease[e] = 1;
  }
  for (const std::array<std::uint32_t, 2>& seam : seams) {
    const std::uint32_t e = find_edge(g, seam);
    if (e != kNone && g.edge_face[1][e] != kNone) g.edge_is_crease[e] = 1;
  }
  g.crease_count = static_cast<std::uint32_t>(std::count(g.edge_is_crease.begin(), g.edge_is_crease.end(), 1));
}

std::uint32_t corner_at(const Garment& g, std::uint32_t face, std::uint32_t particle) {
  std::uint32_t k = 0;
  while (g.face_particle[k][face] != particle) ++k;
  return k;
}

/// Which of the faces around a particle hang together across edges that are no creases: a part's number for each, and
/// how many parts there are.
std::uint32_t label_parts(const Garment& g, std::uint32_t particle, std::vector<std::uint32_t>& part) {
  const std::uint32_t* faces = g.faces_around.begin() + g.around_begin[particle];
  const std::uint32_t count = g.around_begin[particle + 1] - g.around_begin[particle];
  part.assign(count, kNone);
  std::uint32_t parts = 0;
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < count; ++first) {
    if (part[first] != kNone) continue;
    part[first] = parts;
    open.assign(1, first);
    while (!open.empty()) {
      const std::uint32_t face = faces[open.back()], corner = corner_at(g, face, particle);
      open.pop_back();
      for (const std::uint32_t side : {corner, (corner + 2) % 3}) {
        const std::uint32_t e = g.face_edge[side][face];
        if (g.edge_is_crease[e]) continue;
        const std::uint32_t other = g.edge_face[g.edge_face[0][e] == face ? 1 : 0][e];
        const auto next = static_cast<std::uint32_t>(std::find(faces, faces + count, other) - faces);
        if (next == count || part[next] != kNone) continue;
        part[next] = parts;
        open.push_back(next);
      }
    }
    ++parts;
  }
  return parts;
}

void give_parts_normals(Garment& g) {
  std::vector<bool> creased(g.particle_count);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    if (g.edge_is_crease[e]) creased[g.edge_particle[0][e]] = creased[g.edge_particle[1][e]] = true;
  }
  std::vector<std::uint32_t> part;
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (!creased[i]) continue;
    const std::uint32_t parts = label_parts(g, i, part);
    if (parts < 2) continue;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::uint32_t face = g.faces_around[g.around_begin[i] + k];
      g.face_normal[corner_at(g, face, i)][face] = g.normal_count + part[k];
    }
    for (std::uint32_t p = 0; p < parts; ++p) g.part_particle.push_back(i);
    g.normal_count += parts;
  }
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t i = g.edge_particle[end][e];
      const auto of_side = [&](std::size_t side) {
        const std::uint32_t face = g.edge_face[side][e];
        return g.face_normal[corner_at(g, face, i)][face];
      };
      const std::uint32_t first = of_side(0), second = g.edge_is_crease[e] ? of_side(1) : first;
      g.edge_normal[end][e] = first == second ? first : g.normal_count++;
      if (first == second) continue;
      g.end_part[0].push_back(first);
      g.end_part[1].push_back(second);
    }
  }
}

}  // namespace

void find_creases(std::span<const std::array<std::uint32_t, 2>> seams, float crease_angle, Garment& g) {
  g.normal_count = g.particle_count;
  const auto copy = [](const Column<std::uint32_t>& from, Column<std::uint32_t>& to) {
    to.resize(from.size());
    std::copy(from.begin(), from.end(), to.begin());
  };
  for (std::size_t k = 0; k < 3; ++k) copy(g.face_particle[k], g.face_normal[k]);
  for (std::size_t k = 0; k < 2; ++k) copy(g.edge_particle[k], g.edge_normal[k]);
  mark_creases(seams, crease_angle, g);
  if (g.crease_count != 0) give_parts_normals(g);
}

void complete_normals(const Garment& g, Vec3View normal) {
  std::uint32_t n = g.particle_count;
  for (const std::uint32_t particle : g.part_particle) normal.add(particle, normal[n++]);
  for (std::size_t k = 0; k < g.end_part[0].size(); ++k) {
    normal.set(n++, normal[g.end_part[0][k]] + normal[g.end_part[1][k]]);
  }
}

}  // namespace pleat
