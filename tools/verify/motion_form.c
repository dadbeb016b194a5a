/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>

#include "tools/verify/form.h"

jet form_of(const jet n[3][4], const jet l[3][4], ld_interval e[3][3], int i, int k)
{
    jet sum = jet_constant(1, ld_interval_of(0));
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            if (ld_interval_is(e[a][b], 0)) continue;
            const jet both = jet_mul(&n[a][i], &l[b][k]);
            const jet term = jet_scale(&both, e[a][b]);
            sum = jet_add(&sum, &term);
        }
    return sum;
}

jet lift_of(const jet n[3][4], const double w[3], int k)
{
    jet sum = jet_constant(1, ld_interval_of(0));
    for (int a = 0; a < 3; ++a) {
        const jet term = jet_scale(&n[a][k], ld_interval_of(w[a]));
        sum = jet_add(&sum, &term);
    }
    return sum;
}

/* Computes the elements over some times. False: the maps may not be affine there. */
static bool take_form(const place *p, double lo, double hi, const double c[3], ld_interval e[3][3],
                      const double w[3], form_elements g)
{
    layered all;
    affine *n = &all.base;
    bool all_affine;
    split unused;
    const enclosed result = motion_take_chain(p, lo, hi, &all, &all_affine, &unused);
    const bool is_one = result == ENCLOSED && all_affine && all.count == 0;
    for (int i = 0; i < 3 && is_one; ++i) {
        const jet at = jet_constant(1, ld_interval_of(c[i]));
        n->wide[i][3] = jet_sub(&n->wide[i][3], &at);
        n->centre[i][3] = jet_sub(&n->centre[i][3], &at);
    }
    for (int i = 0; i < 4 && is_one; ++i)
        for (int k = i; k < 4; ++k) {
            const jet wide = form_of(n->wide, n->wide, e, i, k),
                      narrow = form_of(n->centre, n->centre, e, i, k);
            g[i][k] = g[k][i] = jet_values(&wide, &narrow, n->offset);
        }
    for (int k = 0; k < 4 && is_one; ++k) {
        const jet wide = lift_of(n->wide, w, k), narrow = lift_of(n->centre, w, k);
        g[4][k] = jet_values(&wide, &narrow, n->offset);
    }
    free(all.ways);
    return is_one;
}

static bool take_course(form_course *f, double lo, double hi, form_elements g)
{
    return take_form(f->p, lo, hi, f->c, f->e, f->w, g);
}

/* Bounds the changes, each part being enclosed in `finer` shorter ones. */
static bool find_changes(form_course *f, int finer, form_changes *to)
{
    const int count = CHANGE_PARTS * finer;
    form_elements now;
    double from = f->lo;
    *to = (form_changes){.are_known = true};
    for (int n = 0; n < count; ++n) {
        const double share = (n + 1.0) / count;
        const double end =
            n + 1 < count ? proof_smaller(f->lo + (f->hi - f->lo) * share, f->hi) : f->hi;
        if (!take_course(f, from, end, now)) return false;
        for (int i = 0; i < 5; ++i)
            for (int k = 0; k < 4; ++k) {
                double *most = i < 4 ? &to->most[n / finer][i][k] : &to->lift[n / finer][k];
                const ld_interval by = ld_interval_sub(now[i][k], f->before[i][k]);
                const double change = ld_interval_mag(by);
                if (!(change <= *most)) *most = change;
            }
        from = end;
    }
    return true;
}

/* Shorter parts, and the least change, by the greatest element, for which they are taken. */
enum { FINER = 4 };
#define CHANGE_LEAST 0x1p-12
#define CHANGE_SEEN 8

/* Whether a form seems to change much more than it does at both ends, as where a surface turns
 * about its own axis: what is enclosed then is of third order in the length of a part. */
