/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef IMPINGE_EXAMINE_H
#define IMPINGE_EXAMINE_H

#include <impinge/impinge.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Examine: plugins, types and single instances
 * =====================================
 * `impinge check` and `impinge why` are made with these functions. A program that asks about
 * contacts needs none of this. */

/* --- Examine: plugin files -------------------------------------------------------------------- */

/* Checks a plugin file and reports each check with its verdict, in order. Checks that depend on one
 * that was refused are left out. The file is loaded in a child process only. Returns whether all
 * checks passed. */
typedef enum imp_finding {
    IMP_FINDING_NOT_REACHED,
    IMP_FINDING_PASSED,
    IMP_FINDING_REFUSED
} imp_finding;
typedef void (*imp_finding_sink)(void *context, const char *check, imp_finding finding,
                                 const char *text);
IMP_EXPORT bool imp_plugin_examine(const char *path, imp_finding_sink tell, void *context);

/* --- Examine: instances by themselves --------------------------------------------------------- */

/* One surface or map by itself, for programs that examine a type: its callbacks
 * (<impinge/surface.h>) and what create made. The program calls them itself, in the default
 * floating-point environment (FE_DFL_ENV), without the guards that scenes put around every call. */
typedef struct imp_instance {
    const imp_surface_type *surface; /* NULL: it is a map */
    const imp_map_type *map;         /* NULL: it is a surface */
    void *self;
} imp_instance;

/* Makes an instance from one stage of a pipeline, "TYPE name=value ...". The registry must outlive
 * it; imp_instance_free frees it. */
IMP_EXPORT imp_code imp_instance_from_text(imp_registry *registry, imp_type_kind kind,
                                           const char *text, imp_instance *instance,
                                           imp_error *error);
/* Returns a stage as the JSON object that a scene file would have for it: {"type": TYPE, "name":
 * value, ...}. Values are not compared with the type's parameters, and defaults are not added. NULL
 * on error. The caller frees the text by free(). */
IMP_EXPORT char *imp_stage_to_json(const imp_registry *registry, imp_type_kind kind,
                                   const char *text, imp_error *error);

/* Frees an instance; an empty one ({NULL, NULL, NULL}) may be freed, too. */
IMP_EXPORT void imp_instance_free(imp_instance *instance);

/* --- Why a search is slow --------------------------------------------------------------------- */

/* What kept a pair of regions from being parted, so that one of them was halved. */
typedef enum imp_obstacle {
    IMP_OBSTACLE_REMAINDER_A, /* the remainder of a's inclusion: without it the pair was parted */
    IMP_OBSTACLE_REMAINDER_B,
    IMP_OBSTACLE_TIME_A, /* likewise, and most of that remainder comes from time */
    IMP_OBSTACLE_TIME_B,
    IMP_OBSTACLE_BOUNDS_A, /* the type answered IMP_STATUS_UNBOUNDED */
    IMP_OBSTACLE_BOUNDS_B,
    IMP_OBSTACLE_DISTANCE,   /* the surfaces lie along each other, and neither type bounds the
                              distance of points from it */
    IMP_OBSTACLE_RESOLUTION, /* double precision tells no more */
    IMP_OBSTACLE_SIZE        /* the regions are too large for the gap between them */
} imp_obstacle;
enum { IMP_OBSTACLES = IMP_OBSTACLE_SIZE + 1 };

/* Where the work on two surfaces went. It never grows. Texts live as long as the scene. */
typedef struct imp_explanation {
    size_t body[2], surface[2]; /* indices in the scene; the first is a, the second b */
    const char *type[2];        /* names of the surfaces' types */
    const char
        *without_order_2[2];    /* the first type or map of each that has no inclusions (include,
                                       apply); NULL: all have */
    bool knows_distance[2];     /* whether distances from each are bounded, also under its maps */
    uint64_t tested;            /* pairs of their regions that were tested */
    uint64_t divided;           /* and those that nothing parted, */
    uint64_t by[IMP_OBSTACLES]; /* by the obstacle */
} imp_explanation;

/* Has a query for a contact, before its first step, count the obstacles; the search then takes up
 * to three times as long, and its answer is the same. Not with a baseline, and not of a clearance:
 * IMP_ERROR_USAGE. */
IMP_EXPORT imp_code imp_query_explain(imp_query *query, imp_error *error);

/* Fills *row with the surfaces at `index`, in the order of the scene; false past the last. Of a
 * query that was not asked to count, also of a clearance, `tested` is 0 and the obstacles are those
 * of up to 1000 pairs that wait to be searched: of a clearance those of the answer that a limit
 * ended, none once all answers are there. */
IMP_EXPORT bool imp_query_explanation(const imp_query *query, size_t index, imp_explanation *row);

/* --- Formulas --------------------------------------------------------------------------------- */

/* What a surface of a scene is composed of: stage 0 is its type, or the piece of it, and each later
 * one a map, in the order in which they apply, those of its parents last. It never grows. */
typedef struct imp_stage {
    imp_type_kind kind;
    const char *type;     /* name; lives as long as the scene */
    const void *identity; /* the same for stages that are the same instance; for comparison only */
} imp_stage;

/* Returns the number of stages; 0 if there is no such surface or piece. [any thread] */
IMP_EXPORT size_t imp_piece_stage_count(const imp_scene *scene, imp_place at);

/* Tells what stage it is. IMP_ERROR_USAGE: there is none. [any thread] */
IMP_EXPORT imp_code imp_piece_stage(const imp_scene *scene, imp_place at, size_t stage,
                                    imp_stage *info, imp_error *why);

/* Tells the formula of a stage, in the language of imp_surface_type.formula in <impinge/surface.h>,
 * with its numbers bound: each part begins with definitions of the parameters that it names, so
 * that it stands for itself. *text becomes NULL if the type has no formula for it; else the caller
 * frees it by free(). The language is not checked here. IMP_ERROR_USAGE: there is no such stage;
 * IMP_ERROR_PLUGIN: the type failed, or printed what is no text. [any thread] */
IMP_EXPORT imp_code imp_piece_formula(const imp_scene *scene, imp_place at, size_t stage,
                                      char **text, imp_error *why);

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_EXAMINE_H */
