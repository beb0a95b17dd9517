#include "bench/fine_square.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include "demo/input_error.h"
#include "demo/program/output.h"
#include "demo/scenes/scene.h"

namespace pleat::bench {
namespace {

static_assert(std::endian::native == std::endian::little, "files are read as they lie");

constexpr double kTick = 0.008;       // s; of 64 substeps, for the stiff little edges
constexpr double kFirstBulge = 0.01;  // m, so that a flat start has a side to give way to
constexpr double kSeconds = kSolveSteps * kTick;

pleat_cloth_settings fine_settings(const pleat_api& api) {
  pleat_cloth_def def;
  api.cloth_def_init(&def, sizeof def);
  pleat_cloth_settings& s = def.settings;
  s.substeps = 64;
  s.sweeps = 1;
  s.stiffness = 300.0f;
  s.stretch_limit = 1.0f;
  s.bend_stiffness = 2e-5f;
  s.edge_damping = 40.0f;
  s.bend_damping = 40.0f;
  s.air_damping = 3.0f;
  s.surface = PLEAT_SURFACE_FLAT;
  s.level = 1;
  return s;
}

/// The amplitude A of the wave z = A sin(n pi u), u = 0..1, that is 1 m long over a chord of `width`.
double wave_height(double width, double n) {
  const auto length = [&](double a) {
    constexpr int kSteps = 1000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      sum += std::hypot(width, a * n * std::numbers::pi * std::cos(n * std::numbers::pi * (i + 0.5) / kSteps));
    }
    return sum / kSteps;
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (length(middle) < 1.0 ? low : high) = middle;
  }
  return low;
}

/// Hanging straight down, in waves across that take up what the pins leave over.
std::vector<float> first_state(const FineSquare& square) {
  const double n = square.waves == 1 ? 1.0 : 2.0 * square.waves, height = wave_height(square.width, n);
  std::vector<float> positions;
  for (uint32_t row = 0; row < kFineSide; ++row) {
    for (uint32_t column = 0; column < kFineSide; ++column) {
      const double u = double(column) / (kFineSide - 1), v = double(row) / (kFineSide - 1);
      const double bulge = kFirstBulge * std::sin(std::numbers::pi * v);
      positions.push_back(float(square.width * (u - 0.5)));
      positions.push_back(float(-v));
      positions.push_back(float(height * std::sin(n * std::numbers::pi * u) + bulge));
    }
  }
  return positions;
}

std::filesystem::path file_of(const std::filesystem::path& folder, const FineSquare& square) {
  return folder / (std::string(square.name) + ".f32");
}

}  // namespace

demo::TriangleMesh flat_square(const pleat_api& api, uint32_t n) {
  pleat_shape_def def;
  api.shape_def_init(&def, sizeof def);
  def.rows = def.columns = n;
  def.alternate = 1;
  uint32_t vertices = 0, triangles = 0;
  api.shape_size(&def, &vertices, &triangles);
  demo::TriangleMesh mesh;
  mesh.positions.resize(3 * vertices);
  mesh.triangles.resize(3 * triangles);
  if (api.shape_build(&def, mesh.positions.data(), mesh.triangles.data()) != PLEAT_OK) {
    throw std::runtime_error("the library cannot build a square of cloth");
  }
  return mesh;
}

FineSolution solve(const pleat_api& api, const FineSquare& square, const std::function<void()>& step) {
  demo::SceneDef def;
  def.name = square.name;
  def.rate = 1.0 / kTick;
  def.garment = flat_square(api, kFineSide);
  def.pins = {0, kFineSide - 1};
  def.settings = fine_settings(api);
  demo::Scene scene(api, def);
  constexpr uint32_t kParticles = kFineSide * kFineSide;
  const std::vector<float> first = first_state(square);
  scene.check(api.cloth_write_particles(scene.world(), scene.cloths()[0], first.data(), nullptr, kParticles), "start");
  for (uint32_t i = 0; i < kSolveSteps; ++i) {
    scene.advance();
    step();
  }
  FineSolution solution;
  std::vector<float> velocities(3 * kParticles);
  scene.read_particles(0, solution.positions);
  scene.check(api.cloth_read_particles(scene.world(), scene.cloths()[0], nullptr, velocities.data(), kParticles),
              "velocities");
  solution.speed = 0.0;
  for (size_t i = 0; i < velocities.size(); i += 3) {
    solution.speed = std::max(solution.speed, double(std::hypot(velocities[i], velocities[i + 1], velocities[i + 2])));
  }
  return solution;
}

std::vector<float> read_fine(const std::filesystem::path& folder, const FineSquare& square) {
  const std::string name = file_of(folder, square).string();
  std::ifstream stream(name, std::ios::binary);
  if (!stream) throw demo::InputError(name, "cannot be read; `surface_error --regenerate` makes it anew");
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::vector<float> positions(3 * size_t{kFineSide} * kFineSide);
  const size_t expected = positions.size() * sizeof(float);
  if (bytes.size() != expected) {
    throw demo::InputError(name,
                           "should hold " + std::to_string(expected) + " bytes, holds " + std::to_string(bytes.size()));
  }
  std::memcpy(positions.data(), bytes.data(), bytes.size());
  const auto bad = std::ranges::find_if(positions, [](float x) { return !std::isfinite(x); });
  if (bad != positions.end()) {
    throw demo::InputError(name, "particle " + std::to_string((bad - positions.begin()) / 3) + " is not finite");
  }
  return positions;
}

void write_fine(const std::filesystem::path& folder, const FineSquare& square, const std::vector<float>& positions) {
  demo::OutputFile file(file_of(folder, square));
  file.commit({reinterpret_cast<const char*>(positions.data()), positions.size() * sizeof(float)});
}

}  // namespace pleat::bench
