/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef IMPINGE_IMPINGE_H
#define IMPINGE_IMPINGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <impinge/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* libimpinge: the earliest contact of moving, deforming surfaces, with proof
 * =========================================================================
 *
 *   imp_registry   where surface types and maps are found: directories of plugins
 *   imp_scene      bodies, each of one or more surfaces, under motions
 *   imp_query      one question about a scene: who touches first, and when?
 *
 * A scene keeps the plugins it uses loaded through its registry: free queries first,
 * then scenes, then the registry. Objects are not locked: use one from one
 * thread at a time; different scenes may be used from different threads at once.
 * Only imp_query_cancel may be called from anywhere, signal handlers included.
 *
 * Nothing here prints, exits, or changes errno's meaning for the caller. */

/* --- What can go wrong -------------------------------------------------------- */

typedef enum imp_code {
    IMP_SUCCESS = 0,
    IMP_ERROR_USAGE,  /* an argument is out of its documented range */
    IMP_ERROR_SCENE,  /* a scene, a parameter or a pipeline is wrong */
    IMP_ERROR_PLUGIN, /* a plugin broke the ABI's promises */
    IMP_ERROR_FILE,   /* a file cannot be read or written */
    IMP_ERROR_MEMORY  /* memory ran out */
} imp_code;

/* Filled on every answer but IMP_SUCCESS: place, what was found, what is allowed. Owned by the
 * caller; NULL is accepted wherever a pointer to one is asked for. */
typedef struct imp_error {
    imp_code code;
    char text[1000];
} imp_error;

/* "libimpinge x.y.z" of the library that runs, which may be newer than this header. */
IMP_EXPORT const char *imp_version(void);

/* One English phrase for a code. */
IMP_EXPORT const char *imp_code_text(imp_code code);

/* Which name was meant? Begin with {.wanted = what was written}, offer all names there are, read
 * `best`: it stays NULL while nothing is near, that is, at most one change of a letter, insertion,
 * removal or swap of neighbours away for every three letters written. Of equals the first stays. */
typedef struct imp_nearest {
    const char *wanted;
    const char *best;
    size_t distance; /* of best */
} imp_nearest;
IMP_EXPORT void imp_nearest_offer(imp_nearest *search, const char *candidate);

/* The name of the type whose plugin this thread is in, and the callback ("eval", ...); NULL: in
 * none. For handlers of SIGSEGV and the like, to say whose fault it is. [async-signal-safe] */
IMP_EXPORT const char *imp_call_in_progress(const char **callback);

/* --- Registry: the types at hand ---------------------------------------------- */

typedef struct imp_registry imp_registry;

/* Scans, in this order: the directories of `path` (colon-separated, may be NULL), those of
 * the environment's IMPINGE_PLUGIN_PATH (unless the process is privileged), the user's
 * plugin directory, and the installed one. Returns NULL only when memory runs out. */
IMP_EXPORT imp_registry *imp_registry_new(const char *path);

/* The same with flags: IMP_REGISTRY_SECURE passes over directories that anyone may write to
 * (otherwise they are told by imp_registry_warning). A file that was never seen is loaded in a
 * child process first; the outcome is kept in the user's cache ($XDG_CACHE_HOME/impinge/trials). */
enum { IMP_REGISTRY_SECURE = 1 };
IMP_EXPORT imp_registry *imp_registry_open(const char *path, unsigned flags);

/* The same of one plugin file alone, taken or refused. */
IMP_EXPORT imp_registry *imp_registry_from_file(const char *file);
IMP_EXPORT void imp_registry_free(imp_registry *registry);

/* From now on, instances of these types (names between commas; NULL: all) live in processes of
 * their own, one for each instance: a plugin that crashes or hangs costs an error, not the host. A
 * call then takes some microseconds more. IMP_ERROR_USAGE: no such type. */
IMP_EXPORT imp_code imp_registry_isolate(imp_registry *registry, const char *names,
                                         imp_error *error);

typedef enum imp_type_sort { IMP_SORT_SURFACE, IMP_SORT_MAP } imp_type_sort;

/* One type found. Strings live as long as the registry. */
typedef struct imp_type_info {
    imp_type_sort sort;
    const char *name, *summary, *equation, *source, *example; /* source may be NULL */
    const char *file;                                         /* absolute path of the plugin */
    const char *plugin, *version, *license, *author;
    const char *shadowed_by;         /* file of the earlier type of that name, or NULL */
    const imp_parameter *parameters; /* step by parameter_size bytes */
    size_t parameter_count, parameter_size;
} imp_type_info;

