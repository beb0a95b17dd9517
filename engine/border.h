// What every call of the C interface does at its border: check what comes in, let no exception out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <string>

#include "components/limits.h"
#include "engine/world.h"

namespace pleat {

/// A host's mistake: becomes the call's result, and a line in the log.
struct Refusal {
  pleat_result result;
  std::string line;
};

[[noreturn]] inline void refuse(std::string line, pleat_result result = PLEAT_ERROR_ARGUMENT) {
  throw Refusal{result, std::move(line)};
}

inline std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

/// Runs `body`; its refusals and failures are logged for `host` and become results.
template <class Body>
pleat_result guarded(const pleat_world_def& host, const char* call, Body body) noexcept {
  const auto log = [&](const std::string& line) noexcept {
    try {
      log_line(host, PLEAT_LOG_ERROR, call + (": " + line));
    } catch (...) {
    }
  };
  try {
    body();
    return PLEAT_OK;
  } catch (const Refusal& refusal) {
    log(refusal.line);
    return refusal.result;
  } catch (const std::bad_alloc&) {
    log("out of memory");
    return PLEAT_ERROR_MEMORY;
  } catch (...) {
    log("unexpected failure inside pleat");
    return PLEAT_ERROR_INTERNAL;
  }
}

/// For the host of `world`; null: to stderr.
template <class Body>
pleat_result guarded(const World* world, const char* call, Body body) noexcept {
  return guarded(world != nullptr ? world->def : pleat_world_def{}, call, body);
}

inline void need_pointer(const char* name, const void* pointer) {
  if (pointer == nullptr) refuse(std::string(name) + " is null");
}

inline void need_range(const char* name, double value, double low, double high) {
  const float v = static_cast<float>(value);  // as floats, so that a host's own float of a limit is within it
  if (!(v >= static_cast<float>(low) && v <= static_cast<float>(high))) {  // also false for NaN
    refuse(std::string(name) + " is " + text(value) + ", must be from " + text(low) + " to " + text(high));
  }
}

inline void need_finite(const char* name, const float v[3]) {
  need_pointer(name, v);
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(v[k])) refuse(std::string(name) + "[" + std::to_string(k) + "] is " + text(v[k]));
  }
}

inline Vec3 need_place(const char* name, const float v[3]) {
  need_finite(name, v);
  for (int k = 0; k < 3; ++k) need_range(name, v[k], -kFarthest, kFarthest);
  return {v[0], v[1], v[2]};
}

inline Quaternion need_rotation(const char* name, const float q[4]) {
  need_pointer(name, q);
  const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(length - 1.0f) <= 0.01f)) {  // also false for NaN
    refuse(std::string(name) + " has the length " + text(length) + ", must be a unit quaternion");
  }
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

/// A host's list of indices of vertices has this one at [row][column].
inline void need_index(const char* name, std::size_t row, std::size_t column, std::uint32_t index,
                       std::uint32_t vertex_count) {
  if (index < vertex_count) return;
  refuse(std::string(name) + "[" + std::to_string(row) + "][" + std::to_string(column) + "] is " +
         std::to_string(index) + ", there are " + std::to_string(vertex_count) + " vertices");
}

/// Strided vectors as the host gives them, each number at most `most` away from 0.
class HostVectors {
 public:
  HostVectors(const char* name, const float* data, std::size_t stride, std::size_t count, std::size_t width = 3,
              float most = kFarthest)
      : data_(reinterpret_cast<const char*>(data)), stride_(stride != 0 ? stride : width * sizeof(float)) {
    if (count == 0) return;
    need_pointer(name, data);
    if (stride_ < width * sizeof(float)) {
      refuse(std::string(name) + "'s stride is " + std::to_string(stride) + " bytes, less than one element");
    }
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < width; ++k) {
        float value;
        std::memcpy(&value, at(i) + k * sizeof(float), sizeof value);
        if (!(std::abs(value) <= most)) {  // also for NaN
          refuse(std::string(name) + "[" + std::to_string(i) + "][" + std::to_string(k) + "] is " + text(value) +
                 ", must be from " + text(-most) + " to " + text(most));
        }
      }
    }
  }
  Vec3 operator[](std::size_t i) const {
    Vec3 v;
    std::memcpy(&v, at(i), sizeof v);
    return v;
  }
  const char* at(std::size_t i) const { return data_ + i * stride_; }
  std::size_t stride() const { return stride_; }

 private:
  const char* data_;
  std::size_t stride_;
};

