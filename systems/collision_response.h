// Moves the cloth out of bodies.
#pragma once

#include "components/colliders.h"
#include "components/contacts.h"
#include "components/stats.h"

namespace pleat {

/// How a face that cuts a body without a corner inside is moved; the values are those of PLEAT_FACE_RESPONSE_*.
enum class FaceResponse : std::uint32_t { kWeighted = 0, kWhole = 1 };

/// One pass over the rows, in order: where C = d - n . sum of b x > 0 the row pushes.
///   weighted: x_i += w_i b_i / (sum of w b^2) C n, so that the touching point comes to lie on the plane, or
///             part of the way there where the row's shares are less (contact_row.h);
///   whole:    x_i += C n for all corners alike (M. Oshita, A. Makinouchi, 2001, figure 6d); pinned ones stay, and
///             rows of the cloth against itself stay weighted.
/// Normals, weights and planes are fixed, so passes may be repeated and mixed with the strain limit's.
/// Writes: position (P) m, packed; push of the rows; stats.particle_, face_ and self_contacts: rows that push for the
///         first time
/// Cost:   O(rows), no allocation. Errors: none.
struct CollisionResponse {
  ContactList contacts;
  FaceResponse face_response = FaceResponse::kWeighted;
  Vec4* position = nullptr;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
