#include "components/rest_curve.h"

#include <gtest/gtest.h>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

TEST(RestCurve, IsTheRestLengthOnAFlatSheet) {
  const Garment g = garment_of(sheet(5));
  for (std::uint32_t e = 0; e < g.edge_count; ++e)
    EXPECT_NEAR(g.edge_rest_curve_length[e], g.edge_rest_length[e], 1e-6f);
}

TEST(RestCurve, IsAlmostTheArcAroundATube) {
  // An 8-gon: the normals tilt by half a side's 45 degrees, for which the PN curve is 1.0217 chords long.
  const Ring rings[] = {{8, 1.0f, 0.4f}, {8, 1.0f, 0.0f}, {8, 1.0f, -0.4f}};
  const Garment g = garment_of(make_rings(rings));
  const ConstVec3View x = g.rest_position.view();
  int around = 0;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const float rise = x[g.edge_particle[0][e]].y - x[g.edge_particle[1][e]].y;
    if (rise != 0.0f || x[g.edge_particle[0][e]].y != 0.0f) continue;
    EXPECT_NEAR(g.edge_rest_curve_length[e] / g.edge_rest_length[e], 1.0217f, 5e-4f);
    ++around;
  }
  EXPECT_EQ(around, 8);
}

}  // namespace
}  // namespace pleat
