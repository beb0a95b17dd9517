// The functions behind the table of engine/pleat.h, in one file for each kind of thing. Contracts are in the header.
#pragma once

#include "engine/pleat.h"

namespace pleat::call {

#ifdef PLEAT_WITH_COLLISION
inline constexpr bool kHasCollision = true;
#else
inline constexpr bool kHasCollision = false;
#endif
#ifdef PLEAT_WITH_SMOOTHING
inline constexpr bool kHasSmoothing = true;
#else
inline constexpr bool kHasSmoothing = false;
#endif

inline constexpr uint32_t kFeatures =
    (kHasCollision ? uint32_t{PLEAT_FEATURE_COLLISION} : 0u) | (kHasSmoothing ? uint32_t{PLEAT_FEATURE_SMOOTHING} : 0u);

// world_calls.cpp
pleat_result world_def_init(pleat_world_def*, size_t);
pleat_result world_create(const pleat_world_def*, pleat_world**);
void world_destroy(pleat_world*);
pleat_result world_step(pleat_world*, float);
pleat_result world_set_gravity(pleat_world*, const float[3]);
pleat_result world_set_wind(pleat_world*, const float[3]);
pleat_result world_set_gust(pleat_world*, float, float, uint32_t);
pleat_result world_keep_budget(pleat_world*, float, float);
pleat_result world_stats(const pleat_world*, pleat_stats*);
pleat_result world_explain(pleat_world*, pleat_text_fn, void*);

// state_calls.cpp
pleat_result world_state_size(const pleat_world*, uint64_t*);
pleat_result world_save(const pleat_world*, void*, uint64_t);
pleat_result world_load(pleat_world*, const void*, uint64_t);

// debug_calls.cpp
pleat_result world_debug_draw(const pleat_world*, uint32_t, pleat_line_fn, void*);

// garment_calls.cpp
pleat_result shape_def_init(pleat_shape_def*, size_t);
pleat_result shape_size(const pleat_shape_def*, uint32_t*, uint32_t*);
pleat_result shape_build(const pleat_shape_def*, float*, uint32_t*);
pleat_result garment_def_init(pleat_garment_def*, size_t);
pleat_result garment_create(pleat_world*, const pleat_garment_def*, pleat_mesh_report*, pleat_garment*);
pleat_result garment_destroy(pleat_world*, pleat_garment);
pleat_result garment_info(const pleat_world*, pleat_garment, pleat_garment_info*);
pleat_result garment_read_triangles(const pleat_world*, pleat_garment, uint32_t*, uint32_t);
pleat_result garment_read_edges(const pleat_world*, pleat_garment, uint32_t*, float*, uint32_t);

// cloth_calls.cpp
pleat_result cloth_def_init(pleat_cloth_def*, size_t);
pleat_result cloth_create(pleat_world*, const pleat_cloth_def*, pleat_cloth*);
pleat_result cloth_destroy(pleat_world*, pleat_cloth);
pleat_result cloth_get(const pleat_world*, pleat_cloth, pleat_cloth_settings*);
pleat_result cloth_set(pleat_world*, pleat_cloth, const pleat_cloth_settings*);
pleat_result cloth_set_importance(pleat_world*, pleat_cloth, float);
pleat_result cloth_set_visible(pleat_world*, pleat_cloth, uint32_t);
pleat_result cloth_info(const pleat_world*, pleat_cloth, pleat_cloth_info*);
pleat_result cloth_move_pins(pleat_world*, pleat_cloth, const float*, uint32_t, uint32_t);
pleat_result cloth_read_particles(const pleat_world*, pleat_cloth, float*, float*, uint32_t);
pleat_result cloth_write_particles(pleat_world*, pleat_cloth, const float*, const float*, uint32_t);
pleat_result cloth_teleport(pleat_world*, pleat_cloth, const float[3], const float[3], const float[4]);

// drawn_calls.cpp
pleat_result vertex_target_init(pleat_vertex_target*, size_t);
pleat_result cloth_read_vertices(const pleat_world*, pleat_cloth, const pleat_vertex_target*);
pleat_result cloth_read_indices(const pleat_world*, pleat_cloth, uint32_t*, uint32_t);
pleat_result cloth_read_indices_16(const pleat_world*, pleat_cloth, uint16_t*, uint32_t);
pleat_result cloth_suggest_level(const pleat_world*, pleat_cloth, float, uint32_t*);
pleat_result cloth_bounds(const pleat_world*, pleat_cloth, float[3], float[3]);

// fabric_calls.cpp
pleat_result fabric_apply(uint32_t, pleat_cloth_settings*);

// contact_calls.cpp
pleat_result cloth_contact_report(const pleat_world*, pleat_cloth, pleat_contact_report*);

// collider_calls.cpp
pleat_result collider_def_init(pleat_collider_def*, size_t);
pleat_result collider_create(pleat_world*, const pleat_collider_def*, pleat_collider*);
pleat_result collider_destroy(pleat_world*, pleat_collider);
pleat_result collider_set_enabled(pleat_world*, pleat_collider, uint32_t);
pleat_result collider_move_capsule(pleat_world*, pleat_collider, const float[3], const float[3]);
pleat_result collider_move_mesh(pleat_world*, pleat_collider, const float*, uint32_t, uint32_t);
pleat_result collider_move_rigid(pleat_world*, pleat_collider, const float[3], const float[4]);
pleat_result collider_get(const pleat_world*, pleat_collider, pleat_collider_settings*);
pleat_result collider_set(pleat_world*, pleat_collider, const pleat_collider_settings*);

}  // namespace pleat::call
