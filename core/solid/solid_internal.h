/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_SOLID_INTERNAL_H
#define CORE_SOLID_SOLID_INTERNAL_H

#include "core/base/rounding.h"
#include "core/solid/shell_winding.h"
#include "core/solid/solid.h"

/* What the files of a solid share: solid.c tells on which side points are, nesting.c which shells
 * are walls of cavities. */

typedef struct solid_box {
    double lo[3], hi[3];
} solid_box;

struct solid {
    const imp_scene *scene;
    size_t body;
    const limit_watch *watch;
    patches patches;
    double slack;
    bool is_read; /* the following are known */
    imp_closure closure;
    shells shells;
    solid_box *boxes; /* of each patch, then of each shell */
};

/* Finds the winding number of a shell around x (shell_winding.h). */
imp_code solid_wind(const solid *s, size_t shell, vec3 x, double off, winding_number *found,
                    imp_error *error);

/* Sets depth[k] to the number of shells of the list that shell k is wholly inside of, counted along
 * the longest chain of shells inside each other; `depth` has room for `count` numbers. *known:
 * false if two of them could not be told inside or apart. */
imp_code solid_depths(const solid *s, const size_t *shell, size_t count, size_t *depth, bool *known,
                      bool *stopped, imp_error *error);

/* Sets *box to the ranges of the three models; infinite where they are NaN. */
void solid_box_around(const imp_model model[3], solid_box *box);

/* Returns a box without points. */
static inline solid_box solid_box_none(void)
{
    return (solid_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

/* Enlarges a box to contain another. */
void solid_box_add(solid_box *to, const solid_box *box);

static inline bool solid_boxes_apart(const solid_box *a, const solid_box *b)
{
    for (int i = 0; i < 3; ++i)
        if (a->lo[i] > b->hi[i] || b->lo[i] > a->hi[i]) return true;
    return false;
}

/* Returns whether all points within `off` of x are outside of the box. */
static inline bool solid_box_excludes(const solid_box *box, vec3 x, double off)
{
    for (int i = 0; i < 3; ++i)
        if (sum_upper(x.x[i], off) < box->lo[i] || difference_lower(x.x[i], off) > box->hi[i])
            return true;
    return false;
}

static inline const solid_box *solid_shell_box(const solid *s, size_t shell)
{
    return &s->boxes[s->patches.count + shell];
}

#endif
