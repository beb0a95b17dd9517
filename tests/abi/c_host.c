/* A host in C99 that knows the header and the library's file name: loads it, lets a pinned square fall on a capsule for
 * a second, and looks at what it would draw. Exit status 0 when all is as it should be. */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/pleat.h"

#define MUST(call)                                                  \
  do {                                                              \
    pleat_result result_ = (call);                                  \
    if (result_ != PLEAT_OK) {                                      \
      fprintf(stderr, "%s: result %u\n", #call, (unsigned)result_); \
      exit(1);                                                      \
    }                                                               \
  } while (0)

#define CHECK(condition)                           \
  do {                                             \
    if (!(condition)) {                            \
      fprintf(stderr, "not so: %s\n", #condition); \
      exit(1);                                     \
    }                                              \
  } while (0)

typedef struct vertex {
  float position[3], normal[3], uv[2];
} vertex;

typedef const pleat_api* (*get_api_fn)(uint32_t);

static const pleat_api* load(const char* path) {
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  get_api_fn get_api;
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    exit(1);
  }
  *(void**)&get_api = dlsym(library, "pleat_get_api");
  CHECK(get_api != NULL);
  CHECK(get_api(PLEAT_API_MAJOR + 1) == NULL);
  CHECK(get_api(0) == NULL);
  return get_api(PLEAT_API_MAJOR);
}

static pleat_garment make_square(const pleat_api* pleat, pleat_world* world) {
  pleat_shape_def shape;
  pleat_garment_def def;
  pleat_garment garment;
  uint32_t vertex_count, triangle_count;
  const uint32_t pins[2] = {0, 8};
  float* positions;
  uint32_t* triangles;

  MUST(pleat->shape_def_init(&shape, sizeof shape));
  MUST(pleat->shape_size(&shape, &vertex_count, &triangle_count));
  CHECK(vertex_count == 81 && triangle_count == 128);
  positions = malloc(vertex_count * 3 * sizeof *positions);
  triangles = malloc(triangle_count * 3 * sizeof *triangles);
  CHECK(positions != NULL && triangles != NULL);
  MUST(pleat->shape_build(&shape, positions, triangles));
  MUST(pleat->garment_def_init(&def, sizeof def));
  def.positions = positions;
  def.vertex_count = vertex_count;
  def.triangles = triangles;
  def.triangle_count = triangle_count;
  def.pins = pins;
  def.pin_count = 2;
  MUST(pleat->garment_create(world, &def, NULL, &garment));
  free(positions);
  free(triangles);
  return garment;
}

static void check_drawn(const pleat_api* pleat, pleat_world* world, pleat_cloth cloth) {
  pleat_cloth_info info;
  pleat_vertex_target target;
  vertex* vertices;
  uint32_t* indices;
  uint32_t i, k;
  double area = 0.0;

  CHECK(PLEAT_HAS(pleat, cloth_info));
  info.size = sizeof info;
  MUST(pleat->cloth_info(world, cloth, &info));
  vertices = malloc(info.drawn_vertices * sizeof *vertices);
  indices = malloc(info.drawn_triangles * 3 * sizeof *indices);
  CHECK(vertices != NULL && indices != NULL);
  MUST(pleat->vertex_target_init(&target, sizeof target));
  target.data = vertices;
  target.stride = sizeof(vertex);
  target.capacity = info.drawn_vertices;
  target.position_offset = offsetof(vertex, position);
  target.normal_offset = offsetof(vertex, normal);
  target.uv_offset = offsetof(vertex, uv);
  MUST(pleat->cloth_read_vertices(world, cloth, &target));
  MUST(pleat->cloth_read_indices(world, cloth, indices, info.drawn_triangles * 3));

  for (i = 0; i < info.drawn_vertices; ++i) {
    float squared = 0.0f;
    for (k = 0; k < 3; ++k) {
      CHECK(isfinite(vertices[i].position[k]) && fabsf(vertices[i].position[k]) < 2.0f);
      squared += vertices[i].normal[k] * vertices[i].normal[k];
    }
    CHECK(fabsf(squared - 1.0f) < 1e-3f);
  }
  for (i = 0; i < info.drawn_triangles; ++i) {
    const float *a, *b, *c;
    double u[3], v[3], n[3];
    for (k = 0; k < 3; ++k) CHECK(indices[3 * i + k] < info.drawn_vertices);
    a = vertices[indices[3 * i]].position;
    b = vertices[indices[3 * i + 1]].position;
    c = vertices[indices[3 * i + 2]].position;
    for (k = 0; k < 3; ++k) {
      u[k] = (double)b[k] - (double)a[k];
      v[k] = (double)c[k] - (double)a[k];
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
    area += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  CHECK(area > 0.7 && area < 1.2); /* of 1 m2 */
  free(vertices);
  free(indices);
}

int main(int argc, char** argv) {
  const pleat_api* pleat;
  pleat_world_def world_def;
  pleat_world* world;
  pleat_cloth_def cloth_def;
  pleat_cloth cloth;
  pleat_stats stats;
  pleat_contact_report report;
  float positions[3 * 81];
  uint32_t i, frame;

  if (argc != 2) {
    fprintf(stderr, "usage: c_host LIBRARY\n");
    return 2;
  }
  pleat = load(argv[1]);
  CHECK(pleat != NULL && pleat->size >= sizeof(pleat_api) && pleat->major == PLEAT_API_MAJOR);
  CHECK(strcmp(pleat->version, PLEAT_VERSION_STRING) == 0);

  MUST(pleat->world_def_init(&world_def, sizeof world_def));
  MUST(pleat->world_create(&world_def, &world));
  MUST(pleat->cloth_def_init(&cloth_def, sizeof cloth_def));
  cloth_def.garment = make_square(pleat, world);
  MUST(pleat->cloth_create(world, &cloth_def, &cloth));
  check_drawn(pleat, world, cloth);

  if (pleat->features & PLEAT_FEATURE_COLLISION) {
    pleat_collider_def def;
    pleat_collider collider;
    MUST(pleat->collider_def_init(&def, sizeof def));
    def.a[0] = -0.6f;
    def.b[0] = 0.6f;
    def.a[1] = def.b[1] = -0.3f;
    def.radius = 0.15f;
    MUST(pleat->collider_create(world, &def, &collider));
  }
  for (frame = 0; frame < 60; ++frame) MUST(pleat->world_step(world, 1.0f / 60.0f));

  MUST(pleat->cloth_read_particles(world, cloth, positions, NULL, 81));
  for (i = 0; i < 3 * 81; ++i) CHECK(isfinite(positions[i]));
  CHECK(positions[3 * 76 + 1] < -0.1f); /* the free side came down */
  CHECK(positions[1] == 0.0f);          /* the pin did not */
  check_drawn(pleat, world, cloth);

  memset(&stats, 0, sizeof stats);
  stats.size = sizeof stats;
  MUST(pleat->world_stats(world, &stats));
  CHECK(stats.ticks == 60 && stats.nonfinite_restored == 0);
  CHECK(pleat->world_step(world, -1.0f) == PLEAT_ERROR_ARGUMENT);
  memset(&report, 0, sizeof report);
  report.size = sizeof report;
  MUST(pleat->cloth_contact_report(world, cloth, &report));
  CHECK(report.face_depth < 1e-3f && report.drawn_depth < 1e-3f && report.pins_inside == 0);
  if (pleat->features & PLEAT_FEATURE_COLLISION) CHECK(report.particle_contacts + report.face_contacts > 0);
  pleat->world_destroy(world);
  return 0;
}
