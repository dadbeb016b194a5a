/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/shadow.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/common/array.h"
#include "tools/verify/round.h"

/* --- Enclosures ------------------------------------------------------------------------------- */

static size_t mixed(const place *of, const box3 *where)
{
    uint64_t bits[2 * VARIABLES], sum = (uintptr_t)of->chain + 31 * of->maps + 977 * of->piece;
    memcpy(bits, where, sizeof bits);
    for (int j = 0; j < 2 * VARIABLES; ++j)
        sum = (sum ^ bits[j] ^ bits[j] >> 29) * UINT64_C(0x9e3779b97f4a7c15);
    return sum >> 32 & (KEPT - 1);
}

const kept *kept_look(kept *memory, const place *of, const box3 *where)
{
    kept *k = &memory[mixed(of, where)];
    if (k->chain == of->chain && k->piece == of->piece && k->maps == of->maps &&
        memcmp(&k->where, where, sizeof *where) == 0)
        return k;
    k->chain = of->chain;
    k->piece = of->piece;
    k->maps = of->maps;
    k->where = *where;
    for (int j = 0; j < VARIABLES; ++j) k->c[j] = middle(where->lo[j], where->hi[j]);
    k->result = enclose(of, where, k->c, k->box, k->centre, &k->divide);
    return k;
}

/* --- Shadows ---------------------------------------------------------------------------------- */

static jet along(const jet x[3], const double n[3])
{
    jet sum = jet_scale(&x[0], ld_interval_of(n[0]));
    for (int i = 1; i < 3; ++i) {
        const jet term = jet_scale(&x[i], ld_interval_of(n[i]));
        sum = jet_add(&sum, &term);
    }
    return sum;
}

static void subtract_line(jet *x, const aim *a, ld_interval t)
{
    const ld_interval slope = ld_interval_of(a->slope);
    const ld_interval since = ld_interval_sub(t, ld_interval_of(a->mid));
    x->v = ld_interval_sub(x->v, ld_interval_mul(slope, since));
    x->d[T] = ld_interval_sub(x->d[T], slope);
    x->on |= 1 << T;
}

/* Estimates the dependence on each variable by derivatives. Their sum is at most the width of the
 * values; where derivatives have no bounds, that width is divided in proportion to the variables'
 * widths. */
static void find_sizes(const jet *over, const jet *at, const double half[VARIABLES], shadow *s)
{
    const double most = over->v.hi - over->v.lo;
    double sum = 0, width = 0;
    for (int j = 0; j < VARIABLES; ++j) {
        s->size[j] = fabs(ld_interval_mid(at->d[j])) * half[j];
        for (int k = 0; k < VARIABLES; ++k) {
            const ld_interval bend = j <= k ? over->h[j][k] : over->h[k][j];
            if (half[j] > 0 && half[k] > 0)
                s->size[j] += 0.5 * ld_interval_mag(bend) * half[j] * half[k];
        }
        sum += s->size[j];
        width += half[j];
    }
    for (int j = 0; j < VARIABLES && !(sum <= most); ++j)
        s->size[j] = most * (sum < INFINITY ? s->size[j] / sum : half[j] / width);
}

static shadow cast(const kept *k, const aim *a)
{
    jet over = a->about != NULL ? centre_distance(k->box, a) : along(k->box, a->n);
    jet at = a->about != NULL ? centre_distance(k->centre, a) : along(k->centre, a->n);
    ld_interval offset[BOX_DIMS];
    double half[VARIABLES];
    for (int j = 0; j < VARIABLES; ++j) {
        const ld_interval all = ld_interval_make(k->where.lo[j], k->where.hi[j]);
        offset[j] = ld_interval_sub(all, ld_interval_of(k->c[j]));
        half[j] = 0.5 * (all.hi - all.lo);
    }
    subtract_line(&over, a, ld_interval_make(k->where.lo[T], k->where.hi[T]));
    subtract_line(&at, a, ld_interval_of(k->c[T]));
    const ld_interval all = jet_values(&over, &at, offset);
    shadow s = {all.lo, all.hi, ld_interval_mid(at.v), {0, 0, 0}};
    find_sizes(&over, &at, half, &s);
    return s;
}

/* --- Areas ------------------------------------------------------------------------------------ */

const char *shadow_why_unknown(enclosed result)
{
    if (result == ENCLOSED_UNSAID) return "a formula leaves open what is there at these times";
    return result == ENCLOSED_UNDEFINED ? "a formula has no value at a point of it" : NULL;
}

static const char *add_halves(areas *all, const place *of, const box3 *where, const aim *a,
                              const split *by)
{
    box3 half[2] = {*where, *where};
    half[0].hi[by->along] = half[1].lo[by->along] = by->at;
    const char *why = areas_add(all, of, &half[0], a);
    return why != NULL ? why : areas_add(all, of, &half[1], a);
}

const char *areas_add(areas *all, const place *of, const box3 *where, const aim *a)
{
    const kept *k = kept_look(all->memory, of, where);
    const split by = k->divide;
    if (k->result == ENCLOSED_EMPTY) return NULL;
    if (k->result == ENCLOSED_SPLIT) return add_halves(all, of, where, a, &by);
    if (k->result != ENCLOSED) return shadow_why_unknown(k->result);
    area *grown = array_reserve(all->at, all->count, &all->room, sizeof *grown);
    if (grown == NULL) return "memory ran out";
    all->at = grown;
    all->cast += 1;
    grown[all->count++] = (area){*of, *where, cast(k, a)};
    return NULL;
}

const char *areas_divide(areas *all, size_t index, const aim *a, bool *divided)
{
    const area was = all->at[index];
    split by = {-1, 0};
    double most = 0, widest = 0;
    for (int j = 0; j < VARIABLES; ++j) {
        const double lo = was.where.lo[j], hi = was.where.hi[j], mid = middle(lo, hi);
        if (!(lo < mid && mid < hi)) continue;
        const double width = hi - lo, size = was.s.size[j];
        if (by.along >= 0 && !(size > most) && !(size == most && width > widest)) continue;
        by = (split){j, mid};
        most = size, widest = width;
    }
    *divided = by.along >= 0;
    if (!*divided) return NULL;
    all->at[index] = all->at[--all->count];
    return add_halves(all, &was.of, &was.where, a, &by);
}

reach areas_reach(const areas *all)
{
    reach r = {-INFINITY, -INFINITY, 0};
    for (size_t k = 0; k < all->count; ++k) {
        const shadow *s = &all->at[k].s;
        if (!(s->hi <= r.bound)) r.bound = s->hi, r.worst = k;
        if (s->value > r.value) r.value = s->value;
    }
    return r;
}
