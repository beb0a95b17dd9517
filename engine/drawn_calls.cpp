// What a host reads of the drawn surface: vertices, indices, and which level would do.
#include "components/packed.h"
#include "components/suggested_level.h"
#include "engine/border.h"
#include "engine/calls.h"
#include "systems/box.h"

namespace pleat::call {
namespace {

const pleat_vertex_target& default_target() {
  static const pleat_vertex_target target = [] {
    pleat_vertex_target t{};
    t.size = sizeof t;
    t.position_offset = t.normal_offset = t.uv_offset = t.tangent_offset = PLEAT_NO_ATTRIBUTE;
    return t;
  }();
  return target;
}

/// The drawn vertices as a host counts them: the tessellation's, or the particles where that is compiled out.
class DrawnVertices {
 public:
  DrawnVertices(const World& world, const ClothRecord& cloth)
      : garment_(cloth.garment()),
        pattern_(cloth.pattern()),
        particles_(world.particles.position.view().from(cloth.particle_begin)),
        origin_(cloth.origin),
        places_(pattern_ != nullptr ? pattern_->vertex_count : garment_.particle_count),
        count_(pattern_ != nullptr ? pattern_->shaded_count() : places_),
        position_(particles_) {
    if (pattern_ == nullptr) return;
    twins_ = pattern_->twins.data();
    position_ = world.drawn.position.view().from(cloth.drawn_begin);
    normal_ = world.drawn.normal.view().from(cloth.drawn_begin);
    if (cloth.settings.tangents == 0) return;
    tangent_ = world.drawn.tangent.view().from(cloth.drawn_begin);
    handedness_ = world.drawn.handedness.data() + cloth.drawn_begin;
  }

  std::uint32_t count() const { return count_; }
  Box bounds() const { return box_of(position_, places_).moved(origin_); }
  Vec3 position(std::uint32_t i) const { return position_[place(i)] + origin_; }
  Vec3 normal(std::uint32_t i) const { return pattern_ != nullptr ? normal_[i] : coarse_normal(i); }
  std::array<float, 4> tangent(std::uint32_t i) const {
    return {tangent_.x[i], tangent_.y[i], tangent_.z[i], handedness_[i]};
  }

  std::array<float, 2> uv(std::uint32_t i) const {
    if (pattern_ == nullptr) return coarse_uv(i);
    const std::uint32_t v = place(i);
    if (v < garment_.particle_count) return coarse_uv(v);
    std::array<float, 2> uv{};
    const auto blend = [&](std::uint32_t particle, float weight) {
      const std::array<float, 2> corner = coarse_uv(particle);
      uv[0] += weight * corner[0];
      uv[1] += weight * corner[1];
    };
    if (v < pattern_->first_face_vertex) {
      const std::uint32_t k = v - pattern_->first_edge_vertex, per_edge = pattern_->segments - 1;
      const float t = static_cast<float>(k % per_edge + 1) / static_cast<float>(pattern_->segments);
      blend(garment_.edge_particle[0][k / per_edge], 1.0f - t);
      blend(garment_.edge_particle[1][k / per_edge], t);
    } else {
      const std::uint32_t k = v - pattern_->first_face_vertex;
      const std::uint32_t per_face = static_cast<std::uint32_t>(pattern_->inner.size()), f = k / per_face;
      for (int c = 0; c < 3; ++c) blend(garment_.face_particle[c][f], pattern_->inner[k % per_face].face[c]);
    }
    return uv;
  }

 private:
  std::uint32_t place(std::uint32_t i) const { return i < places_ ? i : twins_[i - places_]; }
  std::array<float, 2> coarse_uv(std::uint32_t i) const {
    return garment_.uv.size() != 0 ? std::array{garment_.uv[2 * i], garment_.uv[2 * i + 1]} : std::array{0.0f, 0.0f};
  }
  /// Area-weighted normal of the faces around a particle.
  Vec3 coarse_normal(std::uint32_t i) const {
    Vec3 sum;
    for (std::uint32_t k = garment_.around_begin[i]; k < garment_.around_begin[i + 1]; ++k) {
      const std::uint32_t f = garment_.faces_around[k];
      const Vec3 a = particles_[garment_.face_particle[0][f]];
      sum += cross(particles_[garment_.face_particle[1][f]] - a, particles_[garment_.face_particle[2][f]] - a);
    }
    return normalized_or(sum, {0.0f, 1.0f, 0.0f});
  }

