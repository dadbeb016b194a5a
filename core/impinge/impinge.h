/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef IMPINGE_IMPINGE_H
#define IMPINGE_IMPINGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

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
 * then scenes, then the registry.
 *
 * Threads: a registry and a scene are only read once they are made, and may be used by several
 * threads at once: to make scenes, to evaluate, to begin and to step queries. Queries of one scene
 * share its trees, which are locked where they grow, and answer as if each were alone, bit for bit;
 * only what depends on who came first differs, stats.nodes and stats.bytes, and so does where
 * max_seconds or max_bytes end a query. One query of a large scene uses several threads where the
 * program lends it some (imp_options.parallel): for the trees, the broad phase and the first test
 * of each pair of surfaces that come near each other. Its answer and stats but for seconds are the
 * same without, but that stats.bytes depend on who came first until it is decided. A query and a
 * builder belong to one thread at a time. Before something is freed all other threads must be done
 * with it; imp_registry_isolate and imp_registry_add need the registry to themselves. Only
 * imp_query_cancel may be called from anywhere, signal handlers included.
 *
 * Structs that may grow begin with their size as the program was compiled, and grow at the end: the
 * library reads and writes no further. Functions named ..._get_... fill a struct whose struct_size
 * the caller has set; inline functions without get_ set it and answer the struct by value.
 *
 * Nothing here prints, exits, or changes errno's meaning for the caller.
 *
 * Floating point: answers do not depend on the mode the program has set. Every function here that
 * computes or runs code of a plugin sets the default environment for the time of the call (round to
 * nearest, subnormals kept, exceptions masked: FE_DFL_ENV) and restores the program's own, sticky
 * flags included. The program's callbacks are called in the default environment. */

/* --- Error: what can go wrong ----------------------------------------------------------------- */

/* The codes that functions of the library return. (Callbacks of plugins return an imp_status.) */
typedef enum imp_code {
    IMP_SUCCESS = 0,
    IMP_ERROR_USAGE,  /* an argument is out of its documented range */
    IMP_ERROR_SCENE,  /* a scene, a parameter or a pipeline is wrong */
    IMP_ERROR_PLUGIN, /* a plugin broke the ABI's promises */
    IMP_ERROR_FILE,   /* a file cannot be read or written */
    IMP_ERROR_MEMORY, /* memory ran out */
    IMP_ERROR_LIMIT   /* reading a scene has reached a limit (imp_registry_limit_reading); or an
                       * isolated type had not answered when max_seconds was over */
} imp_code;

/* Misuse: where a function needs an object, a text or a place that is NULL, or an index is out of
 * range, the answer is IMP_ERROR_USAGE, or NULL, 0 or false from functions that answer no code.
 * Free and cancel take NULL. */

/* Describes a failure: the place, what was found, what is allowed. Functions fill it whenever they
 * do not return IMP_SUCCESS. The caller owns it, and may pass NULL instead of one. */
typedef struct imp_error {
    imp_code code;
    char text[1000];
} imp_error;

/* Returns "libimpinge x.y.z", the version of the library that runs, which may be newer than this
 * header. */
IMP_EXPORT const char *imp_version(void);

/* Returns one English phrase for a code. The text is static. */
IMP_EXPORT const char *imp_code_text(imp_code code);

/* Returns the name of the type whose plugin this thread is in, and sets *callback to the callback's
 * name ("eval", ...). While a plugin is loaded or unloaded it returns the absolute path of its
 * file, and *callback is "constructor", "get_factory", "destructor", or "impinge_plugin" while its
 * entry is read. NULL: the thread is in no plugin. A handler of SIGSEGV and the like can so say
 * whose fault it is. [async-signal-safe] */
IMP_EXPORT const char *imp_call_in_progress(const char **callback);

/* Like imp_call_in_progress, for another thread, which may hang: imp_call_of_thread answers a
 * handle of the calling thread, imp_call_read what that thread is in. The handle is valid until its
 * thread ends. [async-signal-safe] */
typedef struct imp_call imp_call;
IMP_EXPORT const imp_call *imp_call_of_thread(void);
IMP_EXPORT const char *imp_call_read(const imp_call *call, const char **callback);

/* The library uses jansson for scenes and parameters, and leaves its allocator
 * (json_set_alloc_funcs) to the program. */

/* --- Registry: the types available ------------------------------------------------------------ */

typedef struct imp_registry imp_registry;

/* Scans, in this order: the directories of `path` (colon-separated, may be NULL), those of
 * the environment's IMPINGE_PLUGIN_PATH (unless the process is privileged), the user's
 * plugin directory, and the installed one. Returns NULL only when memory runs out. */
IMP_EXPORT imp_registry *imp_registry_new(const char *path);

/* Like imp_registry_new, with flags. IMP_REGISTRY_SECURE refuses files and directories that others
 * than root and the user could change or replace: on the whole real path, through links, nothing
 * may belong to another user or be writable by everybody (directories above may, if they are
 * sticky). Without it imp_registry_warning reports directories that anyone may write to. A file
 * that was never seen is loaded in a child process first; the outcome is kept in the user's cache
 * ($XDG_CACHE_HOME/impinge/trials). IMP_REGISTRY_ONLY_PATH: the directories of `path` alone, or
 * none, for programs that bring their types along by imp_registry_add. */
enum { IMP_REGISTRY_SECURE = 1, IMP_REGISTRY_ONLY_PATH = 2 };
IMP_EXPORT imp_registry *imp_registry_open(const char *path, unsigned flags);

/* Makes a registry of one plugin file alone, which is taken or refused (imp_registry_refusal).
 * NULL: no memory. The caller frees it. */
IMP_EXPORT imp_registry *imp_registry_from_file(const char *file);

/* Adds the types of a plugin that is linked into the program, after all others; it must stay as
 * long as the registry, which nothing else may use meanwhile. It is compiled with its symbol
 * renamed (IMPINGE_PLUGIN_SYMBOL in <impinge/surface.h>). Its entry and tables are checked as those
 * of a file, and IMP_ERROR_PLUGIN adds nothing. A plugin that is there already is ignored. */
IMP_EXPORT imp_code imp_registry_add(imp_registry *registry, const imp_plugin *plugin,
                                     imp_error *error);

/* Frees a registry, whose scenes are freed already. Until then it keeps up to 1 MiB of the memory
 * of scenes that were freed, for the next ones, and instances of types that read files, such as
 * meshes: a scene that names such a file with equal parameters shares the instance, and what
 * queries found out about all of its pieces, as long as the file stays as it was, by its inode,
 * size and times (and had not changed within two seconds before it was read). It keeps at most 256
 * instances of 256 MiB together, and none that a thousand later ones did not ask for. Each scene
 * counts those it uses in its bytes. */
IMP_EXPORT void imp_registry_free(imp_registry *registry);

/* From now on, new instances of these types (names between commas; NULL: all) live in other
 * processes, one for each type: a plugin that crashes or hangs costs an error, not the host. A call
 * then takes some microseconds more. The processes belong to the one that called this: in a copy
 * made by fork, queries of isolated scenes answer IMP_ERROR_USAGE. IMP_ERROR_USAGE: no such type.
 */
IMP_EXPORT imp_code imp_registry_isolate(imp_registry *registry, const char *names,
                                         imp_error *error);

