/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_ISOLATE_H
#define CORE_ISOLATE_H

#include "surface.h"

/* An instance that lives in a process of its own
 * ==============================================
 * The plugin's create and all its callbacks run in a child; calls and answers go through shared
 * memory, points in batches. To the rest of core it is a type like any other. When the child
 * crashes, exits or does not answer in time, the call answers SURFACE_CRASHED or SURFACE_HUNG, and
 * so does every later one: an error of the query, not the end of the host. A call costs a few
 * microseconds. One thread at a time. */

typedef struct isolated isolated;

/* A stand-in for the type, which must outlive it; NULL: no memory. Use isolate_create next,
 * whatever it answers give the instance back by isolate_destroy, or by `destroy` of the types
 * below. */
isolated *isolate_surface(const imp_surface_type *type);
isolated *isolate_map(const imp_map_type *type);

/* Makes the child and runs create there. IMP_INTERNAL: no child could be made. */
imp_status isolate_create(isolated *i, const imp_value *values, imp_complaint *why);

/* The types whose `self` is `i`; they live as long as it does. */
const imp_surface_type *isolate_surface_type(const isolated *i);
const imp_map_type *isolate_map_type(const isolated *i);

void isolate_destroy(void *i);

#endif
