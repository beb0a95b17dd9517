/* pleat: real-time cloth for game engines. The one public header.
 *
 * A garment of a few hundred particles is simulated; a curved, length-true surface of thousands of triangles comes out.
 * Method: M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001.
 *
 * C99, no dependencies, compiles as C and C++. A host fetches the function table once,
 *
 *     const pleat_api* pleat = pleat_get_api(PLEAT_API_MAJOR);
 *
 * and then, in this order: world_create, garment_create, cloth_create, collider_create; each frame cloth_move_pins,
 * collider_move_*, world_step, cloth_read_vertices.
 *
 * Conventions
 *  - SI units: metres, seconds, kilograms, radians. Right-handed, y up, counter-clockwise faces.
 *  - Positions are three packed floats; a `stride` is in bytes from one element to the next, 0 meaning tightly packed.
 *  - Every *_def struct must be filled by its *_def_init first: that sets defaults and `size`, so that a host built
 *    against an older, smaller struct keeps working. Structs that calls fill (settings, infos, reports, statistics)
 *    begin with a `size` too: the caller sets it to the struct's sizeof, and nothing beyond it is written. A library
 *    older than the header refuses structs larger than its own, and PLEAT_HAS tells which calls it has.
 *  - Every call returns a pleat_result, in every build. After an error nothing has changed, and a line that names the
 *    field and its value has gone to the world's log. Non-finite input is refused.
 *  - Nothing here is thread-safe for one world; different worlds are independent of each other.
 *  - Pointers passed in are read during the call only. Data comes out by copy into the caller's memory.
 */
#ifndef PLEAT_H
#define PLEAT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PLEAT_API_MAJOR 1u
#define PLEAT_VERSION_STRING "0.1.0"

/* ---- results ------------------------------------------------------------------------------------------------ */

typedef uint32_t pleat_result;
enum {
  PLEAT_OK = 0,
  PLEAT_ERROR_ARGUMENT = 1,     /* a null pointer, a value out of range or not finite: the log names the field */
  PLEAT_ERROR_HANDLE = 2,       /* the id was never given out, or what it named is gone */
  PLEAT_ERROR_MESH = 3,         /* the mesh cannot be cloth: the log names the fault and where it is */
  PLEAT_ERROR_NOT_COMPILED = 4, /* asks for a part that this build leaves out: see pleat_api.features */
  PLEAT_ERROR_MEMORY = 5,       /* the host's allocator said no */
  PLEAT_ERROR_CAPACITY = 6,     /* the caller's buffer is too small, or a size is beyond PLEAT_MAX_* */
  PLEAT_ERROR_INTERNAL = 7      /* a fault of ours: please report it */
};

/* What this build holds: bits of pleat_api.features. */
enum {
  PLEAT_FEATURE_COLLISION = 1u << 0, /* colliders, through Bullet */
  PLEAT_FEATURE_SMOOTHING = 1u << 1  /* curved surfaces; without it only the flat triangles are drawn */
};

/* Sizes beyond these are refused: 32-bit indices of the drawn surface stay far from overflow. */
#define PLEAT_MAX_PARTICLES 262144u
#define PLEAT_MAX_TRIANGLES 524288u
#define PLEAT_MAX_WORKERS 64u

/* ---- handles: {index, generation}; an all-zero id is never valid ---------------------------------------------- */

typedef struct pleat_world pleat_world;
typedef struct pleat_garment {
  uint32_t index, generation;
} pleat_garment;
typedef struct pleat_cloth {
  uint32_t index, generation;
} pleat_cloth;
typedef struct pleat_collider {
  uint32_t index, generation;
} pleat_collider;

/* ---- host services --------------------------------------------------------------------------------------------- */

/* A world calls its host back during world_step, from the threads that run tasks, and during the calls that draw or
 * list. From there only calls of it may be made that take a const world, but for
 * contact reports and states; others are refused. */

typedef void* (*pleat_allocate_fn)(size_t bytes, size_t alignment, void* user);
typedef void (*pleat_free_fn)(void* memory, size_t bytes, size_t alignment, void* user);

enum { PLEAT_LOG_INFO = 0, PLEAT_LOG_WARNING = 1, PLEAT_LOG_ERROR = 2 };
typedef void (*pleat_log_fn)(uint32_t level, const char* line, void* user);

/* Called before (begin = 1) and after (begin = 0) each system of the schedule, for a host's profiler; and once a tick,
 * as `body_refit`, while the trees of bodies are brought up to date, in a world that has bodies. */
typedef void (*pleat_stage_fn)(const char* system, int begin, void* user);

/* A task for one of `workers`, and what runs tasks 0 .. count - 1, each once, on any threads, and returns when all are
 * done. worker: less than the world's `workers`; no two tasks that run at a time may have the same. */
typedef void (*pleat_task_fn)(uint32_t index, uint32_t worker, void* context);
typedef void (*pleat_parallel_for_fn)(pleat_task_fn task, uint32_t count, void* context, void* user);

