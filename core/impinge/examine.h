/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef IMPINGE_EXAMINE_H
#define IMPINGE_EXAMINE_H

#include <impinge/impinge.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Examining plugins, types and single instances
 * =============================================
 * `impinge check` and `impinge why` are made with these functions. A program that asks about
 * contacts needs none of this. */

/* --- Plugin files ----------------------------------------------------------------------------- */

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

/* --- Instances -------------------------------------------------------------------------------- */

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

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_EXAMINE_H */
