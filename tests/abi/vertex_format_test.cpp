// Drawn vertices in 16 bits, beside the same in floats.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

struct PackedVertex {
  std::uint16_t position[3];
  std::int16_t normal[3], tangent[4];
  std::uint8_t others[4];
};
static_assert(sizeof(PackedVertex) == 24);

class VertexFormat : public Host {
 protected:
  VertexFormat() {
    pleat_cloth_settings s{};
    s.size = sizeof s;
    EXPECT_EQ(api().cloth_get(world, cloth, &s), pleat_result{PLEAT_OK});
    s.tangents = has_tangents() ? 1 : 0;
    EXPECT_EQ(api().cloth_set(world, cloth, &s), pleat_result{PLEAT_OK});
    for (int i = 0; i < 30; ++i) EXPECT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
    EXPECT_EQ(api().cloth_bounds(world, cloth, low.data(), high.data()), pleat_result{PLEAT_OK});
  }
  static bool has_tangents() { return (api().features & PLEAT_FEATURE_SMOOTHING) != 0; }

  std::uint32_t count() {
    pleat_cloth_info info{};
    info.size = sizeof info;
    EXPECT_EQ(api().cloth_info(world, cloth, &info), pleat_result{PLEAT_OK});
    return info.drawn_vertices;
  }
  /// Position, normal, uv and tangent: 12 floats a vertex.
  std::vector<float> floats() {
    std::vector<float> buffer(12 * count());
    pleat_vertex_target target = vertex_target(buffer.data(), count());
    target.stride = 48;
    if (has_tangents()) target.tangent_offset = 32;
    EXPECT_EQ(api().cloth_read_vertices(world, cloth, &target), pleat_result{PLEAT_OK});
    return buffer;
  }
  pleat_vertex_target packed_target(std::vector<PackedVertex>& buffer) {
    pleat_vertex_target target = made(api().vertex_target_init);
    target.data = buffer.data(), target.stride = sizeof(PackedVertex);
    target.capacity = static_cast<std::uint32_t>(buffer.size());
    target.position_offset = offsetof(PackedVertex, position);
    target.normal_offset = offsetof(PackedVertex, normal);
    if (has_tangents()) target.tangent_offset = offsetof(PackedVertex, tangent);
    target.position_format = target.normal_format = PLEAT_FORMAT_16;
    return target;
  }
  std::vector<PackedVertex> packed() {
    std::vector<PackedVertex> buffer(count());
    std::memset(buffer.data(), 0xa5, buffer.size() * sizeof(PackedVertex));
    const pleat_vertex_target target = packed_target(buffer);
    EXPECT_EQ(api().cloth_read_vertices(world, cloth, &target), pleat_result{PLEAT_OK});
    return buffer;
  }

  std::array<float, 3> low{}, high{};
};

TEST_F(VertexFormat, BoundsAreThoseOfTheDrawnVertices) {
  const std::vector<float> drawn = floats();
  for (std::size_t k = 0; k < 3; ++k) {
    float least = drawn[k], most = drawn[k];
    for (std::size_t i = 0; i < drawn.size(); i += 12) {
      least = std::min(least, drawn[i + k]), most = std::max(most, drawn[i + k]);
    }
    EXPECT_EQ(low[k], least);
    EXPECT_EQ(high[k], most);
    EXPECT_LT(low[k], high[k]);
  }
}

TEST_F(VertexFormat, PackedVerticesAreTheSameToHalfAStep) {
  const std::vector<float> drawn = floats();
  const std::vector<PackedVertex> small = packed();
  std::array<bool, 3> at_low{}, at_high{};
  for (std::size_t i = 0; i < small.size(); ++i) {
    const float* exact = &drawn[12 * i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint16_t u = small[i].position[k];
      const float step = (high[k] - low[k]) / 65535.0f;
      EXPECT_NEAR(low[k] + static_cast<float>(u) * step, exact[k], 0.52f * step) << i;
      EXPECT_NEAR(small[i].normal[k] / 32767.0f, exact[3 + k], 0.51f / 32767.0f) << i;
      at_low[k] |= u == 0, at_high[k] |= u == 65535;
    }
    for (std::size_t k = 0; k < 4 && has_tangents(); ++k) {
      EXPECT_NEAR(small[i].tangent[k] / 32767.0f, exact[8 + k], 0.51f / 32767.0f) << i;
    }
    for (const std::uint8_t byte : small[i].others) EXPECT_EQ(byte, 0xa5) << "written beyond the attributes";
  }
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(at_low[k] && at_high[k]) << "the box is not the smallest";
}

TEST_F(VertexFormat, FormatsAreChecked) {
  std::vector<PackedVertex> buffer(count());
  const pleat_vertex_target good = packed_target(buffer);
  const auto refused = [&](const char* field, const pleat_vertex_target& target) {
    expect_refused(PLEAT_ERROR_ARGUMENT, field, [&] { return api().cloth_read_vertices(world, cloth, &target); });
  };
  pleat_vertex_target bad = good;
  bad.position_format = 2;
  refused("target.position_format", bad);
  bad = good, bad.normal_format = 2;
  refused("target.normal_format", bad);
  bad = good, bad.position_offset = sizeof(PackedVertex) - 5;
  refused("target.position_offset", bad);
  bad = good, bad.normal_offset = sizeof(PackedVertex) - 5;
  refused("target.normal_offset", bad);
  if (has_tangents()) {
    bad = good, bad.tangent_offset = sizeof(PackedVertex) - 7;
    refused("target.tangent_offset", bad);
  }
  bad = good, bad.position_offset = sizeof(PackedVertex) - 6;  // just fits
  EXPECT_EQ(api().cloth_read_vertices(world, cloth, &bad), pleat_result{PLEAT_OK});
}

TEST_F(VertexFormat, AHostWithoutFormatsReadsFloats) {
  const std::vector<float> now = floats();
  std::vector<float> before(now.size());
  pleat_vertex_target old = vertex_target(before.data(), count());
  old.stride = 48;
  if (has_tangents()) old.tangent_offset = 32;
  old.size = offsetof(pleat_vertex_target, position_format);
  old.position_format = old.normal_format = PLEAT_FORMAT_16;  // what lies behind its smaller struct
  ASSERT_EQ(api().cloth_read_vertices(world, cloth, &old), pleat_result{PLEAT_OK});
  EXPECT_EQ(before, now);
}

TEST_F(VertexFormat, BoundsAreChecked) {
  std::array<float, 3> a{}, b{};
  expect_refused(PLEAT_ERROR_ARGUMENT, "low", [&] { return api().cloth_bounds(world, cloth, nullptr, b.data()); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "high", [&] { return api().cloth_bounds(world, cloth, a.data(), nullptr); });
  const pleat_cloth gone{cloth.index, cloth.generation + 1};
  expect_refused(PLEAT_ERROR_HANDLE, "cloth", [&] { return api().cloth_bounds(world, gone, a.data(), b.data()); });
  EXPECT_EQ(a, (std::array<float, 3>{}));
  EXPECT_EQ(b, a);
}

TEST_F(VertexFormat, ReadingAllocatesNothing) {
  std::vector<PackedVertex> buffer(count());
  const pleat_vertex_target target = packed_target(buffer);
  services.allowed = 0;
  EXPECT_EQ(api().cloth_read_vertices(world, cloth, &target), pleat_result{PLEAT_OK});
  EXPECT_EQ(api().cloth_bounds(world, cloth, low.data(), high.data()), pleat_result{PLEAT_OK});
  services.allowed = -1;
}

}  // namespace
}  // namespace pleat::abi