/* From now on, each scene that is made of text (imp_scene_from_json, imp_scene_from_file,
 * imp_scene_from_pair) may take at most that many seconds of the calling thread's processor time,
 * and hold that many bytes meanwhile; 0: no limit, which is where a registry begins. Beyond them
 * making it ends with IMP_ERROR_LIMIT. A file that a parameter names counts before it is opened,
 * and what create holds as far as it tells (imp_goes_on in <impinge/plugin.h>). No other thread
 * uses the registry meanwhile. IMP_ERROR_USAGE: the seconds are negative or no number. */
IMP_EXPORT imp_code imp_registry_limit_reading(imp_registry *registry, double seconds,
                                               uint64_t bytes, imp_error *error);

typedef enum imp_type_kind { IMP_TYPE_SURFACE, IMP_TYPE_MAP } imp_type_kind;

#define IMP_LINKED_IN "linked into the program"

/* One type found. Strings live as long as the registry. */
typedef struct imp_type_info {
    imp_type_kind kind;
    const char *name, *summary, *equation, *source, *example; /* source may be NULL */
    const char *file; /* absolute path of the plugin, or IMP_LINKED_IN */
    const char *plugin, *version, *license, *author;
    const char *shadowed_by;         /* file of the earlier type of that name, or NULL */
    const imp_parameter *parameters; /* step by parameter_size bytes */
    size_t parameter_count, parameter_size;
    const char
        *capabilities;   /* what this host uses of it, names with blanks between: "core", always;
                                 "order-2": the callback include (surfaces) or apply (maps);
                                 the callbacks "net", "pieces", "rigid", "span", "distance",
                                 "symmetry"; "formula": the text or callback; "parts": of a map;
                                 "renew"; "tube": of a surface */
    const char *formula; /* as in imp_surface_type: a text with the parameters' names; or NULL */
} imp_type_info;

/* Fills *info for type `index`, in the order found, shadowed types included. Returns false past the
 * last. */
IMP_EXPORT bool imp_registry_type(const imp_registry *registry, size_t index, imp_type_info *info);

/* A file that was not taken, or a directory that cannot be read, and why. The strings live as long
 * as the registry. Each of the three functions below returns false past the last. */
typedef struct imp_plugin_refusal {
    const char *file, *reason;
} imp_plugin_refusal;
IMP_EXPORT bool imp_registry_refusal(const imp_registry *registry, size_t index,
                                     imp_plugin_refusal *refusal);

/* Directories whose plugins were taken all the same, and why they should not be trusted. */
IMP_EXPORT bool imp_registry_warning(const imp_registry *registry, size_t index,
                                     imp_plugin_refusal *warning);

/* Isolated types whose destroy crashed or did not return, one entry for each type, in order of
 * time. No query is left then that could return an error. `reason` names the type. An entry for
 * which there is no memory is missing. [any thread] */
IMP_EXPORT bool imp_registry_fault(const imp_registry *registry, size_t index,
                                   imp_plugin_refusal *fault);

/* --- Scene: bodies, their surfaces and maps --------------------------------------------------- */

typedef struct imp_scene imp_scene;

/* Makes a scene from the text of a scene file, which the manual describes ({"time", "gamma",
 * "define", "bodies", "ignore"}). `name` stands for the text in error messages ("scene.json",
 * "standard input"); its part up to the last '/' is the folder where relative file names in
 * parameters begin. NULL on error. The caller frees the scene; the registry must outlive it. */
IMP_EXPORT imp_scene *imp_scene_from_json(imp_registry *registry, const char *text, size_t length,
                                          const char *name, imp_error *error);
IMP_EXPORT imp_scene *imp_scene_from_file(imp_registry *registry, const char *path,
                                          imp_error *error);
/* Makes a scene of two bodies, "a" and "b", from two pipelines: "TYPE name=value ... ! MAP
 * name=value ...". */
IMP_EXPORT imp_scene *imp_scene_from_pair(imp_registry *registry, const char *a, const char *b,
                                          imp_error *error);
/* Returns the text of a scene file that makes the scene of imp_scene_from_pair. Only the pipelines'
 * syntax is checked, not the values. File names are copied as they are. NULL on error. The caller
 * frees the text by free(). [any thread] */
IMP_EXPORT char *imp_pair_to_json(const imp_registry *registry, const char *a, const char *b,
                                  imp_error *error);

/* Frees a scene, whose queries are freed already. */
IMP_EXPORT void imp_scene_free(imp_scene *scene);

/* --- Builder: scenes built without text ------------------------------------------------------- */

/* A parameter's name and value. It never grows. Single values have rank 0 and stand in `single`
 * (numbers, and booleans as 0 or 1) or `text`; arrays, row-major, in `number` or `string`. A table
 * (names to numbers) has both, and its count in extent[0]. Nothing is kept beyond the call. */
typedef struct imp_argument {
    const char *name;
    imp_kind kind; /* IMP_KIND_NUMBER, ... */
    uint32_t rank; /* 0 to IMP_RANK_MAX */
    size_t extent[IMP_RANK_MAX];
    double single;
    const char *text;
    const double *number;
    const char *const *string;
} imp_argument;

static inline imp_argument imp_argument_of(const char *name, imp_kind kind, uint32_t rank)
{
    imp_argument a;
    a.name = name, a.kind = kind, a.rank = rank;
    a.extent[0] = a.extent[1] = a.extent[2] = 1;
    a.single = 0, a.text = NULL, a.number = NULL, a.string = NULL;
    return a;
}

static inline imp_argument imp_argument_number(const char *name, double value)
{
    imp_argument a = imp_argument_of(name, IMP_KIND_NUMBER, 0);
    a.single = value;
    return a;
}

static inline imp_argument imp_argument_boolean(const char *name, bool value)
{
    imp_argument a = imp_argument_of(name, IMP_KIND_BOOLEAN, 0);
    a.single = value ? 1 : 0;
    return a;
}

static inline imp_argument imp_argument_text(const char *name, const char *value)
{
    imp_argument a = imp_argument_of(name, IMP_KIND_STRING, 0);
    a.text = value;
    return a;
}

/* A vector or list of n numbers. */
static inline imp_argument imp_argument_list(const char *name, const double *value, size_t n)
{
    imp_argument a = imp_argument_of(name, IMP_KIND_NUMBER, 1);
    a.extent[0] = n, a.number = value;
    return a;
}

/* n rows of `width` numbers: control points, offsets. */
static inline imp_argument imp_argument_rows(const char *name, const double *value, size_t n,
                                             size_t width)
{
    imp_argument a = imp_argument_of(name, IMP_KIND_NUMBER, 2);
    a.extent[0] = n, a.extent[1] = width, a.number = value;
    return a;
}

/* A builder collects bodies and then makes a scene of them. Types and parameters are those of scene
 * files; relative file names begin at the working directory. Errors name the body and the
 * parameter, and a call that fails changes nothing. The registry must outlive builder and scene. A
 * builder belongs to one thread at a time. */
typedef struct imp_builder imp_builder;
IMP_EXPORT imp_builder *imp_builder_new(imp_registry *registry); /* NULL: no memory */
IMP_EXPORT void imp_builder_free(imp_builder *builder);