typedef void (*pleat_text_fn)(const char* line, void* user);
typedef void (*pleat_line_fn)(const float from[3], const float to[3], uint32_t rgba, void* user);

/* ---- world ----------------------------------------------------------------------------------------------------- */

typedef struct pleat_world_def {
  uint32_t size;
  float gravity[3];           /* m/s2; default (0, -9.81, 0) */
  float wind[3];              /* m/s, velocity of the air; default 0. Acts on cloths with drag_coefficient > 0 */
  float air_density;          /* kg/m3; default 1.225 */
  float max_substep;          /* s, longest internal step when a cloth's `substeps` is 0; default 1/360 */
  pleat_allocate_fn allocate; /* both null (default): operator new. Never called inside world_step after warm-up.
                                 It gives what worlds, garments, cloths and bodies keep, and pleat_stats.bytes counts
                                 that. Past both go Bullet's trees of the bodies and the matrices of
                                 PLEAT_INTEGRATOR_IMPLICIT_EULER, which are Eigen's, with the lists of both, the
                                 world's own threads, and most of what a call needs only until it returns */
  pleat_free_fn free;
  void* memory_user;
  pleat_log_fn log; /* null (default): warnings and errors go to stderr */
  void* log_user;
  pleat_stage_fn stage; /* null (default): no call, no clock read */
  void* stage_user;
  float gust;           /* m/s, how far the air wavers about `wind`: root mean square on each axis; default 0 */
  float gust_frequency; /* Hz, band limit: at it the wavering is a sixth, beyond it soon nothing; default 2 */
  uint32_t gust_seed;   /* the same seed blows the same gusts, at any frame rate; default 0 */
  uint32_t workers;     /* how many cloths run at a time, at most PLEAT_MAX_WORKERS; default 1: all on the thread that
                           steps the world. Results are the same for any number. `stage` is called from all of them */
  pleat_parallel_for_fn parallel_for; /* null (default): by threads of the world's own, where workers > 1 */
  void* parallel_user;
} pleat_world_def;

/* ---- meshes ---------------------------------------------------------------------------------------------------- */

/* Mesh makers for common garments, so that a host needs no file to start. */
enum {
  PLEAT_SHAPE_GRID = 0, /* rows x columns particles in the xz plane, x along a row, centred on the origin */
  PLEAT_SHAPE_RINGS = 1 /* a tube of horizontal rings around the y axis, strips of triangles between them: a skirt */
};
typedef struct pleat_shape_def {
  uint32_t size;
  uint32_t kind;
  uint32_t rows, columns;     /* grid: particles; default 9 x 9, at least 2 x 2 */
  float width, depth;         /* grid: extent in x and in z, m; default 1 */
  uint32_t alternate;         /* grid: 1 = diagonals alternate from quad to quad; default 0: one direction */
  uint32_t ring_count;        /* rings: at least 2 */
  const uint32_t* ring_sizes; /* rings: particles of each ring, at least 3 */
  const float* ring_radii;    /* rings: m */
  const float* ring_heights;  /* rings: y, m */
} pleat_shape_def;

/* What was found in a garment's mesh. Faults marked * are repaired, the others refuse the mesh. A vertex that no
 * triangle uses, and that is no pin, is at every tick's end where a particle in the middle of the cloth is, wherever it
 * was put. */
typedef struct pleat_mesh_report {
  uint32_t size;                  /* set by the caller to sizeof(pleat_mesh_report) */
  uint32_t degenerate_triangles;  /* * zero area or a repeated corner: left out */
  uint32_t duplicate_triangles;   /* * same three corners as another: left out */
  uint32_t flipped_triangles;     /* * winding against its neighbours': turned */
  uint32_t unreferenced_vertices; /* * no triangle uses it: kept, so that indices stay the host's; see below */
  uint32_t nonmanifold_edges;     /* more than two triangles on an edge */
  uint32_t nonorientable_edges;   /* no consistent winding exists (a Moebius strip) */
  uint32_t nonmanifold_vertices;  /* two fans touch in one point: accepted, but shading there is an average */
  uint32_t parts;                 /* connected parts */
  uint32_t border_loops;          /* closed chains of border edges */
} pleat_mesh_report;

typedef struct pleat_garment_def {
  uint32_t size;
  const float* positions; /* rest shape, m */
  uint32_t position_stride;
  uint32_t vertex_count;
  const uint32_t* triangles; /* 3 indices each */
  uint32_t triangle_count;
  const float* uvs; /* 2 floats a vertex, or null */
  uint32_t uv_stride;
  const uint32_t* pins; /* vertices that follow the host (cloth_move_pins), in this order; or null */
  uint32_t pin_count;
  /* Seams: edges across which the surface is not smooth, vertex pairs; or null. Each side is curved and shaded by its
   * own normals, so drawn vertices there come twice, at the same place. The cloth moves as without. */
  const uint32_t* seams;
  uint32_t seam_count;     /* pairs */
  float crease_angle;      /* rad; edges bent by more than this at rest are seams too; default pi: none is */
  const float* added_mass; /* kg at each vertex besides the cloth's own: hem weights, buttons, buckles; or null */
} pleat_garment_def;

