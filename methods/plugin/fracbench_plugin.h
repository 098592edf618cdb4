/* What a fracture method in a shared library exports, for the method `plugin`
 * (docs/add-a-method.md). Plain C, so that any language that can make a shared library will do.
 * Lengths in m, masses in kg, times in s, everything in the body's own frame. */
#ifndef FRACBENCH_PLUGIN_H
#define FRACBENCH_PLUGIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes whenever anything below does. */
#define FRACBENCH_PLUGIN_VERSION 1

/* A closed triangle mesh whose faces look outwards. */
typedef struct fracbench_mesh {
  int64_t vertex_count;
  const double* vertices; /* x, y, z of each */
  int64_t face_count;
  const int32_t* faces; /* three vertices of each, from 0, counter-clockwise from outside */
} fracbench_mesh;

typedef struct fracbench_material {
  double young_modulus; /* Pa */
  double poisson_ratio;
  double density;            /* kg/m^3 */
  double strength;           /* tensile, Pa */
  double toughness;          /* Pa sqrt(m) */
  double compressive_factor; /* compressive over tensile strength */
} fracbench_material;

typedef struct fracbench_impulse {
  double point[3];     /* on the surface */
  double direction[3]; /* unit vector, the way the body is pushed */
  double magnitude;    /* N s */
  double normal[3];    /* outward unit normal of the face that is hit */
  double face_area;
  int32_t face; /* of the body's mesh */
} fracbench_impulse;

typedef struct fracbench_impact {
  int64_t impulse_count;
  const fracbench_impulse* impulses; /* strongest first */
  double overload;  /* the impulse over the one that would just break the body; 0: not known */
  double time_step; /* of the rigid-body scene */
  double velocity[3], angular_velocity[3]; /* of the body before the impact */
  uint64_t seed;                           /* the only source of chance */
  int32_t threads;                         /* that may be used */
} fracbench_impact;

/* What the program offers for the length of a call. `handle` goes into each function. Pointers that
 * are passed to it need to live no longer than the call. */
typedef struct fracbench_host {
  void* handle;
  /* The next fragment. They must not overlap and together fill the body; one alone means that it
   * stays whole. */
  void (*add_fragment)(void* handle, const fracbench_mesh* fragment);
  /* The call has failed, in words for the user. The first one counts. */
  void (*fail)(void* handle, const char* why);
  /* How far long work is, from 0 to 1. */
  void (*progress)(void* handle, double share);
  /* Not 0: return soon, whatever the state; to be asked at least twice a second. */
  int (*stopped)(void* handle);
} fracbench_host;

/* What the library exports. */

/* FRACBENCH_PLUGIN_VERSION, as it was when the library was built. */
int32_t fracbench_plugin_version(void);
/* What is computed once for a body, before all impacts; may be NULL. `settings` is the user's. */
void* fracbench_plugin_prepare(const fracbench_mesh* body, const fracbench_material* material,
                               const char* settings, const fracbench_host* host);
/* Breaks the body. One prepared body serves many impacts, some at the same time, and the answer to
 * one must not depend on the others. */
void fracbench_plugin_fracture(void* prepared, const fracbench_impact* impact,
                               const fracbench_host* host);
void fracbench_plugin_release(void* prepared);

#ifdef __cplusplus
}
#endif

#endif
