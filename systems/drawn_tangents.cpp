#include "systems/drawn_tangents.h"

#include <algorithm>
#include <cmath>

namespace pleat {
namespace {

Vec3 across(const Vec3& v, const Vec3& normal) { return v - normal * dot(v, normal); }

Vec3 any_tangent(const Vec3& normal) {
  const Vec3 axis = std::abs(normal.x) < 0.9f ? Vec3{1.0f, 0.0f, 0.0f} : Vec3{0.0f, 0.0f, 1.0f};
  return normalized_or(across(axis, normal), axis);
}

/// Adds area dp/du of each drawn triangle of face f, and the texture area, with its sign, of the face.
void add_face(const DrawnTangents& s, std::uint32_t f) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  float u[3], v[3];
  for (std::uint32_t k = 0; k < 3; ++k)
    u[k] = g.uv[2 * g.face_particle[k][f]], v[k] = g.uv[2 * g.face_particle[k][f] + 1];
  const float area = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]);
  const float sign = area < 0.0f ? -1.0f : 1.0f;

  float drawn_v[kMaxVerticesPerFace];
  for (std::uint32_t i = 0; i < pattern.vertices_per_face; ++i) {
    const std::array<float, 3>& weight = pattern.face_weights[i];
    drawn_v[i] = weight[1] * (v[1] - v[0]) + weight[2] * (v[2] - v[0]);
  }
  const std::size_t first = std::size_t{f} * pattern.vertices_per_face;
  const std::uint32_t* place = pattern.face_vertices.data() + first;
  const std::uint32_t* shaded = pattern.shaded_vertices() + first;
  for (std::size_t t = 0; t < pattern.face_triangles.size(); t += 3) {
    const std::uint32_t a = pattern.face_triangles[t], b = pattern.face_triangles[t + 1],
                        c = pattern.face_triangles[t + 2];
    const Vec3 ab = s.position[place[b]] - s.position[place[a]], ac = s.position[place[c]] - s.position[place[a]];
    const Vec3 along_u = (ab * (drawn_v[c] - drawn_v[a]) - ac * (drawn_v[b] - drawn_v[a])) * sign;
    for (const std::uint32_t i : {a, b, c}) s.tangent.add(shaded[i], along_u);
  }
  for (std::uint32_t i = 0; i < pattern.vertices_per_face; ++i) s.handedness[shaded[i]] += area;
}

}  // namespace

bool DrawnTangents::validate() const {
  return garment != nullptr && pattern != nullptr && position.x != nullptr && normal.x != nullptr &&
         tangent.x != nullptr && handedness != nullptr;
}

void DrawnTangents::run() const {
  const std::uint32_t count = pattern->shaded_count();
  clear(tangent, count);
  std::fill_n(handedness, count, 0.0f);
  if (garment->uv.size() != 0) {
    for (std::uint32_t f = 0; f < garment->face_count; ++f) add_face(*this, f);
  }
  constexpr float kSmallest2 = 1e-8f;  // of the sum's square: below, it points along the normal or nowhere
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 sum = tangent[i], t = across(sum, normal[i]);
    const float t2 = dot(t, t), least = std::max(kSmallest2 * dot(sum, sum), 1e-30f);
    tangent.set(i, t2 > least ? t * (1.0f / std::sqrt(t2)) : any_tangent(normal[i]));
    handedness[i] = handedness[i] < 0.0f ? -1.0f : 1.0f;
  }
}

}  // namespace pleat