/* The keys "time", "gamma" and "gamma_clear" (< 0: gamma / 2) of a scene file. */
IMP_EXPORT imp_code imp_builder_time(imp_builder *builder, double start, double end,
                                     imp_error *error);
IMP_EXPORT imp_code imp_builder_gamma(imp_builder *builder, double gamma, double gamma_clear,
                                      imp_error *error);

/* Adds a parameter of the scene: a quantity beside time, from lo to hi, both finite. Surfaces and
 * maps that are added afterwards with imp_argument_text("clock", name) among their arguments follow
 * it: their t is its value. With an array of two numbers, lo and hi, in place of the name they have
 * a parameter of their own. Scenes with parameters are asked by imp_survey_new. */
IMP_EXPORT imp_code imp_builder_parameter(imp_builder *builder, const char *name, double lo,
                                          double hi, imp_error *error);

/* Adds a body, whose index, counted from 0, goes to *body (may be NULL). A name that is NULL
 * becomes "body0", "body1", .... */
IMP_EXPORT imp_code imp_builder_body(imp_builder *builder, const char *name, size_t *body,
                                     imp_error *error);

/* Makes a body solid, or not, which is what bodies are at first. */
IMP_EXPORT imp_code imp_builder_solid(imp_builder *builder, size_t body, bool solid,
                                      imp_error *error);

/* Adds a surface to a body; a map to a body, after those it has; a map to one surface of a body,
 * which is applied before those of the body. `arguments` has `count` entries, and nothing of it is
 * kept. */
IMP_EXPORT imp_code imp_builder_surface(imp_builder *builder, size_t body, const char *type,
                                        const imp_argument *arguments, size_t count,
                                        imp_error *error);
IMP_EXPORT imp_code imp_builder_map(imp_builder *builder, size_t body, const char *type,
                                    const imp_argument *arguments, size_t count, imp_error *error);
IMP_EXPORT imp_code imp_builder_surface_map(imp_builder *builder, size_t body, size_t surface,
                                            const char *type, const imp_argument *arguments,
                                            size_t count, imp_error *error);

/* Adds a surface to a body: that of a body of another scene, without its maps. Both scenes then
 * share what create made of its parameters and files, and what queries find out about all of its
 * pieces, such as a mesh's hierarchy of boxes: for many scenes of the same parts. `scene` may be
 * freed before the scene that is built; other threads may ask it meanwhile. IMP_ERROR_USAGE: there
 * is no such surface, or the builder's registry does not have its type. */
IMP_EXPORT imp_code imp_builder_surface_of(imp_builder *builder, size_t body,
                                           const imp_scene *scene, size_t its_body,
                                           size_t its_surface, imp_error *error);

/* Begins with all bodies of another scene: their names, groups, surfaces, maps and parents, whether
 * they are solid, and who ignores whom; neither its times nor its tolerances. Both scenes share
 * what imp_builder_surface_of shares, and maps. What is added comes after that; an added map is
 * another one than an equal map of the other scene. For many scenes that differ in a few maps.
 * IMP_ERROR_USAGE: the builder has bodies or parameters already, the scene has parameters, or it is
 * of another registry. */
IMP_EXPORT imp_code imp_builder_bodies_of(imp_builder *builder, const imp_scene *scene,
                                          imp_error *error);

/* The parent's maps come after the body's. Circles are refused by imp_builder_finish. */
IMP_EXPORT imp_code imp_builder_parent(imp_builder *builder, size_t body, size_t parent,
                                       imp_error *error);
IMP_EXPORT imp_code imp_builder_group(imp_builder *builder, size_t body, const char *group,
                                      imp_error *error);
/* Pairs of bodies of x and y are never tested. Both are names of bodies or groups; a group with
 * itself means its bodies among themselves. */
IMP_EXPORT imp_code imp_builder_ignore(imp_builder *builder, const char *x, const char *y,
                                       imp_error *error);

/* Makes the scene, which the caller frees. After that the builder may only be freed. NULL on
 * error. */
IMP_EXPORT imp_scene *imp_builder_finish(imp_builder *builder, imp_error *error);

/* --- Scene: numbers that change --------------------------------------------------------------- */

/* Gives a surface or a map of a body new arguments, for programs that ask about one scene again and
 * again, as simulations do. Its type stays, and so do all other surfaces and maps with what queries
 * found out about them. Afterwards the scene answers, bit for bit, like one that was built with
 * these arguments; stats.nodes and stats.bytes count less where trees stayed, and stats.bytes and
 * max_bytes count up to four small instances that changes have replaced, which the scene keeps for
 * later changes of their types, and in scenes of many bodies an index of their maps, which the
 * first change makes. The time of a call grows with the scene where a parent's map is changed, or
 * what several surfaces share; else with what it changes.
 *
 * With `map` SIZE_MAX it changes surface number `surface` of the body; with `surface` SIZE_MAX map
 * number `map` of the body, which moves its children, too; otherwise map number `map` of that
 * surface's own. All are counted from 0, in the order in which they were added. `arguments` are as
 * in imp_builder_surface, in the units that the type states: all of them, since those not given are
 * as if absent; relative names of files begin at the working directory, and nothing is kept. Maps
 * that were one in the text or builder because they were equal are changed one by one; maps that
 * become equal are one again, unless they read files.
 *
 * The scene must not be in use by other threads. IMP_ERROR_USAGE: it has queries or surveys, which
 * must be freed before; it has parameters, or was made by imp_scene_at; there is no such surface or
 * map. IMP_ERROR_SCENE, IMP_ERROR_PLUGIN: the arguments are refused, by the type's table or its
 * create. IMP_ERROR_MEMORY. On any error the scene is as it was. */
IMP_EXPORT imp_code imp_scene_set_values(imp_scene *scene, size_t body, size_t surface, size_t map,
                                         const imp_argument *arguments, size_t count,
                                         imp_error *error);

/* --- Scene: its parameters -------------------------------------------------------------------- */

/* A parameter of a scene, "parameters" of scene files. It never grows. */
typedef struct imp_scene_parameter_info {
    const char *name; /* lives as long as the scene */
    double lo, hi;    /* its range */
    bool is_followed; /* some surface or map has it as its clock */
} imp_scene_parameter_info;

/* Returns the number of parameters. A scene that has some stands at the middle of their ranges
 * where it is evaluated, and its motions are those at these values. */
IMP_EXPORT size_t imp_scene_parameter_count(const imp_scene *scene);

/* Fills *info for parameter `index`. False past the last, or if `info` is NULL. */
IMP_EXPORT bool imp_scene_parameter(const imp_scene *scene, size_t index,
                                    imp_scene_parameter_info *info);

/* Whether the body moves, or changes its shape, with parameter `index`: by its own surfaces and
 * maps, or by those of a parent. False if there is no such body or parameter. */
IMP_EXPORT bool imp_scene_follows(const imp_scene *scene, size_t body, size_t index);

/* Makes the scene at these values of its parameters, one for each, in their order: a scene without
 * parameters, which shares with the other what create made. IMP_ERROR_USAGE: a value is out of its
 * range. NULL on error. The caller frees the scene. [any thread] */
IMP_EXPORT imp_scene *imp_scene_at(const imp_scene *scene, const double *values, imp_error *error);