/* Types in the order found, shadowed ones included. Returns false past the last. */
IMP_EXPORT bool imp_registry_type(const imp_registry *registry, size_t index, imp_type_info *info);

/* Files that were not taken, and why; directories that cannot be read. */
typedef struct imp_plugin_refusal {
    const char *file, *reason;
} imp_plugin_refusal;
IMP_EXPORT bool imp_registry_refusal(const imp_registry *registry, size_t index,
                                     imp_plugin_refusal *refusal);

/* Directories whose plugins were taken all the same, and why they should not be trusted. */
IMP_EXPORT bool imp_registry_warning(const imp_registry *registry, size_t index,
                                     imp_plugin_refusal *warning);

/* Everything that is checked of a plugin file, in order, each with a verdict: told one by one. What
 * comes after a refusal and depends on it is not reached. Loads the file in a child process
 * only. Answers whether all passed. */
typedef enum imp_finding { IMP_NOT_REACHED, IMP_PASSED, IMP_REFUSED } imp_finding;
typedef void (*imp_finding_sink)(void *context, const char *check, imp_finding finding,
                                 const char *text);
IMP_EXPORT bool imp_plugin_examine(const char *path, imp_finding_sink tell, void *context);

/* One surface or map by itself, for programs that examine a type: its callbacks
 * (<impinge/surface.h>) and what create made. Without the guards that scenes put around
 * every call. */
typedef struct imp_instance {
    const imp_surface_type *surface; /* NULL: it is a map */
    const imp_map_type *map;         /* NULL: it is a surface */
    void *self;
} imp_instance;

/* From one stage of a pipeline, "TYPE name=value ...". The registry must outlive the instance. */
IMP_EXPORT imp_code imp_instance_from_text(imp_registry *registry, imp_type_sort sort,
                                           const char *text, imp_instance *instance,
                                           imp_error *error);
/* An empty one ({NULL, NULL, NULL}) may be freed too. */
IMP_EXPORT void imp_instance_free(imp_instance *instance);

/* --- Scenes --------------------------------------------------------------------- */

typedef struct imp_scene imp_scene;

/* From the text of a scene file ({"time", "gamma", "bodies", "ignore"}; README shows one). `name`
 * stands in error messages for the text ("scene.json", "standard input"). NULL on error. */
IMP_EXPORT imp_scene *imp_scene_from_json(imp_registry *registry, const char *text, size_t length,
                                          const char *name, imp_error *error);
IMP_EXPORT imp_scene *imp_scene_from_file(imp_registry *registry, const char *path,
                                          imp_error *error);
/* Bodies "a" and "b" from two pipelines: "TYPE name=value ... ! MAP name=value ...". */
IMP_EXPORT imp_scene *imp_scene_from_pair(imp_registry *registry, const char *a, const char *b,
                                          imp_error *error);
IMP_EXPORT void imp_scene_free(imp_scene *scene);

IMP_EXPORT size_t imp_scene_body_count(const imp_scene *scene);
IMP_EXPORT const char *imp_scene_body_name(const imp_scene *scene, size_t body);
IMP_EXPORT size_t imp_scene_surface_count(const imp_scene *scene, size_t body);

/* n points p[3*k] = (u, v, t) of one surface, maps applied, to x[3*k] and, unless NULL,
 * error[3*k]. */
IMP_EXPORT imp_code imp_scene_eval(const imp_scene *scene, size_t body, size_t surface, size_t n,
                                   const double *p, double *x, double *error, imp_error *why);
/* The surface's domain; times are those common to it and its maps, perhaps infinite or,
 * when they have none in common, lo[2] > hi[2]. */
IMP_EXPORT void imp_scene_domain(const imp_scene *scene, size_t body, size_t surface, double lo[3],
                                 double hi[3]);

/* --- Queries ----------------------------------------------------------------------- */

typedef enum imp_verdict { IMP_CLEAR, IMP_CONTACT, IMP_UNDECIDED } imp_verdict;

typedef enum imp_reason {
    IMP_REASON_NONE,       /* contact, or clear after a search */
    IMP_REASON_NO_TIME,    /* clear: the surfaces' time domains have no time in common */
    IMP_REASON_NO_PAIRS,   /* clear: nothing to test (one body, or all pairs ignored) */
    IMP_REASON_PAIRS,      /* undecided: max_pairs reached */
    IMP_REASON_SECONDS,    /* undecided: max_seconds reached */
    IMP_REASON_MEMORY,     /* undecided: max_bytes reached, or memory ran out */
    IMP_REASON_CANCELLED,  /* undecided: imp_query_cancel */
    IMP_REASON_RESOLUTION, /* undecided: gamma is below what double precision resolves here */
    IMP_REASON_RUNNING     /* undecided: not finished yet */
} imp_reason;