typedef struct pleat_garment_info {
  uint32_t size; /* set by the caller to sizeof(pleat_garment_info) */
  uint32_t particles, triangles, edges, border_edges, hinges, pins;
  float area; /* m2 at rest */
} pleat_garment_info;

/* ---- cloth ----------------------------------------------------------------------------------------------------- */

/* How a cloth steps through time. omega: its highest angular frequency, about sqrt(12 stiffness / mass of a particle).
 * Those that are stable only in short steps get more substeps by themselves; see `substeps` of a cloth. */
enum {
  /* Order 1, keeps energy, stable to 2/omega: stiff edges cost substeps. To measure what the others lose. */
  PLEAT_INTEGRATOR_SYMPLECTIC_EULER = 0,
  /* The paper, section 5. Order 1, gains energy without damping, which only the strain limit takes: to compare with. */
  PLEAT_INTEGRATOR_EXPLICIT_EULER = 1,
  /* The paper, section 4.1. Order 4 where nothing is in contact, 4 force passes, stable to 2.6/omega: for accuracy. */
  PLEAT_INTEGRATOR_RUNGE_KUTTA_4 = 2,
  /* Default. Symplectic Euler with each edge solved in turn (Macklin et al., "Small Steps", 2019): as cheap, stable at
   * any stiffness, and then softer than asked; its order is not measured. For games. */
  PLEAT_INTEGRATOR_PROJECTED = 3,
  /* All edges solved together (Baraff and Witkin, 1998) in substeps of three times the length: order 1, stable at any
   * stiffness and true to it at rest, damps motion of periods below a few substeps. For stiff fabric without the strain
   * limit; 256 particles cost ten times as much as PROJECTED. */
  PLEAT_INTEGRATOR_IMPLICIT_EULER = 4
};
enum {
  PLEAT_SURFACE_FLAT = 0,  /* the coarse triangles, subdivided in their planes */
  PLEAT_SURFACE_PN = 1,    /* curved PN triangles (Vlachos et al. 2001) */
  PLEAT_SURFACE_PAPER = 2, /* the paper's rules to the letter: normals by force, one outward fold on a short edge */
  PLEAT_SURFACE_PLEAT = 3, /* default: calm normals, folds to the side the cloth already bulges to */
  /* Other ways to curve a triangle, without folds, for comparison with PN. */
  PLEAT_SURFACE_PHONG = 4,     /* Phong tessellation (Boubekeur and Alexa 2008) */
  PLEAT_SURFACE_SPHERIGON = 5, /* Volino and Magnenat-Thalmann 1998 */
  PLEAT_SURFACE_ARC_PN = 6     /* PN triangles with the tangents of circular arcs */
};
enum {
  PLEAT_FACE_RESPONSE_WEIGHTED = 0, /* default: each corner moves by its share in the touching point */
  PLEAT_FACE_RESPONSE_WHOLE = 1     /* the paper, figure 6(d): all three corners move alike */
};
#define PLEAT_LEVEL_FAN 0u /* the paper's 18 triangles a face: 3 corner patches of 4, a fan of 6 in the middle */
#define PLEAT_LEVEL_MAX 8u /* level n = 1..8: 4 n^2 triangles a face */