/* Makes the scene in which parameter `index` is in the place of time, over its range: its t is then
 * that parameter. The others stand at these values, and what follows time at time t. So an
 * animation sweeps a parameter. IMP_ERROR_USAGE: a value is out of its range, or something is not
 * defined at t. NULL on error. The caller frees the scene. [any thread] */
IMP_EXPORT imp_scene *imp_scene_sweep(const imp_scene *scene, size_t index, const double *values,
                                      double t, imp_error *error);

/* --- Scene: what it holds --------------------------------------------------------------------- */

/* Returns the number of bodies. */
IMP_EXPORT size_t imp_scene_body_count(const imp_scene *scene);
/* Whether two bodies are never tested with each other: one ignores the other, or has no
 * surfaces. */
IMP_EXPORT bool imp_scene_ignores(const imp_scene *scene, size_t a, size_t b);
/* Counts the pairs of bodies that do not ignore each other, without asking about each. */
IMP_EXPORT size_t imp_scene_pair_count(const imp_scene *scene);
/* Returns the name of a body, which lives as long as the scene. */
IMP_EXPORT const char *imp_scene_body_name(const imp_scene *scene, size_t body);
/* Returns the number of surfaces of a body. */
IMP_EXPORT size_t imp_scene_surface_count(const imp_scene *scene, size_t body);

/* What a type left out, or read otherwise than the author of a file may expect, when an instance
 * was made: statements of a mesh that are no faces, for instance. It was no error. */
typedef struct imp_remark {
    uint32_t struct_size;
    uint32_t reserved;
    size_t body, surface; /* where the instance stands first */
    size_t map;           /* which of its maps, from 0, its own first; SIZE_MAX: the surface */
    const char *type;     /* name of the type */
    uint64_t count;       /* how many things */
    const char *text;     /* which, in one sentence that begins with the parameter's name */
} imp_remark;

/* The remarks on a scene in the order of its surfaces, one for each instance; the texts live as
 * long as the scene. The caller sets remark->struct_size. False past the last, or if `remark` is
 * NULL or its size is not set. [any thread] */
IMP_EXPORT bool imp_scene_remark(const imp_scene *scene, size_t index, imp_remark *remark);

/* The number of pieces of a surface: of a mesh, its triangles; 1 for a surface that is not divided,
 * 0 if there is no such surface. Each piece has a domain of its own; imp_scene_eval, _include and
 * _domain are about the first piece, imp_piece_eval, _include and _domain about any. */
IMP_EXPORT size_t imp_scene_piece_count(const imp_scene *scene, size_t body, size_t surface);

/* Evaluates n points of one surface, maps applied: p holds n triples (u, v, t), x takes n triples
 * (x, y, z) in world space, and `error`, unless NULL, takes a bound of each coordinate's rounding
 * error; lengths. The arrays are the caller's, of 3 n numbers each. */
IMP_EXPORT imp_code imp_scene_eval(const imp_scene *scene, size_t body, size_t surface, size_t n,
                                   const double *p, double *x, double *error, imp_error *why);
/* Computes an order-2 inclusion of x, y and z of one surface, maps applied, over the region lo..hi
 * of (u, v, t), which is finite and lies in the domain: model[i] encloses coordinate i, as
 * <impinge/surface.h> says. What is not bounded there is infinite in the model. */
IMP_EXPORT imp_code imp_scene_include(const imp_scene *scene, size_t body, size_t surface,
                                      const double lo[3], const double hi[3], imp_model model[3],
                                      imp_error *why);
/* Tells the surface's domain of (u, v, t). Its times are those at which type and maps are all
 * defined; they may be infinite, and lo[2] > hi[2] if there are none. */
IMP_EXPORT void imp_scene_domain(const imp_scene *scene, size_t body, size_t surface, double lo[3],
                                 double hi[3]);

/* A surface of the scene, or one of its pieces. */
typedef struct imp_place {
    size_t body, surface, piece;
} imp_place;

/* Like imp_scene_eval, _include and _domain, for one piece. */
IMP_EXPORT imp_code imp_piece_eval(const imp_scene *scene, imp_place at, size_t n, const double *p,
                                   double *x, double *error, imp_error *why);
IMP_EXPORT imp_code imp_piece_include(const imp_scene *scene, imp_place at, const double lo[3],
                                      const double hi[3], imp_model model[3], imp_error *why);
IMP_EXPORT void imp_piece_domain(const imp_scene *scene, imp_place at, double lo[3], double hi[3]);

/* A motion x -> turn x + shift; turn[row][column] is a rotation, shift a length. It never grows. */
typedef struct imp_rigid_motion {
    bool is_known;
    double turn[3][3], shift[3];
} imp_rigid_motion;

/* Tells how a surface, or one of its pieces, moves as a whole from one time of its domain to
 * another. If motion->is_known, the point at (u, v, to) is turn x + shift, x being the point at (u,
 * v, from), for all u and v, to within 1e-9 radians and 1e-9 of the numbers that enter. Otherwise
 * the surface deforms, or is not known to be rigid, and `turn` is the identity. Pieces of one
 * surface have the same maps, so known motions of two pieces are equal. The motion is computed, not
 * enclosed: use it for pictures, not for proofs. [any thread] */
IMP_EXPORT imp_code imp_piece_motion(const imp_scene *scene, imp_place at, double from, double to,
                                     imp_rigid_motion *motion, imp_error *why);

/* --- Bodies that bound a volume --------------------------------------------------------------- */

/* Whether a body is solid ("solid" in scene files): whoever is inside when a query begins is in
 * contact there. */
IMP_EXPORT bool imp_scene_is_solid(const imp_scene *scene, size_t body);

/* Whether the surfaces of a body bound a volume, as far as their edges tell. */
typedef enum imp_closure_verdict {
    IMP_CLOSURE_CLOSED,
    IMP_CLOSURE_OPEN,      /* an edge borders on nothing */
    IMP_CLOSURE_ONE_SIDED, /* they have no inside and outside, as a Moebius strip */
    IMP_CLOSURE_UNBOUNDED, /* a domain is infinite, or points are farther than 1e50 away */
    IMP_CLOSURE_EMPTY,     /* there is no surface at that time, or all of it is one point */
    IMP_CLOSURE_STOPPED    /* `go_on` answered false */
} imp_closure_verdict;

typedef struct imp_closure {
    uint32_t struct_size; /* sizeof(imp_closure); grows at the end */
    imp_closure_verdict verdict;
    size_t shells;   /* CLOSED: sets of surfaces that hang together; else 0 */
    double where[3]; /* OPEN, ONE_SIDED: a point of the edge in question, */
    imp_place at;    /* which is of this surface */
} imp_closure;

/* Which shell a surface, or a piece of one, belongs to, and on which side of it the shell is: of
 * all patches of a shell sign * (du x dv) points inward, or of all of them outward. It never
 * grows. */
typedef struct imp_facing {
    size_t shell; /* SIZE_MAX: none, since it is a copy of another, or lies between two parts */
    int sign;     /* 1, or -1; 1 for the first patch of each shell; 0: of no shell */
} imp_facing;

/* Asked now and then by what may take long, with the program's own pointer: whether to go on. */
typedef bool (*imp_go_on)(void *context);

