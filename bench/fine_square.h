#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "demo/scenes/triangle_mesh.h"
#include "engine/pleat.h"

namespace pleat::bench {

/// A square of cloth, 1 m a side, hung by its two upper corners: what the surfaces over few particles are held against.
struct FineSquare {
  const char* name;
  double width;    ///< m between the pins
  int half_waves;  ///< across the cloth, in the state that it starts from
};
inline constexpr std::array<FineSquare, 4> kFineSquares = {
    {{"w0.6", 0.6, 1}, {"w0.8", 0.8, 1}, {"w0.8_waves", 0.8, 6}, {"w1.0", 1.0, 1}}};
inline constexpr uint32_t kFineSide = 65;  ///< particles along a side

/// A flat square of n x n particles at rest, row by row; its diagonals alternate.
demo::TriangleMesh flat_square(const pleat_api& api, uint32_t n);

struct FineSolution {
  std::vector<float> positions;  ///< (kFineSide^2, 3) m, in the order of flat_square
  double motion;                 ///< m, the farthest that a particle went in the last half second
};

/// The square at rest: springs of 300 N/m, bending of 2e-5 N m, .2 kg/m^2, no strain limit, damped until it hardly
/// moves; first with 17 x 17 particles, then with 33 x 33, then all. Minutes of work: calls `step` kSolveSteps times on
/// the way. Throws std::runtime_error for a fault of ours.
FineSolution solve(const pleat_api& api, const FineSquare& square, const std::function<void()>& step);
inline constexpr uint32_t kSolveSteps = 1800;

/// Throws InputError where there is no such folder: to be known before minutes of work.
void require_folder(const std::filesystem::path& folder);

/// A solution as it is kept in the file `NAME.f32`: 32-bit little-endian floats. Throw InputError, naming the file,
/// where it cannot be read or written, is not of the right length, or holds what is not finite.
std::vector<float> read_fine(const std::filesystem::path& folder, const std::string& name);
void write_fine(const std::filesystem::path& folder, const std::string& name, const std::vector<float>& positions);

}  // namespace pleat::bench
