// Cloth that starts stretched.
#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 8;

/// The root mean square speed, m/s, in each of the first ticks of a sheet that starts `stretch` times as deep as it is.
std::vector<float> speeds(float stretch, std::uint32_t substeps) {
  Scene scene;
  const pleat_garment garment = scene.sheet(kSide);
  const pleat_cloth model = scene.cloth(garment);
  std::vector<float> start = scene.particles(model);
  must(call::cloth_destroy(scene, model));
  for (std::size_t i = 2; i < start.size(); i += 3) start[i] *= stretch;
  pleat_cloth_def def;
  must(call::cloth_def_init(&def, sizeof def));
  def.garment = garment;
  def.positions = start.data();
  def.settings.substeps = substeps;
  pleat_cloth cloth{};
  must(call::cloth_create(scene, &def, &cloth));
  std::vector<float> found;
  for (int tick = 0; tick < 12; ++tick) {
    scene.step(1, 1.0f / 60);
    const ConstVec3View velocity = scene.inside().particles.velocity.view();
    float sum = 0.0f;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) sum += dot(velocity[i], velocity[i]);
    found.push_back(std::sqrt(sum / (kSide * kSide)));
  }
  return found;
}

TEST(Settling, AStretchedStartIsNotThrown) {
  for (const std::uint32_t substeps : {0u, 64u}) {
    for (const float stretch : {1.05f, 1.2f, 2.0f}) {
      const std::vector<float> found = speeds(stretch, substeps);
      for (std::size_t tick = 0; tick < found.size(); ++tick) {
        const float fallen = 9.81f * static_cast<float>(tick + 1) / 60;
        EXPECT_LT(found[tick], fallen + 1.0f) << stretch << ", tick " << tick << ", substeps " << substeps;
      }
    }
  }
}

TEST(Settling, AStartThatFitsMovesAtOnce) { EXPECT_NEAR(speeds(1.0f, 0)[0], 9.81f / 60, 0.02f); }

}  // namespace
}  // namespace pleat