/* Finds out whether a body is closed at time t: whether each edge of its surfaces is a point or
 * runs along other edges of the body, within 1e-9 of its size or within `slack`, length. The caller
 * sets closure->struct_size. `facing` may be NULL, or has room for as many patches as the body's
 * surfaces have pieces (imp_scene_piece_count), and is filled in that order where the verdict is
 * CLOSED. `go_on`, which may be NULL, is asked now and then with `context`. Edges are compared at
 * points: it is no proof. [any thread] */
IMP_EXPORT imp_code imp_scene_get_closure(const imp_scene *scene, size_t body, double t,
                                          double slack, imp_facing *facing, imp_go_on go_on,
                                          void *context, imp_closure *closure, imp_error *error);

/* --- Query: the earliest contact -------------------------------------------------------------- */

typedef enum imp_verdict {
    IMP_VERDICT_CLEAR,
    IMP_VERDICT_CONTACT,
    IMP_VERDICT_UNDECIDED
} imp_verdict;

typedef enum imp_reason {
    IMP_REASON_NONE,       /* contact, or clear after a search */
    IMP_REASON_NO_TIME,    /* clear: the surfaces' time domains have no time in common */
    IMP_REASON_NO_PAIRS,   /* clear: nothing to test (one body, or all pairs ignored) */
    IMP_REASON_PAIRS,      /* undecided: max_pairs reached */
    IMP_REASON_SECONDS,    /* undecided: max_seconds reached */
    IMP_REASON_MEMORY,     /* undecided: max_bytes reached, or memory ran out */
    IMP_REASON_CANCELLED,  /* undecided: imp_query_cancel */
    IMP_REASON_RESOLUTION, /* undecided: gamma is below what double precision resolves here */
    IMP_REASON_RUNNING,    /* undecided: not finished yet */
    IMP_REASON_DECIDED /* imp_clearance only: `decide` was set and the verdict is known, or nothing
                              comes within `within` */
} imp_reason;

/* How far a query has come. It grows at the end: the library's struct may be longer than the
 * program's. */
typedef struct imp_progress {
    uint32_t struct_size;
    imp_reason reason;   /* RUNNING */
    double t_lower;      /* proved so far, as in imp_result; NAN where it is not asked for */
    uint64_t pairs;      /* tested so far */
    uint64_t heap;       /* pairs that wait */
    double seconds;      /* spent so far */
    double lower, upper; /* bracket of a least distance so far; NAN where it is not asked for */
    double gap;          /* least distance of two points evaluated so far; NAN: none */
} imp_progress;

/* Called by the thread that steps a query, about ten times a second. Answers whether to go on:
 * false ends the step as imp_query_cancel does. It must not step or free the query. */
typedef bool (*imp_progress_sink)(void *context, const imp_progress *progress);

/* Lends threads of the program to a query. The thread that steps or divides the query calls it; it
 * calls work(of, 0) to work(of, count - 1) once each, on any threads and in any order, and returns
 * when all of them have returned. Work may run code of plugins; it neither calls the program back
 * nor fails. */
typedef void (*imp_parallel)(void *context, void (*work)(void *of, size_t index), void *of,
                             size_t count);

/* --- Options: what a query is asked ----------------------------------------------------------- */

/* Start from imp_options_default(scene) and change what you need. */
typedef struct imp_options {
    uint32_t struct_size; /* sizeof(imp_options); grows at the end */
    bool audit;           /* hold every node's bounds against points of it: slower, catches liars */
    double t_start, t_end; /* t_start <= t_end, finite */
    double gamma;          /* > 0, length: what is reported is no farther apart */
    double gamma_clear;    /* in [0, gamma), length: nothing nearer is missed; < 0: gamma / 2 */
    uint64_t max_pairs;    /* pairs tested; 0: no limit */
    double max_seconds;    /* wall clock; 0: no limit */
    uint64_t max_bytes;    /* memory of scene, trees, heap and solids; 0: no limit */
    uint32_t baseline;     /* 0; else by the algorithm of 1990: <impinge/baseline.h> */
    uint32_t reserved;     /* 0 */
    imp_progress_sink progress; /* NULL: none */
    void *progress_context;     /* handed to it */
    imp_parallel parallel;      /* NULL: the thread that steps does all; parts never use it */
    void *parallel_context;     /* handed to it */
} imp_options;

/* Fills *options with what the scene asks for and, for the rest, the library's defaults. The caller
 * sets options->struct_size before; IMP_ERROR_USAGE if it is no valid size. A scene that names no
 * times is examined while all of its types and maps are defined: over the span that its tables and
 * keyframes share. Tables that hold at their ends, and surfaces that do not exist at other times,
 * extend the span; without any of these it is [0, 1]. IMP_ERROR_SCENE: they share no time. *options
 * is filled all the same, with NAN in t_start and t_end; queries return the error until both are
 * set. */
IMP_EXPORT imp_code imp_options_get_default(const imp_scene *scene, imp_options *options,
                                            imp_error *error);

static inline imp_options imp_options_default(const imp_scene *scene)
{
    imp_options options;
    memset(&options, 0, sizeof options); /* is left where scene is NULL; no query takes it */
    options.struct_size = (uint32_t)sizeof options;
    imp_options_get_default(scene, &options, NULL);
    return options;
}

/* --- Query: its answer ------------------------------------------------------------------------ */

/* One side of a witness. */
typedef struct imp_side {
    size_t body, surface; /* indices in the scene */
    size_t piece;         /* of a surface of pieces, which one; else 0 */
    double u, v;
    double point[3]; /* world space */
} imp_side;

typedef struct imp_stats {
    double seconds;     /* wall clock spent in imp_query_step */
    uint64_t pairs;     /* pairs of nodes tested for separation */
    uint64_t nodes;     /* nodes made by this query, not found made */
    uint64_t peak_heap; /* most pairs waiting at once */
    uint64_t witness_searches;
    uint64_t bytes; /* peak memory of scene, trees and heap, about; of a part without the scene */
} imp_stats;

/* How two bodies are in contact. */
typedef enum imp_contact_kind {
    IMP_CONTACT_TOUCH, /* two surfaces come together */
    IMP_CONTACT_INSIDE /* one body, or a part of it, is inside the other, which is solid, at the
                          first time asked: of the solid's side `point` is the other's point, u and
                          v are NAN, surface and piece 0 */
} imp_contact_kind;

/* What is proved so far, with the gamma_clear in force:
 *   (a) no points of two bodies are nearer than gamma_clear at any time in [t_start, t_lower);
 *       for every verdict, undecided included;
 *   (b) CONTACT: a.point and b.point lie on their surfaces at time t, evaluated, no farther than
 *       gamma apart, rounding included, and t == t_lower; or, of kind INSIDE, t is t_start, and the
 *       point of one body lies in the other, which is solid;
 *   (c) CLEAR: never nearer than gamma_clear in [t_start, t_end], and nobody inside a solid body at
 *       t_start, hence never; t_lower == t_end.
 * Surfaces of some types do not exist at all times, and touch nothing when they do not
 * (IMP_FLAG_ABSENT_OUTSIDE_TIMES). t_examined is the part of [t_start, t_end] from the first to the
 * last time at which two surfaces that are tested exist together: all of it where types set no
 * limit. */
