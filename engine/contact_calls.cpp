// What a host may ask about a cloth and the bodies it touches.
#include "engine/border.h"
#include "engine/calls.h"
#include "engine/run.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/crossings.h"
#include "systems/penetration.h"
#endif

namespace pleat::call {
namespace {

#ifdef PLEAT_WITH_COLLISION
void add_depths(const World& world, const ClothRecord& cloth, pleat_contact_report& report) {
  const bool drawn = cloth.pattern() != nullptr && cloth.visible;
  const PenetrationDepths depths =
      run(Penetration{.garment = &cloth.garment(),
                      .position = world.particles.position.view().from(cloth.particle_begin),
                      .pattern = drawn ? cloth.pattern() : nullptr,
                      .drawn_position = drawn ? world.drawn.position.view().from(cloth.drawn_begin) : ConstVec3View{},
                      .origin = cloth.origin,
                      .capsules = &world.capsules,
                      .planes = world.planes.data(),
                      .plane_count = world.planes.size(),
                      .meshes = world.mesh_pointers.data(),
                      .bodies = world.bodies.get(),
                      .collides_with = cloth.settings.collides_with});
  report.pins_inside = depths.pins_inside;
  report.particle_depth = depths.particle;
  report.pin_depth = depths.pin;
  report.face_depth = depths.face;
  report.drawn_depth = depths.drawn;
  if (!depths.deepest) return;
  for (std::uint32_t i = 0; i < world.colliders.size(); ++i) {
    if (world.colliders[i].kind != depths.deepest->kind || world.colliders[i].position != depths.deepest->index)
      continue;
    const Handle handle = world.collider_handles.handle(i);
    report.deepest = {handle.index, handle.generation};
  }
}
PosedCloth posed(const World& world, const ClothRecord& cloth) {
  return {&cloth.garment(), world.particles.position.view().from(cloth.particle_begin)};
}

std::size_t crossings(const World& world, const ClothRecord& edges, const ClothRecord& faces) {
  return run(Crossings{.edges = posed(world, edges),
                       .faces = posed(world, faces),
                       .itself = &edges == &faces,
                       .scratch = &world.workers[0].near_scratch,
                       .apart = faces.origin - edges.origin});
}

void add_crossings(const World& world, const ClothRecord& cloth, pleat_contact_report& report) {
  if (cloth.settings.self_distance > 0.0f) report.self_crossings = crossings(world, cloth, cloth);
  for (const ClothRecord& below : world.clothes) {
    if (below.settings.layer == 0 || below.settings.layer >= cloth.settings.layer) continue;
    report.layer_crossings += crossings(world, cloth, below) + crossings(world, below, cloth);
  }
}
#else
void add_crossings(const World&, const ClothRecord&, pleat_contact_report&) {}
void add_depths(const World&, const ClothRecord&, pleat_contact_report&) {}
#endif

}  // namespace

pleat_result cloth_contact_report(const pleat_world* handle, pleat_cloth cloth, pleat_contact_report* report) {
  return guarded(as_world(handle), "cloth_contact_report", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    if (world.busy) refuse("the world is busy: ask when its tick is over");  // it takes a worker's scratch
    need_sized("report", report);                                            // before the work
    pleat_contact_report all{};
    all.particle_contacts = record.contacts.particle;
    all.face_contacts = record.contacts.face;
    all.self_contacts = record.contacts.self;
    all.contacts_dropped = record.contacts.dropped;
    add_depths(world, record, all);
    add_crossings(world, record, all);
    write_sized("report", report, all);
  });
}

}  // namespace pleat::call
