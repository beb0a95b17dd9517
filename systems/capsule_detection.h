// Where a cloth touches capsules.
//   M. Oshita, A. Makinouchi, 2001, section 4.4: a coarse face may cut a body although its corners are outside, so
//   edges and faces are tested as well as particles. A capsule is a segment with a radius that is linear along it; the
//   places where a triangle comes closest to it are a corner, an edge, or an end of the segment over the face, and each
//   makes a row.
#pragma once

#include "components/capsule_block.h"
#include "components/capsule_candidates.h"
#include "components/contacts.h"
#include "components/stats.h"
#include "components/vec4.h"

namespace pleat {

/// Adds a row for each candidate nearer than radius + thickness + capsule_margin to a capsule's core, at the
/// end of the substep. The normal points to the side on which the feature was when the substep began, so that what has
/// crossed the core returns to where it came from; nothing is missed while the relative motion in a substep is shorter
/// than radius + thickness. Where two capsules leave the cloth less room between them than it takes, their rows agree
/// on the middle: there it stays, calm and as deep in both, until they part.
/// Reads:  garment edges, faces; position, inverse mass and previous (P), packed, m and 1/kg; capsules; candidates
/// Writes: contacts, added to; stats.contacts_dropped; blocks
/// Cost:   O(candidates), no allocation.
/// Errors: none; features without extent make finite rows or none.
struct CapsuleDetection {
  const Garment* garment = nullptr;
  const Vec4* position = nullptr;  // predicted, and w, inverse mass
  const Vec4* previous = nullptr;  // when the substep began
  const CapsulePose* capsules = nullptr;
  std::uint32_t capsule_count = 0;
  float thickness = 0.0f;  // m
  float margin = 0.0f;     // m, capsule_margin
  float friction = 0.0f;
  float dt = 0.0f;  // s, of the substep
  const CapsuleCandidateColumns* candidates = nullptr;
  ContactList contacts;
  CapsuleBlock* blocks = nullptr;  // scratch, capsule_blocks(capsule_count)

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