/* Settings that may change while the cloth lives (cloth_set). Filled by cloth_def_init or cloth_get. */
typedef struct pleat_cloth_settings {
  uint32_t size;
  uint32_t integrator; /* default PLEAT_INTEGRATOR_PROJECTED */
  uint32_t substeps;   /* internal steps a tick; 0 (default): as many as world_def.max_substep asks for, and more when
                          a capsule crosses the cloth fast or, up to four times as many, when springs or bending need
                          shorter steps to be stable; at most 64. Of cloth with pins `projected` lets forces act
                          in up to four steps of each before that. Where all is not enough the stiffest edges act
                          softer: see stiffness_lowered */
  uint32_t sweeps;     /* passes of strain limit and contact in a substep; as many more where the farthest particle is 8
                          edges from the pins, and for each doubling of that way (without pins for each 8 edges); fewer
                          where stiffness asks for more substeps; default 3, 1..64 */
  float density;       /* kg/m2; default 0.2 */
  float stiffness; /* k of eq (1), N/m; default 335. Holds against slight compression; the strain limit holds the length
                    */
  float stretch_limit;    /* elongation that the strain limit tolerates, fraction; default 0.001; 1 = no limit */
  float bend_stiffness;   /* B of the cloth, N m; default 5e-5; 0 leaves bending out */
  float edge_damping;     /* rate at which an edge's stretching motion dies, 1/s; default 4 */
  float bend_damping;     /* the same for the angle across an edge, 1/s; default 4 */
  float air_damping;      /* rate at which all motion dies, 1/s; default 0.1 */
  float drag_coefficient; /* C_d of a face in the wind; default 0: no face drag */
  float thickness;        /* distance kept from bodies, m; default 0.005 */
  float friction;         /* Coulomb coefficient, multiplied by the collider's; default 0.2 */
  uint32_t face_response; /* default weighted */
  uint32_t surface;       /* default PLEAT_SURFACE_PLEAT */
  uint32_t level;         /* default PLEAT_LEVEL_FAN */
  float lift_coefficient; /* C_l: what air that passes a face at a slant adds to its drag, normal to it; default 0 */
  float inner_friction;   /* how threads that rub slow motion against the pins, m/s2; at rest they hold up to twice as
                             much; default 0.1: ends small swings, keeps folds from slipping late */
  uint32_t fold_sweeps;   /* steps in which the folds of PLEAT_SURFACE_PLEAT settle against each other; at most 64,
                             default 0: each edge folds on its own */
  float self_distance;    /* kept between parts of the cloth itself, m; at most a quarter of the mean edge's length is,
                             and asking for more logs a warning; default 0: it passes through itself */
  uint32_t tangents;      /* 1: make what tangent_offset of a pleat_vertex_target reads; default 0 */
  uint32_t layer;        /* of clothes worn over each other: cloths of layer 2 and up rest on those of lower layers from
                            1 on, as on moving bodies, `thickness` apart, and do not press on them; at most 15,
                            default 0: meets no other cloth */
  float buckling_strain; /* compression beyond which an edge yields, as the cloth along it would bulge: from there a
                            tenth of `stiffness` resists; fraction, default 0.01; 1: never, the paper's springs */
  float teleport_speed;  /* m/s. Pins whose mean speed, and its change from tick to tick, are both above it have jumped,
                            and so have pins that turn by more than 150 degrees in a tick: the cloth is carried along,
                            see cloth_teleport. Default 50; 0: only jumps that are declared are jumps */
  float sleep_speed; /* m/s. A cloth that was slower than this everywhere for half a second sleeps: it stays as it is
                        and costs next to nothing until its pins, bodies near it, a layer below it, the air, gravity
                        or settings change. In gusts it does not sleep. Default 0: never; .001 is hard to see */
  uint32_t collides_with; /* bits: meets the bodies that are in one of these groups, see `groups` of a collider, as if
                             there were no others; default 0xffffffff: all */
  uint32_t reserved;      /* 0: keeps the struct free of padding until a field that is 0 by default needs the place */
} pleat_cloth_settings;

/* Measured cloths, for fabric_apply. H. Wang, J. O'Brien, R. Ramamoorthi, "Data-Driven Elastic Models for Cloth", 2011:
 * kg/m2; modulus Y, N/m, and bending B, 1e-6 N m: the middle of the measured range over directions and strains. */
enum {
  PLEAT_FABRIC_POLYESTER = 0, /* woven, blouse:    .128  2080   38 */
  PLEAT_FABRIC_TROUSERS = 1,  /* woven:            .220  2080  168 */
  PLEAT_FABRIC_DENIM = 2,     /* woven, 11 ounces: .324   630   70 */
  PLEAT_FABRIC_BLANKET = 3,   /* woven:            .228   220  168 */
  PLEAT_FABRIC_INTERLOCK = 4, /* knit, T-shirt:    .187   150   23 */
  PLEAT_FABRIC_PONTE = 5,     /* knit, dress:      .284   120   30 */
  PLEAT_FABRIC_SWEAT = 6,     /* knit, hoodie:     .224   110   34 */
  PLEAT_FABRIC_NYLON = 7      /* knit, swimsuit:   .204    86   44 */
};

typedef struct pleat_cloth_def {
  uint32_t size;
  uint32_t position_stride;
  pleat_garment garment;
  const float* positions;        /* start positions, garment order; null: the rest shape */
  pleat_cloth_settings settings; /* the last field, so that it can grow; its `size` is as much as this struct holds */
} pleat_cloth_def;

typedef struct pleat_cloth_info {
  uint32_t size; /* set by the caller to sizeof(pleat_cloth_info) */
  uint32_t particles, triangles;
  uint32_t drawn_vertices, drawn_triangles; /* at the cloth's present level */
  uint32_t substeps;                        /* taken in the last tick */
  uint64_t bytes;                           /* of this cloth's own state; the garment is shared */
} pleat_cloth_info;

#define PLEAT_NO_ATTRIBUTE 0xffffffffu
/* How an attribute's numbers are written. */
enum {
  PLEAT_FORMAT_FLOAT = 0, /* default: 32-bit floats */
  PLEAT_FORMAT_16 = 1 /* positions: uint16 u from corner to corner of cloth_bounds, low + u / 65535 (high - low), off by
                         half a step at most; normals, tangents: int16 s, for s / 32767. As GPUs read UNORM, SNORM */
};
/* Where and how drawn vertices are written: an engine's interleaved vertex buffer can be the target. It is written
 * once, vertex by vertex, and not read. */