  const Garment& garment_;
  const TessellationPattern* pattern_;
  ConstVec3View particles_;
  Vec3 origin_;
  std::uint32_t places_, count_;  // without and with twins
  const std::uint32_t* twins_ = nullptr;
  ConstVec3View position_, normal_, tangent_;
  const float* handedness_ = nullptr;
};

void need_visible(const ClothRecord& cloth) {
  if (!cloth.visible) refuse("the cloth is not visible: its surface is not drawn, see cloth_set_visible");
}

/// Whether the target asks for the attribute at `offset`; refused where a vertex has no room for its `bytes`.
bool asks_for(const char* name, const pleat_vertex_target& target, std::uint32_t offset, std::size_t bytes) {
  if (offset == PLEAT_NO_ATTRIBUTE) return false;
  if (std::uint64_t{offset} + bytes > target.stride) {
    refuse(std::string("target.") + name + " is " + std::to_string(offset) + ", beyond a stride of " +
           std::to_string(target.stride));
  }
  return true;
}

void need_target(const pleat_vertex_target& target, const ClothRecord& cloth, std::uint32_t count) {
  need_pointer("target.data", target.data);
  need_capacity("target.capacity", target.capacity, count);
  need_range("target.position_format", target.position_format, 0, PLEAT_FORMAT_16);
  need_range("target.normal_format", target.normal_format, 0, PLEAT_FORMAT_16);
  const auto size_of = [](std::uint32_t format) {
    return format == PLEAT_FORMAT_16 ? sizeof(std::uint16_t) : sizeof(float);
  };
  asks_for("position_offset", target, target.position_offset, 3 * size_of(target.position_format));
  asks_for("normal_offset", target, target.normal_offset, 3 * size_of(target.normal_format));
  asks_for("uv_offset", target, target.uv_offset, 2 * sizeof(float));
  if (!asks_for("tangent_offset", target, target.tangent_offset, 4 * size_of(target.normal_format))) return;
  need_compiled(kHasSmoothing, "target.tangent_offset: the tangent", "PLEAT_SMOOTHING");
  if (cloth.settings.tangents == 0) refuse("target.tangent_offset is given, but the cloth's setting tangents is 0");
}

void write_vertices(const DrawnVertices& drawn, const pleat_vertex_target& target) {
  const bool with_position = target.position_offset != PLEAT_NO_ATTRIBUTE;
  const bool with_normal = target.normal_offset != PLEAT_NO_ATTRIBUTE;
  const bool with_uv = target.uv_offset != PLEAT_NO_ATTRIBUTE;
  const bool with_tangent = target.tangent_offset != PLEAT_NO_ATTRIBUTE;
  const bool packs_position = with_position && target.position_format == PLEAT_FORMAT_16;
  const bool packs_normal = target.normal_format == PLEAT_FORMAT_16;
  const Box bounds = packs_position ? drawn.bounds() : Box{};
  const UnormBox box(bounds.low, bounds.high);
  char* out = static_cast<char*>(target.data);
  const auto write = [&](std::uint32_t offset, const auto&... values) {  // one by one: no detour through memory
    char* to = out + offset;
    ((std::memcpy(to, &values, sizeof values), to += sizeof values), ...);
  };
  const auto write_direction = [&](std::uint32_t offset, auto... values) {
    packs_normal ? write(offset, snorm16(values)...) : write(offset, values...);
  };
  for (std::uint32_t i = 0; i < drawn.count(); ++i, out += target.stride) {
    if (with_position) {
      const Vec3 p = drawn.position(i);
      if (packs_position) {
        const auto [x, y, z] = box.pack(p);
        write(target.position_offset, x, y, z);
      } else {
        write(target.position_offset, p.x, p.y, p.z);
      }
    }
    if (with_normal) {
      const Vec3 n = drawn.normal(i);
      write_direction(target.normal_offset, n.x, n.y, n.z);
    }
    if (with_uv) {
      const auto [u, v] = drawn.uv(i);
      write(target.uv_offset, u, v);
    }
    if (with_tangent) {
      const auto [x, y, z, handedness] = drawn.tangent(i);
      write_direction(target.tangent_offset, x, y, z, handedness);
    }
  }
}

template <class Index>
void read_indices(const ClothRecord& cloth, Index* indices, std::uint32_t capacity) {
  need_pointer("indices", indices);
  if (const TessellationPattern* pattern = cloth.pattern()) {
    need_capacity("capacity", capacity, pattern->indices.size());
    std::transform(pattern->indices.begin(), pattern->indices.end(), indices,
                   [](std::uint32_t i) { return static_cast<Index>(i); });
  } else {
    const Garment& g = cloth.garment();
    need_capacity("capacity", capacity, std::size_t{3} * g.face_count);
    for (std::uint32_t f = 0; f < g.face_count; ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) indices[3 * f + k] = static_cast<Index>(g.face_particle[k][f]);
    }
  }
}

}  // namespace

