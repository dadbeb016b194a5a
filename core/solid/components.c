/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/components.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/base/union_find.h"
#include "core/solid/cell_hash.h"

/* --- Points ----------------------------------------------------------------------------------- */

/* Returns end k of a range, 0 or 1; where that is infinite, a finite number of the range. */
static double end_of(double lo, double hi, int k)
{
    const double inner = lo > -INFINITY ? lo : hi < INFINITY ? hi : 0;
    return k == 0 ? inner : hi < INFINITY ? hi : inner;
}

static imp_code sample(const patch *p, double t, patch_samples *s, imp_error *error)
{
    for (int k = 0; k < PATCH_SAMPLES; ++k)
        for (int i = 0; i < 2; ++i) {
            const double lo = end_of(p->lo[i], p->hi[i], 0), hi = end_of(p->lo[i], p->hi[i], 1);
            const bool high = i == 0 ? k == 1 || k == 2 : k == 2 || k == 3;
            s->uv[k][i] = k == PATCH_SAMPLES - 1 ? 0.5 * lo + 0.5 * hi : high ? hi : lo;
        }
    return patch_eval(p, t, PATCH_SAMPLES, (const double(*)[2])s->uv, s->x, s->off, error);
}

/* --- Sets ------------------------------------------------------------------------------------- */

/* A hash table, open addressing, of patches by the cell that a corner of theirs is in. */
typedef struct cells {
    double (*key)[3];
    size_t *patch; /* SIZE_MAX: the slot is free */
    size_t slots;  /* a power of 2, more than there are corners */
} cells;

/* Joins a patch to the one that was first in its corner's cell. */
static void enter(cells *c, union_find *sets, size_t index, const double key[3])
{
    size_t slot = cell_hash(key) & (c->slots - 1);
    while (c->patch[slot] != SIZE_MAX && memcmp(c->key[slot], key, sizeof c->key[slot]) != 0)
        slot = (slot + 1) & (c->slots - 1);
    if (c->patch[slot] == SIZE_MAX) {
        memcpy(c->key[slot], key, sizeof c->key[slot]);
        c->patch[slot] = index;
        return;
    }
    union_find_join(sets, c->patch[slot], index, 1);
}

/* Lemma. Points in one cell of the width near / 4 are at most sqrt(3) / 4 near < 0.44 near apart,
 * and a little for the rounding of quotients; the exact points are within near / 8 of each:
 * together less than near. Cells are counted from two origins, so that most points that are the
 * same but for rounding meet in one of them. */
static void join_corners(cells *c, const components *all, size_t count, double near,
                         union_find *sets)
{
    for (int shift = 0; shift < 2; ++shift) {
        memset(c->patch, 0xff, c->slots * sizeof *c->patch);
        for (size_t i = 0; i < count; ++i)
            for (int k = 0; k < 4; ++k) {
                const patch_samples *s = &all->samples[i];
                double key[3];
                if (!(s->off[k] <= near / 8)) continue;
                for (int j = 0; j < 3; ++j)
                    key[j] = floor(s->x[k].x[j] / (near / 4) + 0.5 * shift) + 0.0;
                enter(c, sets, i, key);
            }
    }
}

static void number_sets(components *c, size_t count, union_find *sets)
{
    c->count = 0;
    for (size_t i = 0; i < count; ++i) c->of[i] = SIZE_MAX;
    for (size_t i = 0; i < count; ++i) {
        const size_t root = union_find_root(sets, i, NULL);
        if (c->of[root] == SIZE_MAX) c->of[root] = c->count++;
        c->of[i] = c->of[root];
    }
}

static size_t slots_for(size_t count)
{
    size_t slots = 16;
    while (slots < 8 * count) slots *= 2;
    return slots;
}

static bool join_all(components *c, size_t count, double near)
{
    cells table = {.slots = slots_for(count)};
    union_find sets;
    const bool has_sets = union_find_make(&sets, count);
    table.key = malloc(table.slots * sizeof *table.key);
    table.patch = malloc(table.slots * sizeof *table.patch);
    const bool done = has_sets && table.key != NULL && table.patch != NULL;
    if (done && near > 0) join_corners(&table, c, count, near, &sets);
    if (done) number_sets(c, count, &sets);
    union_find_clear(&sets);
    free(table.key);
    free(table.patch);
    return done;
}

/* --- All -------------------------------------------------------------------------------------- */

size_t components_bytes(size_t count)
{
    const cells *table = NULL;
    const components *c = NULL;
    return count * (sizeof *c->samples + sizeof *c->of) + union_find_bytes(count) +
           slots_for(count) * (sizeof *table->key + sizeof *table->patch);
}

imp_code components_find(components *c, const patches *p, double near, imp_error *error)
{
    *c = (components){.samples = malloc((p->count + 1) * sizeof *c->samples),
                      .of = malloc((p->count + 1) * sizeof *c->of)};
    if (c->samples == NULL || c->of == NULL) return error_set_memory(error);
    for (size_t i = 0; i < p->count; ++i) {
        const imp_code code = sample(&p->patch[i], p->t, &c->samples[i], error);
        if (code != IMP_SUCCESS) return code;
    }
    return join_all(c, p->count, near) ? IMP_SUCCESS : error_set_memory(error);
}

void components_free(components *c)
{
    free(c->samples);
    free(c->of);
    *c = (components){0};
}