typedef struct pleat_vertex_target {
  uint32_t size;
  void* data;
  uint32_t stride;          /* bytes from one vertex to the next; as many as its attributes reach, not 0 */
  uint32_t capacity;        /* vertices */
  uint32_t position_offset; /* bytes to [3]; PLEAT_NO_ATTRIBUTE, the default of all four, leaves one out */
  uint32_t normal_offset;   /* bytes to [3], unit length */
  uint32_t uv_offset;       /* bytes to float[2]; zeros when the garment has none */
  /* Bytes to [4]: unit and across the normal, where u grows; then 1 or -1, times cross(normal, tangent) is where v
   * grows. Without uvs it is the direction nearest to the x axis. Only for cloths with settings.tangents = 1. */
  uint32_t tangent_offset;
  uint32_t position_format; /* PLEAT_FORMAT_* */
  uint32_t normal_format;   /* of tangents too */
} pleat_vertex_target;

/* ---- colliders ------------------------------------------------------------------------------------------------- */

enum {
  PLEAT_COLLIDER_CAPSULE = 0, /* all points within radius of the segment ab */
  PLEAT_COLLIDER_MESH = 1,    /* triangles with outward, counter-clockwise faces; vertices may move each frame */
  PLEAT_COLLIDER_SPHERE = 2,  /* all points within radius of a */
  PLEAT_COLLIDER_TAPERED_CAPSULE = 3, /* the hull of a ball of radius about a and one of radius_b about b */
  PLEAT_COLLIDER_PLANE = 4,           /* all points below the plane y = 0 of the body's frame */
  PLEAT_COLLIDER_BOX = 5,             /* all points within half_extents of the origin of the body's frame */
  PLEAT_COLLIDER_HULL = 6             /* the convex hull of positions in the body's frame; not flat */
};
typedef struct pleat_collider_def {
  uint32_t size;
  uint32_t shape;
  float a[3], b[3];       /* capsules: ends of the core, m; sphere: center a */
  float radius;           /* sphere, capsules: m, >= 0 */
  const float* positions; /* mesh: in the world, m; hull: in the body's frame, at most 65536 */
  uint32_t position_stride;
  uint32_t vertex_count;
  const uint32_t* triangles; /* mesh: 3 indices each */
  uint32_t triangle_count;
  float friction;        /* multiplied by the cloth's; default 1, 0..10 */
  float thickness;       /* kept from it besides the cloth's, m; default 0 */
  float radius_b;        /* tapered capsule: of the ball about b, m, >= 0 */
  float position[3];     /* plane, box, hull: origin of the body's frame, m */
  float rotation[4];     /* of that frame, a unit quaternion x, y, z, w; default 0, 0, 0, 1 */
  float half_extents[3]; /* box: m, at least 1e-4 */
  uint32_t groups;       /* bits: the groups it is in; cloths whose collides_with has none of them do not meet it, and
                            no cloth does where it is 0; default 1 */
  uint32_t reserved;     /* 0: as of pleat_cloth_settings */
} pleat_collider_def;

/* Settings that may change while the collider lives (collider_set). Filled by collider_get. */
typedef struct pleat_collider_settings {
  uint32_t size;
  float friction, thickness; /* as in pleat_collider_def */
  float radius, radius_b;    /* sphere, capsules; of a plain one both are the same. Others: 0, not read */
  uint32_t groups;           /* as in pleat_collider_def */
} pleat_collider_settings;

/* ---- what happened ---------------------------------------------------------------------------------------------- */

/* Counts since world_create, except where `last tick` is said. */
typedef struct pleat_stats {
  uint32_t size; /* set by the caller to sizeof(pleat_stats) */
  uint64_t ticks, substeps;
  uint64_t particle_contacts;  /* rows that pushed, last tick */
  uint64_t face_contacts;      /* rows that pushed, last tick */
  uint64_t contacts_dropped;   /* more touching places than a cloth has room for */
  uint64_t edges_skipped;      /* shorter than 1e-9 m when the strain limit met them */
  uint64_t nonfinite_restored; /* particles put back because a substep made them non-finite */
  uint64_t allocations;        /* calls of the world's allocator */
  uint64_t bytes, peak_bytes;  /* held through it */
  uint64_t fast_bodies;        /* ticks of a cloth in which a capsule moved more than half its radius in a substep, or
                                  where detail is given up its whole radius, so that it may have passed through: more
                                  substeps were not allowed */
  uint64_t self_contacts;      /* of a cloth with itself: rows that pushed, last tick */
  uint64_t stiffness_lowered;  /* ticks of a cloth whose stiffness or bend_stiffness its substeps could not carry: its
                                  stiffest edges or hinges acted as stiff as is stable. The log says so once */
  uint64_t teleports;          /* ticks of a cloth that carried it along with pins that jumped, declared or found. The
                                  log says once when one was found */
  uint64_t rollbacks;          /* ticks of a cloth that began anew with twice the substeps, and again with four times
                                  as many where that did not help: it had ended not finite, or with more energy than
                                  anything could have given it */
  uint64_t fallbacks;          /* of these, ticks for which no number of substeps was enough: the cloth was left as it
                                  had been, at rest, its pins where they should be. The log says so once */
  uint64_t sleeping;           /* cloths that slept through the last tick: see sleep_speed */
  uint64_t folds_given_up;     /* cloths that do without folds for the budget: see world_keep_budget */
  uint64_t substeps_given_up;  /* cloths that do with a half, a third or a quarter of their substeps */
  uint64_t invisible;          /* cloths that nobody sees: see cloth_set_visible */
  uint64_t ticks_given_up;     /* cloths that are seen and take one of two, four or eight ticks */
} pleat_stats;

