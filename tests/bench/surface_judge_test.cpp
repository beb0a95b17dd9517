#include "bench/surface_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "demo/input_error.h"

namespace pleat::bench {
namespace {

const pleat_api& api() { return *pleat_get_api(PLEAT_API_MAJOR); }

std::vector<SurfaceVerdict> judge(const SurfaceTruth& truth, uint32_t n, std::span<const uint32_t> modes) {
  pleat_cloth_def cloth;
  api().cloth_def_init(&cloth, sizeof cloth);
  return judge(api(), truth, n, modes, cloth.settings);
}

SurfaceTruth plane() { return {"plane", flat_square(api(), kFineSide).positions, true}; }

TEST(SurfaceJudge, DistanceOfAMovedPlane) {
  const demo::TriangleMesh sheet = flat_square(api(), 9);
  std::vector<float> points = flat_square(api(), 33).positions;
  EXPECT_NEAR(rms_distance(points, sheet.positions, sheet.triangles), 0.0, 1e-9);
  for (size_t i = 1; i < points.size(); i += 3) points[i] += 0.02f;
  EXPECT_NEAR(rms_distance(points, sheet.positions, sheet.triangles), 0.02, 1e-8);
  for (size_t i = 1; i < points.size(); i += 6) points[i] -= 0.02f;  // every other point back, near enough
  EXPECT_NEAR(rms_distance(points, sheet.positions, sheet.triangles), 0.02 / std::sqrt(2.0), 1e-5);
}

TEST(SurfaceJudge, SamplesTheCoarseParticles) {
  EXPECT_EQ(every(flat_square(api(), 65).positions, 65, 8), flat_square(api(), 9).positions);
  EXPECT_EQ(every(flat_square(api(), 5).positions, 5, 4), flat_square(api(), 2).positions);
}

TEST(SurfaceJudge, AFlatSheetIsDrawnExactlyByAllModes) {
  const uint32_t modes[] = {PLEAT_SURFACE_FLAT,  PLEAT_SURFACE_PN,        PLEAT_SURFACE_PAPER, PLEAT_SURFACE_PLEAT,
                            PLEAT_SURFACE_PHONG, PLEAT_SURFACE_SPHERIGON, PLEAT_SURFACE_ARC_PN};
  for (const SurfaceVerdict& verdict : judge(plane(), 5, modes)) {
    EXPECT_LT(verdict.rms_mm, 1e-3);
    EXPECT_LT(std::abs(verdict.area_error_percent), 1e-3);
    EXPECT_GT(verdict.us, 0.0);
  }
}

TEST(SurfaceJudge, CurvesAreCloserToARolledSheetThanTriangles) {
  const std::vector<SurfaceTruth> truths = surface_truths(PLEAT_FINE_DIR);
  ASSERT_EQ(truths.size(), 7u);
  const SurfaceTruth& cylinder = truths[4];
  ASSERT_EQ(cylinder.name, "cylinder");
  const uint32_t modes[] = {PLEAT_SURFACE_FLAT, PLEAT_SURFACE_PN, PLEAT_SURFACE_PLEAT};
  const std::vector<SurfaceVerdict> verdicts = judge(cylinder, 9, modes);
  // Chords of c on a radius of r sag by c^2 / (12 r) on the mean at most; edges of .125 m and diagonals of .18 m, r =
  // .5.
  EXPECT_GT(verdicts[0].rms_mm, 1.5);
  EXPECT_LT(verdicts[0].rms_mm, 5.0);
  EXPECT_LT(verdicts[1].rms_mm, 0.5 * verdicts[0].rms_mm);
  EXPECT_LT(verdicts[2].rms_mm, 0.5 * verdicts[0].rms_mm);
}

TEST(SurfaceJudge, PleatFollowsTheHangingSquares) {
  const std::vector<SurfaceTruth> truths = surface_truths(PLEAT_FINE_DIR);
  const uint32_t modes[] = {PLEAT_SURFACE_FLAT, PLEAT_SURFACE_PN, PLEAT_SURFACE_PLEAT};
  for (size_t i = 0; i < kFineSquares.size(); ++i) {
    const std::vector<SurfaceVerdict> verdicts = judge(truths[i], 17, modes);
    EXPECT_LT(verdicts[2].rms_mm, 0.6 * verdicts[0].rms_mm) << truths[i].name;
    EXPECT_LT(verdicts[2].rms_mm, 0.8 * verdicts[1].rms_mm) << truths[i].name;
    EXPECT_LT(std::abs(verdicts[2].area_error_percent), 1.0) << truths[i].name;
  }
}

TEST(FineSquare, BadFilesAreNamed) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "fine_square_test";
  std::filesystem::create_directories(folder);
  const auto complaint = [&]() -> std::string {
    try {
      read_fine(folder, "w0.6");
    } catch (const demo::InputError& error) {
      return error.what();
    }
    return "";
  };
  std::filesystem::remove(folder / "w0.6.f32");
  EXPECT_NE(complaint().find("w0.6.f32: cannot be read"), std::string::npos);

  std::vector<float> positions(3 * size_t{kFineSide} * kFineSide, 0.25f);
  write_fine(folder, "w0.6", positions);
  EXPECT_EQ(read_fine(folder, "w0.6"), positions);
  positions[3 * 7 + 1] = std::numeric_limits<float>::quiet_NaN();
  write_fine(folder, "w0.6", positions);
  EXPECT_NE(complaint().find("particle 7 is not finite"), std::string::npos);
  positions.pop_back();
  write_fine(folder, "w0.6", positions);
  EXPECT_NE(complaint().find("should hold 50700 bytes, holds 50696"), std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pleat::bench