pleat_result vertex_target_init(pleat_vertex_target* target, size_t size) {
  return init_def("vertex_target_init", target, size, default_target());
}

pleat_result cloth_read_vertices(const pleat_world* handle, pleat_cloth cloth, const pleat_vertex_target* given) {
  return guarded(as_world(handle), "cloth_read_vertices", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    need_visible(record);
    const pleat_vertex_target target = read_def("target", given, default_target());
    const DrawnVertices drawn(world, record);
    need_target(target, record, drawn.count());
    write_vertices(drawn, target);
  });
}

pleat_result cloth_bounds(const pleat_world* handle, pleat_cloth cloth, float low[3], float high[3]) {
  return guarded(as_world(handle), "cloth_bounds", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    need_pointer("low", low);
    need_pointer("high", high);
    const ConstVec3View particles = world.particles.position.view().from(record.particle_begin);
    const Box box = record.visible ? DrawnVertices(world, record).bounds()
                                   : box_of(particles, record.garment().particle_count).moved(record.origin);
    std::memcpy(low, &box.low, sizeof box.low);
    std::memcpy(high, &box.high, sizeof box.high);
  });
}

pleat_result cloth_read_indices(const pleat_world* handle, pleat_cloth cloth, uint32_t* indices, uint32_t capacity) {
  return guarded(as_world(handle), "cloth_read_indices",
                 [&] { read_indices(need_cloth(need_world(handle), cloth), indices, capacity); });
}

pleat_result cloth_read_indices_16(const pleat_world* handle, pleat_cloth cloth, uint16_t* indices, uint32_t capacity) {
  return guarded(as_world(handle), "cloth_read_indices_16", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    constexpr std::uint32_t kMost = 65536;
    if (const std::uint32_t count = DrawnVertices(world, record).count(); count > kMost) {
      refuse("the cloth has " + std::to_string(count) + " drawn vertices, 16-bit indices reach " +
                 std::to_string(kMost) + ": read 32-bit ones or choose a lower level",
             PLEAT_ERROR_CAPACITY);
    }
    read_indices(record, indices, capacity);
  });
}

pleat_result cloth_suggest_level(const pleat_world* handle, pleat_cloth cloth, float pixels_per_metre,
                                 uint32_t* level) {
  return guarded(as_world(handle), "cloth_suggest_level", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    need_visible(record);
    need_range("pixels_per_metre", pixels_per_metre, 1e-6, 1e9);
    need_pointer("level", level);
    float bend = 0.0f;
    if (record.settings.surface != PLEAT_SURFACE_FLAT) {
      const bool folded = has_folds(static_cast<SurfaceMode>(record.settings.surface));
      bend = largest_bend(record.garment(), world.particles.position.view().from(record.particle_begin),
                          world.surface.normal.view().from(record.normal_begin),
                          folded ? world.surface.fold_height.data() + record.edge_begin : nullptr);
    }
    *level = suggested_level(bend, record.garment().mean_edge_length, pixels_per_metre);
  });
}

}  // namespace pleat::call