/* How one cloth stands to the bodies that it collides with: see cloth_contact_report. Depths are below a body's own
 * surface, whatever thickness asks for, m; 0 outside. */
typedef struct pleat_contact_report {
  uint32_t size;              /* set by the caller to sizeof(pleat_contact_report) */
  uint32_t pins_inside;       /* pins in a body: the host put them there, and the cloth around them cannot leave */
  uint64_t particle_contacts; /* rows that pushed, last tick */
  uint64_t face_contacts;     /* rows that pushed, last tick */
  uint64_t self_contacts;     /* rows that pushed, last tick */
  uint64_t contacts_dropped;  /* touching places beyond the room, last tick */
  float particle_depth;       /* of the deepest particle that is no pin */
  float pin_depth;            /* of any point of the pins and of the edges between them: the host put them there */
  float face_depth;       /* of any point of the coarse triangles; in meshes, boxes and hulls of 45 points of each */
  float drawn_depth;      /* of any point of the drawn triangles; in meshes, boxes and hulls of their vertices. Where
                             the cloth is not visible: face_depth */
  pleat_collider deepest; /* where the largest of these is; zero when all are 0 */
  /* What contact of cloth with cloth missed: coarse edges that pass through coarse triangles. */
  uint64_t self_crossings;  /* of the cloth itself, where its self_distance is not 0 */
  uint64_t layer_crossings; /* of it and the layers below, both ways */
} pleat_contact_report;

/* What world_debug_draw shows. */
enum {
  PLEAT_DEBUG_COARSE_EDGES = 1u << 0,  /* grey */
  PLEAT_DEBUG_BASE_NORMALS = 1u << 1,  /* yellow: before normal control (the paper, figure 8d) */
  PLEAT_DEBUG_FORCE_NORMALS = 1u << 2, /* orange: after it */
  PLEAT_DEBUG_EDGE_LENGTH = 1u << 3,   /* purple: from an edge's midpoint to where edge length control moved it */
  PLEAT_DEBUG_COLLIDERS = 1u << 4      /* blue: capsule cores, planes' squares and mesh edges */
};

/* ---- the table -------------------------------------------------------------------------------------------------- */