typedef struct imp_result {
    uint32_t
        struct_size; /* sizeof(imp_result); grows at the end, but imp_side and imp_stats do not */
    imp_verdict verdict;
    imp_reason reason;
    double t; /* CONTACT only, else NAN */
    double t_lower;
    double gap; /* CONTACT: distance of the two points; else NAN */
    double gamma, gamma_clear;
    imp_side a, b; /* CONTACT only, bodies with RESOLUTION too; a.body < b.body */
    bool has_normal;
    double normal[3]; /* a to b, unit length, world space; only if has_normal */
    imp_stats stats;
    double t_start, t_end; /* what was asked about */
    double t_examined[2];  /* see above; NAN, NAN: no time */
    bool at_rest; /* CONTACT of two surfaces that do not move in [t_start, t_end]: they overlap */
    imp_contact_kind kind; /* CONTACT only */
} imp_result;

typedef struct imp_query imp_query;

/* Makes a query for the earliest contact; nothing is tested yet. The scene must outlive it. Queries
 * of a scene share its trees: those that one query made serve the next over the same times. NULL on
 * error (options, plugin, memory). IMP_ERROR_SCENE: the query needs times at which a type or map is
 * not defined. The caller frees it. */
IMP_EXPORT imp_query *imp_query_new(imp_scene *scene, const imp_options *options, imp_error *error);

/* Frees a query. */
IMP_EXPORT void imp_query_free(imp_query *query);

/* Tests about `pairs` more pairs (0: until decided). IMP_ERROR_PLUGIN ends the query for good.
 * After any success imp_query_result tells how far it came; done when its reason is not RUNNING. */
IMP_EXPORT imp_code imp_query_step(imp_query *query, uint64_t pairs, imp_error *error);

/* Fills *result. The caller sets result->struct_size before; IMP_ERROR_USAGE if it is no valid
 * size. */
IMP_EXPORT imp_code imp_query_get_result(const imp_query *query, imp_result *result,
                                         imp_error *error);

static inline imp_result imp_query_result(const imp_query *query)
{
    imp_result result;
    memset(&result, 0, sizeof result);
    result.struct_size = (uint32_t)sizeof result;
    result.verdict = IMP_VERDICT_UNDECIDED; /* is left where query is NULL */
    result.reason = IMP_REASON_CANCELLED;
    imp_query_get_result(query, &result, NULL);
    return result;
}

/* Two regions, one of each side's surface, that the search has not yet proved apart to the end.
 * They are proved to stay farther apart than gamma_clear before t_lower. A region is u[0]..u[1] and
 * v[0]..v[1] of one piece or, where `piece` is SIZE_MAX, several whole pieces. */
typedef struct imp_pending {
    double t_lower;
    struct imp_pending_side {
        size_t body, surface; /* indices in the scene */
        size_t piece;         /* SIZE_MAX: some pieces or all; u and v mean nothing then */
        double u[2], v[2];
    } a, b;
} imp_pending;

/* Fills *pending with a pair that waits to be searched, in no particular order. Returns false past
 * the last. What no pending pair covers is proved to be clear up to the query's end. While
 * stats.pairs is 0 nothing is known: a limit may have ended the query before its first pair. */
IMP_EXPORT bool imp_query_pending(const imp_query *query, size_t index, imp_pending *pending);

/* Has the query keep what a certificate needs: the proof of its answer, which impinge-verify checks
 * without the library (core/CERTIFICATE.md). Call it before the first step. The search then keeps a
 * sixteenth of what lies between gamma_clear and gamma, or between D (1 - 1e-6) and D, as room for
 * the verifier. Such a query is not divided, refined or passed. IMP_ERROR_USAGE: it was stepped
 * already, or asks for more than one clearance. */
IMP_EXPORT imp_code imp_query_keep_proof(imp_query *query, imp_error *error);

/* Takes bytes of a certificate, in order; called by the thread that writes it. */
typedef void (*imp_proof_sink)(void *context, const void *bytes, size_t size);

/* Returns the lines of imp_query_write_proof that name the plugin files of the types which the
 * scene uses, "type NAME HASH FILE", each with its end; HASH is the SHA-256 of the file's bytes,
 * and FILE its name without the folder. Types that are linked in have none. Lines "file HASH NAME"
 * then name the files that values of the scene name, such as meshes: NAME is the path, from the
 * folder of the scene's file on where that holds it, with '%' and two digits for '%' and for bytes
 * that are not shown; HASH is '-' of what is no regular file, or cannot be read any more. Files
 * that such files name are not listed. NULL on error: IMP_ERROR_FILE, a plugin's file cannot be
 * read any more. The caller frees the text by free(). */
IMP_EXPORT char *imp_scene_sources(const imp_scene *scene, imp_error *error);

/* Writes the certificate of a query that keeps a proof and has ended; of an undecided one up to
 * t_lower. A clearance may go on afterwards: the certificate has its bracket so far. `stated`
 * (NULL: nothing) are lines of text, each with its end, that name what was asked: "scene HASH",
 * then those of imp_scene_sources; the verifier compares, and trusts none. IMP_ERROR_USAGE: it
 * keeps no proof, has not ended, or was ended by a limit before anything was proved.
 * IMP_ERROR_PLUGIN: a type failed to tell its formula; then what was written is no certificate. */
IMP_EXPORT imp_code imp_query_write_proof(const imp_query *query, const char *stated,
                                          imp_proof_sink write, void *context, imp_error *error);

/* Makes the tolerances finer: gamma and gamma_clear (< 0: gamma / 2) may not be larger than now.
 * The work done so far is kept; continue with imp_query_step. Surfaces that turn within themselves
 * but for a little, at most 2^-12 of the first gamma_clear, are searched at one moment, with room
 * for what is left of their motion: where the new tolerances are not above that, the query may end
 * UNDECIDED for lack of RESOLUTION though a new query with these tolerances decides. */
IMP_EXPORT imp_code imp_query_refine(imp_query *query, double gamma, double gamma_clear,
                                     imp_error *error);

/* After a CONTACT, or UNDECIDED for lack of RESOLUTION, excludes that answer's pair of bodies from
 * the search. Step again for the next pair of bodies, which is later or at the same time. CLEAR
 * then holds for all pairs of bodies that are left. */
IMP_EXPORT imp_code imp_query_exclude_pair(imp_query *query, imp_error *error);

/* Divides a query that has not been stepped into *count parts, one for each pair of bodies that
 * come near each other, in the order of the scene; several threads may then answer them. The query
 * itself is clear: it is left with the pairs of bodies that no part has. If a limit is reached
 * first there are no parts, and the query's result says so. A query for a clearance
 * (imp_clearance_new, without `each`) has a part for each pair of bodies that ever exist together,
 * however far apart. */
IMP_EXPORT imp_code imp_query_divide(imp_query *query, size_t *count, imp_error *error);

/* Tells the two bodies of a part, the smaller index first. Returns false past the last. */
IMP_EXPORT bool imp_query_part_bodies(const imp_query *query, size_t index, size_t body[2]);