static bool needs_finer(form_course *f, const form_changes *found)
{
    double most = 0, seen = 0, size = 0;
    form_elements end[2];
    for (int n = 0; n < CHANGE_PARTS; ++n)
        for (int i = 0; i < 9; ++i) most = proof_larger(most, found->most[n][i / 3][i % 3]);
    for (int i = 0; i < 9; ++i) size = proof_larger(size, ld_interval_mag(f->before[i / 3][i % 3]));
    if (!(most > CHANGE_LEAST * size)) return false;
    if (!take_course(f, f->lo, f->lo, end[0]) || !take_course(f, f->hi, f->hi, end[1]))
        return false;
    for (int i = 0; i < 18; ++i) {
        const ld_interval *at = &end[i / 9][i % 9 / 3][i % 3];
        const ld_interval by = ld_interval_sub(*at, f->before[i % 9 / 3][i % 3]);
        seen = proof_larger(seen, ld_interval_mag(by));
    }
    return most > CHANGE_SEEN * seen;
}

/* The smaller of two bounds of each element. */
static void take_smaller(const form_changes *x, form_changes *to)
{
    for (int n = 0; n < CHANGE_PARTS; ++n)
        for (int i = 0; i < 5; ++i)
            for (int k = 0; k < 4; ++k) {
                const double other = i < 4 ? x->most[n][i][k] : x->lift[n][k];
                double *most = i < 4 ? &to->most[n][i][k] : &to->lift[n][k];
                if (!(*most <= other)) *most = other;
            }
}

/* Whether all changes are rounding, by the size of the form. */
#define CHANGE_TINY 0x1p-36
static bool are_tiny(const form_course *f, const form_changes *found)
{
    double most = 0, size = 0;
    for (int n = 0; n < CHANGE_PARTS; ++n)
        for (int i = 0; i < 16; ++i) most = proof_larger(most, found->most[n][i / 4][i % 4]);
    for (int i = 0; i < 9; ++i) size = proof_larger(size, ld_interval_mag(f->before[i / 3][i % 3]));
    return most <= CHANGE_TINY * size;
}

void motion_form_changes(const place *p, double lo, double hi, const double c[3],
                         ld_interval e[3][3], const double w[3], form_changes *to)
{
    form_course f = {.p = p, .lo = lo, .hi = hi, .c = c, .w = w, .e = e};
    form_changes turned;
    const double at = middle(lo, hi);
    *to = (form_changes){.are_known = p->maps == 0};
    if (p->maps == 0 || !take_course(&f, at, at, f.before)) return;
    const bool turns = form_turned_changes(&f, &turned);
    if (turns && are_tiny(&f, &turned)) {
        *to = turned;
        return;
    }
    to->are_known = find_changes(&f, 1, to);
    if (to->are_known && needs_finer(&f, to)) to->are_known = find_changes(&f, FINER, to);
    if (turns && to->are_known) take_smaller(&turned, to);
    if (turns && !to->are_known) *to = turned;
}

/* Lemma. x^T E x = h^T N^T E N h for h = (p, 1), which changes by no more than the sum of the
 * changes of the elements of N^T E N, times |h| |h|. Each time is in one of the parts. */
double form_change_upper(const form_changes *s, const double size[3])
{
    const double h[4] = {size[0], size[1], size[2], 1};
    double most = 0;
    if (!s->are_known) return INFINITY;
    for (int n = 0; n < CHANGE_PARTS; ++n) {
        ld_interval sum = ld_interval_of(0);
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k) {
                const ld_interval by = ld_interval_mul(ld_interval_of(h[i]), ld_interval_of(h[k]));
                sum = ld_interval_add(sum, ld_interval_mul(ld_interval_of(s->most[n][i][k]), by));
            }
        if (!(sum.hi <= most)) most = sum.hi;
    }
    return most;
}

double form_lift_upper(const form_changes *s, const double size[3])
{
    double most = 0;
    if (!s->are_known) return INFINITY;
    for (int n = 0; n < CHANGE_PARTS; ++n) {
        ld_interval sum = ld_interval_of(s->lift[n][3]);
        for (int k = 0; k < 3; ++k) {
            const ld_interval by = ld_interval_of(s->lift[n][k]);
            sum = ld_interval_add(sum, ld_interval_mul(by, ld_interval_of(size[k])));
        }
        if (!(sum.hi <= most)) most = sum.hi;
    }
    return most;
}
