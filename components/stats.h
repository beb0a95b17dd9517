// What the systems count while they run. Plain sums: a tick adds to them and the engine hands them out.
#pragma once

#include <cstdint>

namespace pleat {

struct Stats {
  std::uint64_t particle_contacts = 0;   // rows at one particle that pushed
  std::uint64_t face_contacts = 0;       // rows on edges and faces that pushed
  std::uint64_t self_contacts = 0;       // rows of a cloth against itself that pushed
  std::uint64_t contacts_dropped = 0;    // touching places beyond the contact capacity
  std::uint64_t edges_skipped = 0;       // met by the strain limit while shorter than 1e-9 m
  std::uint64_t fast_bodies = 0;         // ticks of a cloth in which a body outran the substeps
  std::uint64_t stiffness_lowered = 0;   // ticks of a cloth stiffer than its substeps could carry
  std::uint64_t teleports = 0;           // ticks of a cloth whose pins jumped
  std::uint64_t rollbacks = 0;           // ticks of a cloth that began anew
  std::uint64_t fallbacks = 0;           // of these, ticks without a good end
  std::uint64_t sleeping = 0;            // cloths that slept through the tick
  std::uint64_t nonfinite_restored = 0;  // particles put back to where they were finite

  Stats& operator+=(const Stats& b) {
    particle_contacts += b.particle_contacts, face_contacts += b.face_contacts, self_contacts += b.self_contacts;
    contacts_dropped += b.contacts_dropped, edges_skipped += b.edges_skipped, fast_bodies += b.fast_bodies;
    stiffness_lowered += b.stiffness_lowered, teleports += b.teleports, rollbacks += b.rollbacks;
    fallbacks += b.fallbacks, sleeping += b.sleeping, nonfinite_restored += b.nonfinite_restored;
    return *this;
  }
};

}  // namespace pleat
