// How much more easily than a plate a mesh bends because its particles can zigzag.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "components/garment.h"

namespace pleat {

/// Symmetric, of the rest shape's space: xx, yy, zz, sqrt(2) yz, sqrt(2) zx, sqrt(2) xy.
using Tensor = std::array<double, 6>;

/// A face's part in its hinges' bending, over B; rows and columns of hinges that it has not are 0.
struct BentFace {
  std::array<std::uint32_t, 3> hinge{};
  std::array<bool, 3> has{};
  std::array<std::array<double, 3>, 3> share{};  // of the hinges' stiffness
  std::array<Tensor, 3> moment{};                // on each hinge when the face is bent by K: moment . K
};

/// For each face (F) the factor that its part needs so that the sheet around it, once at rest, bends to a cylinder as
/// a plate does, in the mean over the cylinder's directions.
///
/// A face's part has the plate's energy at any constant curvature K, but forces R_i . K along the normal may be left at
/// particles: on squares with alternating diagonals they point up where eight edges meet and down where four do. Then
/// the sheet zigzags and a part of the energy goes: of those squares' a quarter at a cylinder, half at a dome, none at
/// a twist. How much is found from one step of steepest descent, w_i = -t R_i . K with the best t: N^2 / 2 D of
///   N = sum of <R_i, R_i>,   D = sum of <phi_h, share_hk phi_k>,   phi_h = sum of (d turn_h / d w_i) R_i
/// over the faces around, <R, S> = tr R tr S / 8 + R : S / 4 being the mean over all cylinders K = n n^T. There the
/// zigzag is R's own direction, and this is all that is lost. With jittered particles or diagonals by chance what is
/// left over is a thirtieth. Twist, which loses nothing, becomes too stiff by the factor: nearly inextensible cloth is
/// bent to cylinders. No sum of quadratic forms of faces alone can do without: those whose R is 0 on such squares have
/// no energy left for the zigzag.
///
/// 1 where the cloth is too narrow to tell, less than about seven faces wide, or creased by more than half a radian.
/// Cost: O(F). Throws std::bad_alloc.
std::vector<double> zigzag_factors(const Garment& garment, std::span<const BentFace> faces);

}  // namespace pleat
