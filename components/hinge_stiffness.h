// How the hinges around a face share in its bending.
//   E. Onate, F. Zarate, "Rotation-free triangular plate and shell elements", 2000: a triangle's curvature from its own
//   and the three neighbours' normals, and its energy from that.
#pragma once

#include "components/garment.h"

namespace pleat {

/// Fills the hinges' shapes and couplings from the rest shape.
///
/// A sheet bent to w = K(x, x) / 2, K its curvature, turns hinge h by m_h . K: for flat faces of heights p and q on the
/// edge, whose tips project to it at s and t of its length l (axes: along the edge, across, mixed),
///   m_h = (s (s - l) / p + t (t - l) / q,  p + q,  2 (s - t)) / 2
/// A face knows the m_h of its hinges M, and from their turns the least K that fits, M^T (M M^T)^-1 theta. Its energy
/// is that of a plate without Poisson effect, B A |K|^2 / 2: hinges are stiff by A (M M^T)^-1, summed over faces. So
/// any constant curvature costs what it should on any mesh, borders are free, and turns of no curvature (M M^T has full
/// rank) cost too. Hinges taken alone do so on equilateral triangles only; on squares with a diagonal, edges feel
/// twist. Where the mesh would then give way in a zigzag, faces are stiffer by as much as that takes (zigzag.h).
///
/// Where a face and its neighbours have their six corners near one conic, turns do not tell curvature, and hinges would
/// be stiff without bound: they are coupled less then, so that none is more than three times as stiff as it is alone.
/// Cost: O(F). Throws std::bad_alloc.
void measure_hinges(Garment& garment);

}  // namespace pleat
