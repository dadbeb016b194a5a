/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_OUTLINE_H
#define TOOLS_SIMULATE_OUTLINE_H

#include <stdbool.h>

#include "tools/simulate/limits.h"
#include "tools/simulate/rigid.h"

/* Where the patches of a body are
 * ===============================
 * Boxes that are proved to hold them at all times asked about, as the body's own maps leave them:
 * from inclusions over their whole domains. Infinite where a type gives no bound. */

typedef struct outline_patch {
    imp_place place;
    vec_box box;
} outline_patch;

/* Returns whether this is the patch of a place of its body. */
static inline bool outline_is_at(const outline_patch *p, imp_place place)
{
    return p->place.surface == place.surface && p->place.piece == place.piece;
}

typedef struct outline {
    outline_patch *patch;
    size_t count;
    vec_box box; /* of all */
    bool varies; /* a patch depends on time, as far as the rates of its inclusion tell */
} outline;

/* False: no memory. `still` and `options` are the scene and its times. Where a limit comes first,
 * the boxes that are missing are infinite, and the body counts as one that varies. */
bool outline_read(outline *o, const imp_scene *still, const imp_options *options, const limits *l,
                  size_t body);
void outline_free(outline *o);

/* No point of the body is farther than this from x; rounded up. */
double outline_reach(const outline *o, vec x);

#endif
