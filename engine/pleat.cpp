#include "engine/pleat.h"

#include "engine/calls.h"

namespace {

using namespace pleat;

constexpr pleat_api kApi = {
    .size = sizeof(pleat_api),
    .major = PLEAT_API_MAJOR,
    .version = PLEAT_VERSION_STRING,
    .features = call::kFeatures,
    .world_def_init = call::world_def_init,
    .world_create = call::world_create,
    .world_destroy = call::world_destroy,
    .world_step = call::world_step,
    .world_set_gravity = call::world_set_gravity,
    .world_set_wind = call::world_set_wind,
    .world_stats = call::world_stats,
    .world_explain = call::world_explain,
    .world_debug_draw = call::world_debug_draw,
    .shape_def_init = call::shape_def_init,
    .shape_size = call::shape_size,
    .shape_build = call::shape_build,
    .garment_def_init = call::garment_def_init,
    .garment_create = call::garment_create,
    .garment_destroy = call::garment_destroy,
    .garment_info = call::garment_info,
    .garment_read_triangles = call::garment_read_triangles,
    .garment_read_edges = call::garment_read_edges,
    .cloth_def_init = call::cloth_def_init,
    .cloth_create = call::cloth_create,
    .cloth_destroy = call::cloth_destroy,
    .cloth_get = call::cloth_get,
    .cloth_set = call::cloth_set,
    .cloth_info = call::cloth_info,
    .cloth_move_pins = call::cloth_move_pins,
    .cloth_read_particles = call::cloth_read_particles,
    .cloth_write_particles = call::cloth_write_particles,
    .cloth_read_vertices = call::cloth_read_vertices,
    .cloth_read_indices = call::cloth_read_indices,
    .collider_def_init = call::collider_def_init,
    .collider_create = call::collider_create,
    .collider_destroy = call::collider_destroy,
    .collider_set_enabled = call::collider_set_enabled,
    .collider_move_capsule = call::collider_move_capsule,
    .collider_move_mesh = call::collider_move_mesh,
    .collider_move_rigid = call::collider_move_rigid,
    .collider_get = call::collider_get,
    .collider_set = call::collider_set,
    .world_set_gust = call::world_set_gust,
    .fabric_apply = call::fabric_apply,
    .vertex_target_init = call::vertex_target_init,
    .cloth_read_indices_16 = call::cloth_read_indices_16,
    .cloth_suggest_level = call::cloth_suggest_level,
    .cloth_contact_report = call::cloth_contact_report,
    .cloth_teleport = call::cloth_teleport,
    .cloth_bounds = call::cloth_bounds,
    .world_keep_budget = call::world_keep_budget,
    .cloth_set_importance = call::cloth_set_importance,
    .cloth_set_visible = call::cloth_set_visible,
    .world_state_size = call::world_state_size,
    .world_save = call::world_save,
    .world_load = call::world_load,
};

}  // namespace

extern "C" const pleat_api* pleat_get_api(uint32_t major) { return major == PLEAT_API_MAJOR ? &kApi : nullptr; }