typedef struct pleat_api {
  uint32_t size; /* of this struct: later minor versions append */
  uint32_t major;
  const char* version;
  uint32_t features; /* PLEAT_FEATURE_* bits */

  pleat_result (*world_def_init)(pleat_world_def* def, size_t size);
  pleat_result (*world_create)(const pleat_world_def* def, pleat_world** world);
  void (*world_destroy)(pleat_world* world);
  /* Advances all cloths by dt seconds, 1e-6 <= dt <= 1. Pins and colliders arrive at the poses last given. dt = 0, of
   * a game that pauses: nothing happens. */
  pleat_result (*world_step)(pleat_world* world, float dt);
  pleat_result (*world_set_gravity)(pleat_world* world, const float gravity[3]);
  pleat_result (*world_set_wind)(pleat_world* world, const float wind[3]);
  pleat_result (*world_stats)(const pleat_world* world, pleat_stats* stats);
  /* One line a system of the schedule: `name  phase  run`, or `name  phase  left out: why`. */
  pleat_result (*world_explain)(pleat_world* world, pleat_text_fn write, void* user);
  pleat_result (*world_debug_draw)(const pleat_world* world, uint32_t what, pleat_line_fn draw, void* user);

  pleat_result (*shape_def_init)(pleat_shape_def* def, size_t size);
  pleat_result (*shape_size)(const pleat_shape_def* def, uint32_t* vertex_count, uint32_t* triangle_count);
  /* positions: 3 floats a vertex; triangles: 3 indices each; room as shape_size said. */
  pleat_result (*shape_build)(const pleat_shape_def* def, float* positions, uint32_t* triangles);

  pleat_result (*garment_def_init)(pleat_garment_def* def, size_t size);
  /* report may be null; it is filled on PLEAT_ERROR_MESH too. */
  pleat_result (*garment_create)(pleat_world* world, const pleat_garment_def* def, pleat_mesh_report* report,
                                 pleat_garment* garment);
  /* Refused (PLEAT_ERROR_ARGUMENT) while a cloth uses it. */
  pleat_result (*garment_destroy)(pleat_world* world, pleat_garment garment);
  pleat_result (*garment_info)(const pleat_world* world, pleat_garment garment, pleat_garment_info* info);
  pleat_result (*garment_read_triangles)(const pleat_world* world, pleat_garment garment, uint32_t* triangles,
                                         uint32_t capacity);
  /* particles: 2 indices an edge, lower first; rest_lengths: m; either may be null. capacity: edges. */
  pleat_result (*garment_read_edges)(const pleat_world* world, pleat_garment garment, uint32_t* particles,
                                     float* rest_lengths, uint32_t capacity);

  pleat_result (*cloth_def_init)(pleat_cloth_def* def, size_t size);
  pleat_result (*cloth_create)(pleat_world* world, const pleat_cloth_def* def, pleat_cloth* cloth);
  pleat_result (*cloth_destroy)(pleat_world* world, pleat_cloth cloth);
  /* settings->size says how much of it the caller knows. */
  pleat_result (*cloth_get)(const pleat_world* world, pleat_cloth cloth, pleat_cloth_settings* settings);
  pleat_result (*cloth_set)(pleat_world* world, pleat_cloth cloth, const pleat_cloth_settings* settings);
  pleat_result (*cloth_info)(const pleat_world* world, pleat_cloth cloth, pleat_cloth_info* info);
  /* Where the pins shall be at the end of the next tick; they move there in a straight line over its substeps. */
  pleat_result (*cloth_move_pins)(pleat_world* world, pleat_cloth cloth, const float* positions, uint32_t stride,
                                  uint32_t count);
  /* Coarse particles; either pointer may be null. capacity: particles. */
  pleat_result (*cloth_read_particles)(const pleat_world* world, pleat_cloth cloth, float* positions, float* velocities,
                                       uint32_t capacity);
  /* Replaces all positions, at most 1e6 m on an axis like all places, and velocities, at most 1e5 m/s on an axis (null:
     zero): load a saved state, or place the cloth anew. Pins move too. A cloth placed without velocities that is
     stretched by half a percent or more than .5 mm inside a body is held at rest until it is not, .25 s at most. */
  pleat_result (*cloth_write_particles)(pleat_world* world, pleat_cloth cloth, const float* positions,
                                        const float* velocities, uint32_t count);
  /* The drawn surface, as of the last tick or of the last call that made, placed, set or showed the cloth; refused
   * where the cloth is not visible. */
  pleat_result (*cloth_read_vertices)(const pleat_world* world, pleat_cloth cloth, const pleat_vertex_target* target);
  /* 3 indices a drawn triangle; constant while the level is. capacity: indices. */
  pleat_result (*cloth_read_indices)(const pleat_world* world, pleat_cloth cloth, uint32_t* indices, uint32_t capacity);

  pleat_result (*collider_def_init)(pleat_collider_def* def, size_t size);
  pleat_result (*collider_create)(pleat_world* world, const pleat_collider_def* def, pleat_collider* collider);
  pleat_result (*collider_destroy)(pleat_world* world, pleat_collider collider);
  pleat_result (*collider_set_enabled)(pleat_world* world, pleat_collider collider, uint32_t enabled);
  /* Where the collider shall be at the end of the next tick; it moves there over its substeps. A sphere moves to a. */
  pleat_result (*collider_move_capsule)(pleat_world* world, pleat_collider collider, const float a[3],
                                        const float b[3]);
  pleat_result (*collider_move_mesh)(pleat_world* world, pleat_collider collider, const float* positions,
                                     uint32_t stride, uint32_t count);
  /* Planes, boxes and hulls: the origin moves in a straight line, the rotation (x, y, z, w) at a constant rate. */
  pleat_result (*collider_move_rigid)(pleat_world* world, pleat_collider collider, const float position[3],
                                      const float rotation[4]);
  /* settings->size says how much of it the caller knows. */
  pleat_result (*collider_get)(const pleat_world* world, pleat_collider collider, pleat_collider_settings* settings);
  pleat_result (*collider_set)(pleat_world* world, pleat_collider collider, const pleat_collider_settings* settings);

  /* See world_def; gusts go on from where they are in time. */
  pleat_result (*world_set_gust)(pleat_world* world, float gust, float frequency, uint32_t seed);
  /* Sets density, stiffness and bend_stiffness to a PLEAT_FABRIC_*'s and leaves the rest. They are the material's, not
   * the mesh's: finer triangles of the same shape hang alike. stiffness is sqrt(3)/2 Y, right for equilateral ones. */
  pleat_result (*fabric_apply)(uint32_t fabric, pleat_cloth_settings* settings);
  pleat_result (*vertex_target_init)(pleat_vertex_target* target, size_t size);
  /* As cloth_read_indices; refused (PLEAT_ERROR_CAPACITY) when there are more than 65,536 drawn vertices. */
  pleat_result (*cloth_read_indices_16)(const pleat_world* world, pleat_cloth cloth, uint16_t* indices,
                                        uint32_t capacity);
  /* The lowest level 1..8 that keeps the drawn triangles of the present surface within half a pixel of it, if their
   * sides are 4 pixels or longer on average. pixels_per_metre: at the cloth's distance from the eye. The cloth's own
   * level stays; a host that follows the suggestion should go down later than up, so that it does not flicker. Refused
   * where the cloth is not visible. */
  pleat_result (*cloth_suggest_level)(const pleat_world* world, pleat_cloth cloth, float pixels_per_metre,
                                      uint32_t* level);
  /* As of the last tick; a body that was moved since counts where it was. Found on this call: not asked for, it costs
   * nothing. report->size says how much of it the caller knows. */
  pleat_result (*cloth_contact_report)(const pleat_world* world, pleat_cloth cloth, pleat_contact_report* report);
  /* The character jumps: when the next tick begins the cloth is carried rigidly, turned by rotation (x, y, z, w; null:
   * not) about `from`, which is brought to `to`, m. It keeps its shape and turns its velocities. Pins that are not
   * told where to be at that tick's end come along, and so do the previous poses of bodies that this brings nearer to
   * their next ones: nothing sweeps through. Where the host does not say it, most jumps are found: see teleport_speed.
   * Refused where that takes the cloth, as it is now, beyond 1e6 m on an axis. */
  pleat_result (*cloth_teleport)(pleat_world* world, pleat_cloth cloth, const float from[3], const float to[3],
                                 const float rotation[4]);
  /* The corners of the smallest box around the drawn vertices, m: for culling, and to read 16-bit positions. Around the
   * particles where the cloth is not visible. */
  pleat_result (*cloth_bounds)(const pleat_world* world, pleat_cloth cloth, float low[3], float high[3]);
  /* Level of detail, to be called after each tick with what it took by the host's own clock: where it is more than the
   * budget, cloths give up detail step by step, as much as seems to be needed, and below .8 of it they take it back.
   *   step                                                              loss
   *   no folds, which fade within a quarter of a second                 1
   *   a half, a third, a quarter of the substeps, within two seconds    1.5, 2, 4
   *   one tick of two, four, eight                                      12, 24, 48
   * A step is given up where its loss times the cloth's importance is least. In ticks that it does without a cloth goes
   * rigidly with its pins, and its own motion is slower by as much; it takes them all where it has no pins, lies in a
   * layer, is less than two seconds old, fades, or where bodies would meanwhile go against it by an eighth, a quarter,
   * half of their radius, or by more than contact takes back in a tick. What is told of its last tick is of the last
   * that it took. Bodies do not pass through, and cloths whose `substeps` are set keep all but folds. The same numbers
   * give the same bits. What sleeps keeps what it has. budget_ms = 0: all have full detail again. The level of the
   * drawn triangles is the host's, see cloth_suggest_level: it owns the indices. */
  pleat_result (*world_keep_budget)(pleat_world* world, float budget_ms, float cost_ms);
  /* For the budget: size on screen, say, of any unit, >= 0; 1 until it is set. May be called every frame. */
  pleat_result (*cloth_set_importance)(pleat_world* world, pleat_cloth cloth, float importance);
  /* 0: nobody sees the cloth, as where its character is off the screen. Its surface is not drawn and cannot be read,
   * and at once it does with as little as a budget can leave it: see world_keep_budget. 1, as at first: its surface is
   * there again at once, and it takes all ticks, its substeps over two seconds, unless a budget says otherwise. May be
   * called every frame. */
  pleat_result (*cloth_set_visible)(pleat_world* world, pleat_cloth cloth, uint32_t visible);
  /* For rollback, replays and saved games: all that the bits of the ticks to come depend on, between two ticks. In it:
   * particles, pins, drawn surfaces, poses of bodies and whether they are enabled, what is due at the next tick, and
   * what cloths remember: friction's hold, held bending, sides of folds and of contact, sleep, detail, visibility,
   * importance, the gusts' time. Not in it: garments, settings of cloths and colliders, gravity, wind, gusts, and
   * pleat_stats. The size changes from tick to tick with contact of cloth with cloth, folds and visibility. */
  pleat_result (*world_state_size)(const pleat_world* world, uint64_t* bytes);
  /* Refused in callbacks. The same state gives the same bytes, which a host may compare. Allocates nothing. */
  pleat_result (*world_save)(const pleat_world* world, void* to, uint64_t capacity);
  /* Into the world that was saved, or one that has the same garments, cloths and colliders, made in the same order,
   * with the same settings, set before (a change wakes cloths), mesh bodies in the same poses; handles stay. For the
   * same build of the library on the same kind of machine: no file format. Bytes that do not fit the world, and numbers
   * that no tick leaves behind, are refused and nothing has changed. */
  pleat_result (*world_load)(pleat_world* world, const void* from, uint64_t bytes);
} pleat_api;

/* Whether this library's table reaches as far as that call: PLEAT_HAS(pleat, cloth_bounds). For calls that are newer
 * than the oldest library of this major version that a host wants to run with; beyond the table's end nothing may be
 * read. */
#define PLEAT_HAS(api, call) (offsetof(pleat_api, call) + sizeof((api)->call) <= (api)->size)

#if defined(_WIN32) && defined(PLEAT_BUILD)
#define PLEAT_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define PLEAT_EXPORT __attribute__((visibility("default")))
#else
#define PLEAT_EXPORT
#endif

/* The one exported symbol. Null when this library does not speak that major version. */
PLEAT_EXPORT const pleat_api* pleat_get_api(uint32_t major);

#ifdef __cplusplus
}
#endif
#endif /* PLEAT_H */
