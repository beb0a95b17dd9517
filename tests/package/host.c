/* What the README tells hosts to write, at work: a square that hangs by one side swings against a thigh that comes up.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "readme_sample.h" /* the README's C */

#define CHECK(condition)                           \
  do {                                             \
    if (!(condition)) {                            \
      fprintf(stderr, "not so: %s\n", #condition); \
      exit(1);                                     \
    }                                              \
  } while (0)

enum { kSide = 9, kVertices = kSide * kSide, kTriangles = 2 * (kSide - 1) * (kSide - 1) };

int main(void) {
  const pleat_api* api = pleat_get_api(PLEAT_API_MAJOR);
  float positions[3 * kVertices], waist[3 * kSide], hip[3] = {-0.6f, -0.8f, 0.0f}, knee[3] = {0.6f, -0.8f, 0.0f};
  uint32_t triangles[3 * kTriangles], pins[kSide];
  pleat_shape_def shape;
  CHECK(api != NULL && strcmp(api->version, PLEAT_VERSION_STRING) == 0);
#ifdef VERSION /* what CMake found */
  CHECK(strcmp(VERSION, PLEAT_VERSION_STRING) == 0);
#endif
  CHECK(api->shape_def_init(&shape, sizeof shape) == PLEAT_OK);
  CHECK(api->shape_build(&shape, positions, triangles) == PLEAT_OK);
  for (uint32_t i = 0; i < kSide; ++i) pins[i] = i;
  memcpy(waist, positions, sizeof waist); /* the first row */
  const mesh square = {positions, triangles, pins, kVertices, kTriangles, kSide};

  dress(&square, hip, knee);
  vertex* vertices = calloc(info.drawn_vertices, sizeof *vertices);
  uint32_t* indices = calloc(info.drawn_triangles, 3 * sizeof *indices);
  CHECK(info.drawn_vertices > kVertices && vertices != NULL && indices != NULL);
  draw_indices(indices);
  for (int i = 0; i < 120; ++i) {
    hip[1] = knee[1] = -0.8f + 0.005f * (float)i;
    frame(1.0f / 60.0f, waist, kSide, hip, knee, vertices);
  }

  float lowest = 0.0f, most = 0.0f;
  for (uint32_t v = 0; v < info.drawn_vertices; ++v) {
    const float *p = vertices[v].position, *n = vertices[v].normal;
    CHECK(fabsf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0f) < 1e-3f);
    CHECK(hypotf(p[1] - hip[1], p[2] - hip[2]) > 0.0799f); /* outside the thigh, as it ends */
    if (p[1] < lowest) lowest = p[1];
  }
  for (uint32_t i = 0; i < 3 * info.drawn_triangles; ++i) {
    CHECK(indices[i] < info.drawn_vertices);
    if ((float)indices[i] > most) most = (float)indices[i];
  }
  CHECK(lowest < -0.3f && most > (float)kVertices);
  free(vertices);
  free(indices);
  pleat->world_destroy(world);
  return 0;
}