typedef enum imp_method {
    IMP_METHOD_MODELS, /* order-2 inclusions, windows in time (default) */
    IMP_METHOD_PAPER   /* the 1990 algorithm, kept as the baseline */
} imp_method;
typedef enum imp_bounds { IMP_BOUNDS_BOX, IMP_BOUNDS_SPHERE } imp_bounds; /* paper only */
typedef enum imp_rates { IMP_RATES_FULL, IMP_RATES_COLUMN, IMP_RATES_CONSTANT } imp_rates;

/* Start from imp_options_default(scene) and change what you need. */
typedef struct imp_options {
    double t_start, t_end; /* t_start <= t_end, finite */
    double gamma;          /* > 0, length: what is reported is no farther apart */
    double clearance;      /* gamma_clear, in [0, gamma), length; < 0: gamma / 2 */
    uint64_t max_pairs;    /* pairs tested; 0: no limit */
    double max_seconds;    /* wall clock; 0: no limit */
    uint64_t max_bytes;    /* memory of trees and heap; 0: no limit */
    imp_method method;
    imp_bounds bounds;
    imp_rates rates;
    bool audit; /* hold every node's bounds against points of it: slower, catches liars */
} imp_options;

IMP_EXPORT imp_options imp_options_default(const imp_scene *scene);

/* One side of a witness. */
typedef struct imp_side {
    size_t body, surface; /* indices in the scene */
    double u, v;
    double point[3]; /* world space */
} imp_side;

typedef struct imp_stats {
    double seconds;     /* wall clock spent in imp_query_step */
    uint64_t pairs;     /* pairs of nodes tested for separation */
    uint64_t nodes;     /* nodes made for this query */
    uint64_t peak_heap; /* most pairs waiting at once */
    uint64_t witness_searches;
    uint64_t bytes; /* peak memory of trees and heap */
} imp_stats;

/* What is proved so far. With gamma_clear = the clearance in force:
 *   (a) no points of two bodies are nearer than gamma_clear at any time in [t_start, t_lower);
 *       for every verdict, undecided included;
 *   (b) CONTACT: a.point and b.point lie on their surfaces at time t, evaluated, no farther than
 *       gamma apart, rounding included, and t == t_lower;
 *   (c) CLEAR: never nearer than gamma_clear in [t_start, t_end]; t_lower == t_end. */
typedef struct imp_result {
    imp_verdict verdict;
    imp_reason reason;
    double t; /* CONTACT only, else NAN */
    double t_lower;
    double gap; /* CONTACT: distance of the two points; else NAN */
    double gamma, gamma_clear;
    imp_side a, b; /* CONTACT only; a.body < b.body */
    bool has_normal;
    double normal[3]; /* a to b, unit length, world space; only if has_normal */
    imp_stats stats;
} imp_result;

typedef struct imp_query imp_query;

/* Begins; nothing is tested yet. The scene must outlive the query, and is shared by it: trees made
 * by one query serve the next over the same times. NULL on error (options, plugin, memory). */
IMP_EXPORT imp_query *imp_query_new(imp_scene *scene, const imp_options *options, imp_error *error);
IMP_EXPORT void imp_query_free(imp_query *query);

/* Tests about `pairs` more pairs (0: until decided). IMP_ERROR_PLUGIN ends the query for good.
 * After any success imp_query_result tells how far it came; done when its reason is not RUNNING. */
IMP_EXPORT imp_code imp_query_step(imp_query *query, uint64_t pairs, imp_error *error);
IMP_EXPORT imp_result imp_query_result(const imp_query *query);

/* Ask again, finer: gamma and clearance (< 0: gamma / 2) no larger than now. Work done so far is
 * kept; continue with imp_query_step. */
IMP_EXPORT imp_code imp_query_refine(imp_query *query, double gamma, double clearance,
                                     imp_error *error);

/* Ends the running step soon, as UNDECIDED. [any thread, async-signal-safe] */
IMP_EXPORT void imp_query_cancel(imp_query *query);

/* new, step to the end, result, free. */
IMP_EXPORT imp_code imp_solve(imp_scene *scene, const imp_options *options, imp_result *result,
                              imp_error *error);

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_IMPINGE_H */
