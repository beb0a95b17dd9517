// What the files of the schedule's rows share: running a system, and why a row may be left out.
#pragma once

#include <cassert>

#include "engine/schedule_table.h"

namespace pleat {

template <class System, class... Counters>
void run(const System& system, Counters&... counters) {
  assert(system.validate());
  system.run(counters...);
}

constexpr const char* kNeeded = nullptr;
inline const char* always(const World&, const ClothRecord&) { return kNeeded; }

inline const char* with_colliders(const World& w, const ClothRecord&) {
  return w.colliders.empty() ? "no collider" : kNeeded;
}
inline const char* with_capsules(const World& w, const ClothRecord&) {
  return w.colliders.empty() ? "no collider" : w.capsules.size() == 0 ? "no capsule" : kNeeded;
}
inline const char* with_planes(const World& w, const ClothRecord&) {
  return w.colliders.empty() ? "no collider" : w.planes.size() == 0 ? "no plane" : kNeeded;
}
inline const char* with_capsules_or_planes(const World& w, const ClothRecord&) {
  return w.colliders.empty()                        ? "no collider"
         : w.capsules.size() + w.planes.size() == 0 ? "no capsule and no plane"
                                                    : kNeeded;
}
inline const char* with_meshes(const World& w, const ClothRecord&) {
  return w.colliders.empty() ? "no collider" : w.meshes.empty() ? "no mesh body" : kNeeded;
}

#ifdef PLEAT_WITH_COLLISION
inline ContactList contacts_of(ClothTick& t) {
  World& w = t.world;
  return {w.contacts.data(), static_cast<std::uint32_t>(w.contacts.size()), &w.contact_count};
}
#endif

}  // namespace pleat
