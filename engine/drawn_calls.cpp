// What a host reads of the drawn surface: vertices, indices, and which level would do.
#include "components/suggested_level.h"
#include "engine/border.h"
#include "engine/calls.h"

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
        drawn_(world.drawn),
        begin_(cloth.drawn_begin),
        particles_(world.particles.position.view().from(cloth.particle_begin)) {}

  std::uint32_t count() const { return pattern_ != nullptr ? pattern_->shaded_count() : garment_.particle_count; }

  Vec3 position(std::uint32_t i) const {
    return pattern_ != nullptr ? drawn_.position.view()[begin_ + pattern_->place(i)] : particles_[i];
  }
  Vec3 normal(std::uint32_t i) const {
    return pattern_ != nullptr ? drawn_.normal.view()[begin_ + i] : coarse_normal(i);
  }
  std::array<float, 4> tangent(std::uint32_t i) const {
    const Vec3 t = drawn_.tangent.view()[begin_ + i];
    return {t.x, t.y, t.z, drawn_.handedness[begin_ + i]};
  }

  std::array<float, 2> uv(std::uint32_t i) const {
    if (pattern_ == nullptr) return coarse_uv(i);
    const std::uint32_t v = pattern_->place(i);
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
  const DrawnColumns& drawn_;
  std::uint32_t begin_;
  ConstVec3View particles_;
};

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
    const pleat_vertex_target target = read_def("target", given, default_target());
    need_pointer("target.data", target.data);
    const DrawnVertices drawn(world, record);
    need_capacity("target.capacity", target.capacity, drawn.count());
    const auto fits = [&](const char* name, std::uint32_t offset, std::uint32_t bytes) {
      if (offset != PLEAT_NO_ATTRIBUTE && std::uint64_t{offset} + bytes > target.stride) {
        refuse(std::string("target.") + name + " is " + std::to_string(offset) + ", beyond a stride of " +
               std::to_string(target.stride));
      }
      return offset != PLEAT_NO_ATTRIBUTE;
    };
    const bool with_position = fits("position_offset", target.position_offset, 12);
    const bool with_normal = fits("normal_offset", target.normal_offset, 12);
    const bool with_uv = fits("uv_offset", target.uv_offset, 8);
    const bool with_tangent = fits("tangent_offset", target.tangent_offset, 16);
    if (with_tangent) {
      need_compiled(kHasSmoothing, "target.tangent_offset: the tangent", "PLEAT_SMOOTHING");
      if (record.settings.tangents == 0)
        refuse("target.tangent_offset is given, but the cloth's setting tangents is 0");
    }

    char* out = static_cast<char*>(target.data);
    const auto write = [&](std::uint32_t offset, const auto& value) {
      std::memcpy(out + offset, &value, sizeof value);
    };
    for (std::uint32_t i = 0; i < drawn.count(); ++i, out += target.stride) {
      if (with_position) write(target.position_offset, drawn.position(i));
      if (with_normal) write(target.normal_offset, drawn.normal(i));
      if (with_uv) write(target.uv_offset, drawn.uv(i));
      if (with_tangent) write(target.tangent_offset, drawn.tangent(i));
    }
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
