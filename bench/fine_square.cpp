#include "bench/fine_square.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "bench/bare_springs.h"
#include "demo/input_error.h"
#include "demo/program/output.h"
#include "demo/scenes/scene.h"

namespace pleat::bench {
namespace {

static_assert(std::endian::native == std::endian::little, "files are read as they lie");

constexpr uint32_t kSides[] = {17, 33, kFineSide};
constexpr double kSubstep = 0.008;    // s, over the number of edges along a side: what the springs bear
constexpr double kFirstBulge = 0.01;  // m, so that a flat start has a side to give way to

pleat_cloth_settings fine_settings(const pleat_api& api) {
  pleat_cloth_def def;
  api.cloth_def_init(&def, sizeof def);
  pleat_cloth_settings& s = def.settings;
  use_bare_springs(s, 300.0f, kMostSubsteps);
  damp_to_rest(s);
  s.bend_stiffness = 2e-5f;
  s.air_damping = 3.0f;
  return s;
}

/// The amplitude A of the wave z = A sin(waves u), u = 0..1, that is 1 m long over a chord of `width`.
double wave_height(double width, double waves) {
  const auto length = [&](double a) {
    constexpr int kSteps = 1000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      sum += std::hypot(width, a * waves * std::cos(waves * (i + 0.5) / kSteps));
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

/// Hanging straight down, in waves across that take up what the pins leave over. n x n particles.
std::vector<float> first_state(const FineSquare& square, uint32_t n) {
  const double waves = square.half_waves * std::numbers::pi, height = wave_height(square.width, waves);
  std::vector<float> positions;
  for (uint32_t row = 0; row < n; ++row) {
    for (uint32_t column = 0; column < n; ++column) {
      const double u = double(column) / (n - 1), v = double(row) / (n - 1);
      positions.push_back(float(square.width * (u - 0.5)));
      positions.push_back(float(-v));
      positions.push_back(float(height * std::sin(waves * u) + kFirstBulge * std::sin(std::numbers::pi * v)));
    }
  }
  return positions;
}

/// n x n points -> (2 n - 1) x (2 n - 1), those between halfway.
std::vector<float> refined(const std::vector<float>& coarse, uint32_t n) {
  const uint32_t m = 2 * n - 1;
  std::vector<float> fine;
  for (uint32_t row = 0; row < m; ++row) {
    for (uint32_t column = 0; column < m; ++column) {
      const size_t low = (row / 2) * n + column / 2, high = ((row + 1) / 2) * n + (column + 1) / 2;
      for (size_t axis = 0; axis < 3; ++axis) fine.push_back(0.5f * (coarse[3 * low + axis] + coarse[3 * high + axis]));
    }
  }
  return fine;
}

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& name) {
  return folder / (name + ".f32");
}

/// Where n x n particles come to rest from `start`.
FineSolution relaxed(const pleat_api& api, const FineSquare& square, uint32_t n, const std::vector<float>& start,
                     const std::function<void()>& step) {
  demo::SceneDef def;
  def.name = square.name;
  def.rate = (n - 1) / (kMostSubsteps * kSubstep);
  def.garment = flat_square(api, n);
  def.pins = {0, n - 1};
  def.settings = fine_settings(api);
  demo::Scene scene(api, def);
  scene.check(api.cloth_write_particles(scene.world(), scene.cloths()[0], start.data(), nullptr, n * n), "start");
  constexpr uint32_t kSteps = kSolveSteps / std::size(kSides);
  const uint32_t half_second = uint32_t(0.5 * def.rate);
  std::vector<float> before, after;
  for (uint32_t i = 0; i < kSteps; ++i) {
    if (i == kSteps - half_second) scene.read_particles(0, before);
    scene.advance();
    step();
  }
  scene.read_particles(0, after);
  const double motion = largest_motion(before, after);
  return {std::move(after), motion};
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
  FineSolution solution = relaxed(api, square, kSides[0], first_state(square, kSides[0]), step);
  for (size_t level = 1; level < std::size(kSides); ++level) {
    solution = relaxed(api, square, kSides[level], refined(solution.positions, kSides[level - 1]), step);
  }
  return solution;
}

void require_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) throw demo::InputError(folder.string(), "is not a folder");
}

std::vector<float> read_fine(const std::filesystem::path& folder, const std::string& name) {
  const std::string path = file_of(folder, name).string();
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw demo::InputError(path, "cannot be read; the option --regenerate makes it anew");
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::vector<float> positions(3 * size_t{kFineSide} * kFineSide);
  const size_t expected = positions.size() * sizeof(float);
  if (bytes.size() != expected) {
    throw demo::InputError(path,
                           "should hold " + std::to_string(expected) + " bytes, holds " + std::to_string(bytes.size()));
  }
  std::memcpy(positions.data(), bytes.data(), bytes.size());
  const auto bad = std::ranges::find_if(positions, [](float x) { return !std::isfinite(x); });
  if (bad != positions.end()) {
    throw demo::InputError(path, "particle " + std::to_string((bad - positions.begin()) / 3) + " is not finite");
  }
  return positions;
}

void write_fine(const std::filesystem::path& folder, const std::string& name, const std::vector<float>& positions) {
  demo::OutputFile file(file_of(folder, name));
  file.commit({reinterpret_cast<const char*>(positions.data()), positions.size() * sizeof(float)});
}

}  // namespace pleat::bench