/* Makes the query of one part, to be stepped, read and freed like any other. It has trees of its
 * own, so that answers, and stats but for seconds, do not depend on the number of threads or the
 * order; different threads may make, step and free parts at once. What making it adds to the
 * scene's trees is counted in the stats of the divided query, which must outlive it. max_pairs and
 * max_bytes hold for each part, max_seconds for all together from imp_query_divide on. */
IMP_EXPORT imp_query *imp_query_part(const imp_query *query, size_t index, imp_error *error);

/* Ends the running step soon, as UNDECIDED; if none is running, the next one. [any thread,
 * async-signal-safe] */
IMP_EXPORT void imp_query_cancel(imp_query *query);

/* The earliest contact in one call: makes a query, steps it to its end, reads its result and frees
 * it. The caller sets result->struct_size before; *result stays as it is on error. */
IMP_EXPORT imp_code imp_scene_solve(imp_scene *scene, const imp_options *options,
                                    imp_result *result, imp_error *error);

/* --- Clearance: how near do bodies come? ------------------------------------------------------ */

/* A clearance is the minimum distance over an interval of time, given as a bracket: the distance is
 * proved not to be below `lower`, and two evaluated points are `upper` apart. If a distance is
 * required, the answer also tells whether it is kept. */
typedef struct imp_clearance_options {
    uint32_t struct_size; /* sizeof(imp_clearance_options); grows at the end */
    bool each;            /* an answer for each pair of bodies that do not ignore each other */
    double tolerance;     /* R, from 1e-9 to below 1: done when upper - lower <= R upper */
    double required;      /* D > 0, length; 0: nothing is required */
    uint64_t slices;      /* from 1 to 1000000: an answer for each of so many equal parts of time */
    bool decide;          /* also done as soon as it is known whether `required` is kept */
    double within; /* W >= D, length: bodies that never come nearer need not be measured; 0: all */
} imp_clearance_options;

/* Sets the defaults: a tolerance of 1e-3, nothing required, one answer, decide false, any distance.
 * The caller sets asked->struct_size before. */
IMP_EXPORT imp_code imp_clearance_options_get_default(imp_clearance_options *asked,
                                                      imp_error *error);

static inline imp_clearance_options imp_clearance_options_default(void)
{
    imp_clearance_options asked;
    asked.struct_size = (uint32_t)sizeof asked;
    imp_clearance_options_get_default(&asked, NULL);
    return asked;
}

/* Is the required distance D kept? A minimum distance between D (1 - 1e-6) and D may be answered
 * either way, as contact may be between gamma_clear and gamma. */
typedef enum imp_requirement {
    IMP_REQUIREMENT_NONE,     /* nothing is required */
    IMP_REQUIREMENT_HOLDS,    /* proved: never nearer than D (1 - 1e-6) */
    IMP_REQUIREMENT_VIOLATED, /* the witness's points are no farther apart than D */
    IMP_REQUIREMENT_UNDECIDED
} imp_requirement;

/* What is known so far:
 *   (a) no points of the bodies are nearer than `lower` at any time in [t_start, t_end];
 *   (b) has_witness: a.point and b.point lie on their surfaces at time t, evaluated, no farther
 *       than `upper` apart, rounding included;
 *   (c) reason NONE: upper - lower <= R upper, or upper <= gamma, which is contact;
 *       NO_PAIRS, NO_TIME: nothing comes near anything, lower and upper are infinite;
 *       RESOLUTION: double precision resolves no more;
 *       DECIDED: `decide` was set and the verdict is known, the bracket is as it was then; or
 *       nothing comes nearer than `within`, which `lower` then is: it is never more;
 *       RUNNING, or why the query was ended: the bracket as it is;
 *   (d) t_violated is not NaN: the points of a_violated and b_violated are no farther than D apart
 *       at that time, and before it no two are nearer than D (1 - 1e-6). */
typedef struct imp_clearance {
    uint32_t struct_size; /* sizeof(imp_clearance); grows at the end */
    imp_reason reason;
    imp_requirement verdict;
    bool has_witness, has_normal;
    double t_start, t_end; /* the slice, or the whole interval */
    size_t body[2];        /* indices in the scene; SIZE_MAX: all bodies */
    double lower, upper;   /* length */
    double t;              /* of the witness; NAN without */
    imp_side a, b;         /* of the witness; a.body < b.body */
    double normal[3];      /* a to b, unit length, world space; only if has_normal */
    double required;       /* D */
    double t_violated;     /* the earliest violation; NAN: none, not found, or there are slices */
    double gap_violated;   /* distance of the two points then */
    imp_side a_violated, b_violated;
    imp_stats
        stats; /* seconds, pairs, nodes and witness_searches: of this answer; the rest: so far */
    imp_contact_kind kind; /* of the witness. INSIDE: lower and upper are 0 from t_start on */
} imp_clearance;

/* Makes a query for a clearance, to be stepped, cancelled and freed like any other. `asked` may be
 * NULL, for the defaults. options->gamma is the distance that counts as contact, gamma_clear is not
 * used, and baseline must be 0. imp_query_get_result tells the stats and the reason, which is NONE
 * when all answers are there. */
IMP_EXPORT imp_query *imp_clearance_new(imp_scene *scene, const imp_options *options,
                                        const imp_clearance_options *asked, imp_error *error);

/* Returns the number of answers: the slices of the first pair of bodies, then of the next pair, and
 * so on. They are found in that order; an answer is complete once its reason is not RUNNING. With
 * `each` and `within`, only bodies that may come so near have answers, and their number is 0 until
 * the first step, or some more where limits end them, has found which; when divided, only these
 * have a part. */
IMP_EXPORT size_t imp_clearance_count(const imp_query *query);

/* Fills *answer. The caller sets answer->struct_size before. */
IMP_EXPORT imp_code imp_clearance_get(const imp_query *query, size_t index, imp_clearance *answer,
                                      imp_error *error);

/* --- Survey: all values of a scene's parameters ----------------------------------------------- */

/* A survey asks about all values of a scene's parameters at once: for the earliest contact over all
 * of them or, with clearance options, for the least distance. It divides the box of values, for
 * each pair of bodies by the parameters that move one relative to the other, and asks one ordinary
 * query in the middle of each box, with room for how far the box's values can move the bodies. So
 * it is proved, like any answer:
 *
 *   (a) at no values do points of two bodies come nearer than gamma_clear before t_lower;
 *   (b) CONTACT: at the values answered the witness is no farther apart than gamma, at
 *       t == t_lower;
 *   (c) CLEAR: at no values do they come nearer than gamma_clear;
 *   (d) a clearance: at no values nearer than `lower`; at the values answered the witness's points
 *       are no farther than `upper` apart.
 *
 * Answers do not depend on threads. A survey belongs to one thread at a time; imp_survey_cancel may
 * be called from anywhere. Scenes without parameters may be surveyed, too. */
typedef struct imp_survey imp_survey;

/* A part of the box of values, for two bodies, over a part of time. Pointers are valid during the
 * call. It grows at the end. */
typedef struct imp_survey_box {
    uint32_t struct_size;
    imp_verdict verdict;   /* CLEAR: proved not to come nearer than `lower`; CONTACT: it holds the
                             values of the contact; UNDECIDED: not known */
    size_t body[2];        /* SIZE_MAX: all pairs of bodies that no parameter moves */
    size_t count;          /* number of parameters */
    const double *lo, *hi; /* ranges of the parameters, in the scene's order */
    double t_start, t_end;
    double lower; /* length; CLEAR only */
} imp_survey_box;