/// A caller's struct, maybe an older one, says that it is as large as this. A sizeof is a multiple of the alignment, so
/// none cuts a field in two. The alignment may only grow where all older sizes are multiples of the new one.
template <class Struct>
void need_struct_size(const std::string& name, std::size_t size) {
  if (size > 0 && size <= sizeof(Struct) && size % alignof(Struct) == 0) return;
  refuse(name + " is " + std::to_string(size) + ", this library knows multiples of " + std::to_string(alignof(Struct)) +
         " up to " + std::to_string(sizeof(Struct)) +
         ": it must be the struct's sizeof, and the library as new as the header");
}
template <class Struct>
void need_sized(const char* name, const Struct* given) {
  need_pointer(name, given);
  need_struct_size<Struct>(std::string(name) + ".size", given->size);
}

/// `defaults` overlaid with what the caller's struct, maybe an older and smaller one, says.
template <class Def>
Def read_def(const char* name, const Def* given, const Def& defaults) {
  need_sized(name, given);
  Def def = defaults;
  std::memcpy(static_cast<void*>(&def), given, given->size);
  def.size = sizeof(Def);
  return def;
}

/// Whether a call would set what is set already: then it changes nothing, and wakes nobody.
template <class Settings>
bool same_bytes(const Settings& a, const Settings& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Fills the caller's struct, maybe an older and smaller one, as far as its size reaches.
template <class Struct>
void write_sized(const char* name, Struct* given, const Struct& all) {
  need_sized(name, given);
  const std::uint32_t size = given->size;
  std::memcpy(static_cast<void*>(given), &all, size);
  given->size = size;
}

/// Fills the first `size` bytes of the caller's struct with defaults.
template <class Def>
pleat_result init_def(const char* call, Def* def, std::size_t size, const Def& defaults) noexcept {
  return guarded(nullptr, call, [&] {
    need_pointer("def", def);
    need_struct_size<Def>("size", size);
    std::memcpy(static_cast<void*>(def), &defaults, size);
    def->size = static_cast<std::uint32_t>(size);
  });
}

inline const World* as_world(const pleat_world* world) { return reinterpret_cast<const World*>(world); }
inline const World& need_world(const pleat_world* world) {
  need_pointer("world", world);
  return *as_world(world);
}
/// For calls that change it.
inline World& need_world(pleat_world* world) {
  need_pointer("world", world);
  World& w = *reinterpret_cast<World*>(world);
  if (w.busy) refuse("the world is busy: its callbacks may only make calls that read");
  return w;
}

template <class Id>
std::uint32_t need_handle(const char* name, const Registry& registry, Id id) {
  const auto position = registry.find({id.index, id.generation});
  if (!position) {
    refuse(std::string(name) + " {" + std::to_string(id.index) + ", " + std::to_string(id.generation) +
               "} names nothing that lives",
           PLEAT_ERROR_HANDLE);
  }
  return *position;
}

inline ClothRecord& need_cloth(World& world, pleat_cloth id) {
  return world.clothes[need_handle("cloth", world.cloth_handles, id)];
}
inline const ClothRecord& need_cloth(const World& world, pleat_cloth id) {
  return world.clothes[need_handle("cloth", world.cloth_handles, id)];
}
inline const GarmentRecord& need_garment(const World& world, pleat_garment id) {
  return *world.garments[need_handle("garment", world.garment_handles, id)];
}

inline void need_capacity(const char* name, std::size_t capacity, std::size_t needed) {
  if (capacity < needed) {
    refuse(std::string(name) + " is " + std::to_string(capacity) + ", " + std::to_string(needed) + " are needed",
           PLEAT_ERROR_CAPACITY);
  }
}

inline void need_compiled(bool has, const char* what, const char* option) {
  if (!has) refuse(std::string(what) + " is not compiled in (" + option + "=OFF)", PLEAT_ERROR_NOT_COMPILED);
}

}  // namespace pleat