/* Takes a box of a survey; called by the thread that steps it. */
typedef void (*imp_survey_sink)(void *context, const imp_survey_box *box);

/* What a survey is asked beside the options of its queries. */
typedef struct imp_survey_options {
    uint32_t struct_size; /* sizeof(imp_survey_options); grows at the end */
    bool any;             /* end with any contact; t_lower then tells what may be earlier */
    size_t body[2];       /* only these two bodies, which have surfaces; SIZE_MAX twice: all */
    uint64_t max_boxes;   /* boxes asked about; 0: no limit */
    imp_survey_sink sink; /* takes boxes as they are proved and, in the end, those left; NULL */
    void *sink_context;
    const char *resume; /* go on from what imp_survey_save returned; NULL: from the whole box. It is
                           read by imp_survey_new only */
    const double *lo, *hi; /* a part of the box of values: a range of each parameter, within that of
                              the scene; NULL: all. They are read by imp_survey_new only */
} imp_survey_options;

/* Sets the defaults. The caller sets how->struct_size before. */
IMP_EXPORT imp_code imp_survey_options_get_default(imp_survey_options *how, imp_error *error);

static inline imp_survey_options imp_survey_options_default(void)
{
    imp_survey_options how;
    how.struct_size = (uint32_t)sizeof how;
    imp_survey_options_get_default(&how, NULL);
    return how;
}

/* Makes a survey. Options are those of a query: max_pairs, max_seconds and max_bytes hold for the
 * whole; `baseline` must be 0. `asked` is NULL for the earliest contact; else a clearance, of one
 * slice, without `each` and `within`: a survey of two bodies, of a part of the values or over a
 * part of time is one of its own, by `how` and `options`, and several threads may step such
 * surveys of one scene at once. With `required` and `decide` it ends with any violation, which is
 * then the earliest at its values. `how` may be NULL. The scene must outlive it. NULL on
 * error; the caller frees it. */
IMP_EXPORT imp_survey *imp_survey_new(imp_scene *scene, const imp_options *options,
                                      const imp_clearance_options *asked,
                                      const imp_survey_options *how, imp_error *error);
IMP_EXPORT void imp_survey_free(imp_survey *survey);

/* Asks about so many boxes more (0: until decided), or until a limit comes. After any success the
 * functions below tell how far it came; it is done when the reason is not RUNNING. */
IMP_EXPORT imp_code imp_survey_step(imp_survey *survey, uint64_t boxes, imp_error *error);

/* Ends the running step soon, as UNDECIDED; if none is running, the next one. [any thread,
 * async-signal-safe] */
IMP_EXPORT void imp_survey_cancel(imp_survey *survey);

/* Makes the tolerances of a survey for a contact finer: gamma and gamma_clear (< 0: gamma / 2) may
 * not be larger than now. It goes on at t_lower, the time before which nothing is near at any
 * values; step it again. IMP_ERROR_USAGE: it is one of a clearance, or has ended with an error. */
IMP_EXPORT imp_code imp_survey_refine(imp_survey *survey, double gamma, double gamma_clear,
                                      imp_error *error);

/* Returns how far a survey has come, as one line of text, from which another goes on: of the same
 * scene and options but for limits and the sink, on any machine. Its answer is then that of a
 * survey that was not interrupted, bit for bit but for stats; boxes that the first one has told are
 * not told again, but for those left. A limit that ends a query in the middle of a box has that box
 * asked about again. Call it after imp_survey_step. The caller frees it by free(). NULL on
 * error. */
IMP_EXPORT char *imp_survey_save(const imp_survey *survey, imp_error *error);

/* Like imp_query_keep_proof and imp_query_write_proof, of a survey of all bodies without `resume`;
 * the certificate is about all values (core/CERTIFICATE.md). With `any`, a contact states its two
 * points alone; an undecided survey, what is proved of all values until t_lower. */
IMP_EXPORT imp_code imp_survey_keep_proof(imp_survey *survey, imp_error *error);
IMP_EXPORT imp_code imp_survey_write_proof(const imp_survey *survey, const char *stated,
                                           imp_proof_sink write, void *context, imp_error *error);

/* Fill *result, of a survey for a contact, or *answer, of one for a clearance. Indices are those of
 * the scene. The caller sets struct_size before. */
IMP_EXPORT imp_code imp_survey_get_result(const imp_survey *survey, imp_result *result,
                                          imp_error *error);
IMP_EXPORT imp_code imp_survey_get_clearance(const imp_survey *survey, imp_clearance *answer,
                                             imp_error *error);

/* Copies the values at which the witness stands, one for each parameter. False: there is none. An
 * undecided survey may have one: a contact at t_upper, before which another is not excluded. */
IMP_EXPORT bool imp_survey_values(const imp_survey *survey, double *values);

/* How far a survey has come. It grows at the end. */
typedef struct imp_survey_state {
    uint32_t struct_size;
    imp_reason reason;
    uint64_t boxes, waiting; /* asked about, those before `resume` included; left */
    double proved;           /* share of all values and times that is proved, from 0 to 1: the mean
                                over the pairs of bodies */
    double t_upper;          /* time of the contact that is known; INFINITY: none */
    size_t pairs_of_bodies;
    bool has_worst; /* a box is left: the one that would be asked about next */
    size_t worst_body[2];
    double worst_time[2];
} imp_survey_state;
IMP_EXPORT imp_code imp_survey_get_state(const imp_survey *survey, imp_survey_state *state,
                                         imp_error *error);

/* Copies the ranges of the worst box left, one of each parameter. False: none is left. */
IMP_EXPORT bool imp_survey_worst(const imp_survey *survey, double *lo, double *hi);

/* What the boxes of two bodies cost; those before `resume` are not counted. It grows at the end. */
typedef struct imp_survey_cost {
    uint32_t struct_size;
    size_t body[2]; /* SIZE_MAX: all pairs of bodies that no parameter moves */
    uint64_t boxes; /* asked about */
    uint64_t pairs; /* tested by their queries */
    double proved;  /* share of all values and times that is proved, from 0 to 1 */
} imp_survey_cost;

/* Fills *cost for pair of bodies `index`, below pairs_of_bodies. The caller sets struct_size. */
IMP_EXPORT imp_code imp_survey_get_cost(const imp_survey *survey, size_t index,
                                        imp_survey_cost *cost, imp_error *error);

/* Copies how often a box was halved along each parameter. */
IMP_EXPORT void imp_survey_cuts(const imp_survey *survey, uint64_t *cuts);

/* Returns the time left from t until the first contact, the paper's h(t) = t0 - t. It is negative
 * when the contact is past, and INFINITY when there is none in the interval; where the result is
 * undecided it is the time proved to be left. NAN if result is NULL. */
static inline double imp_time_left(const imp_result *result, double t)
{
    if (result == NULL) return NAN;
    if (result->verdict == IMP_VERDICT_CONTACT) return result->t - t;
    return result->verdict == IMP_VERDICT_CLEAR ? INFINITY : result->t_lower - t;
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_IMPINGE_H */
