/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/motion.h"

#include <math.h>
#include <stdlib.h>

#include "tools/verify/net_internal.h"

/* --- Affine maps ------------------------------------------------------------------------------ */

/* Lemma. A second derivative by two of x, y and z that is exactly 0 for all x, y and z (the whole
 * line), for all of which the map is defined, makes the map affine in them. */
static bool is_affine(const part *p, jet room[])
{
    jet variables[4] = {[3] = jet_constant(3, ld_interval_make(p->lo[T], p->hi[T]))}, out[3];
    bool affine = true;
    for (int k = 0; k < 3; ++k) variables[k] = jet_variable(3, k, ld_interval_entire());
    formula_jets_in(p->f, variables, room, out);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            for (int l = k; l < 3; ++l) affine = affine && ld_interval_is(out[i].h[k][l], 0);
    return affine && !out[0].is_undefined && !out[1].is_undefined && !out[2].is_undefined;
}

/* Notes what a shape is. A part without an end in time is looked at while the claim lasts. */
static void prepare_shape(const scene_clock *t, part *p)
{
    const double lo[3] = {p->lo[U], p->lo[V], p->lo[T] > t->lo ? p->lo[T] : t->lo};
    const double hi[3] = {p->hi[U], p->hi[V], p->hi[T] < t->hi ? p->hi[T] : t->hi};
    p->is_moving = formula_depends(p->f, T);
    if (lo[T] <= hi[T]) p->net = net_of_formula(p->f, lo, hi);
}

void motion_prepare(statement *s)
{
    jet *room = malloc(((size_t)s->steps + 1) * sizeof *room);
    for (size_t k = 0; k < s->stage_count; ++k)
        for (size_t i = 0; i < s->stages[k].count; ++i)
            for (size_t j = 0; j < s->stages[k].pieces[i].count; ++j) {
                part *p = &s->stages[k].pieces[i].parts[j];
                if (!s->stages[k].is_map) prepare_shape(&s->clocks[s->stages[k].clock], p);
                p->is_affine = s->stages[k].is_map && room != NULL && is_affine(p, room);
            }
    free(room);
}

/* M and d as jets of t over some times, and at their middle. */
typedef struct affine {
    jet wide[3][4], centre[3][4];
    ld_interval offset[BOX_DIMS];
} affine;

/* Computes where an affine map takes 0, and where it takes the unit vectors, minus that. Steps that
 * depend on time alone are computed once. */
static void take_affine(const part *p, double lo, double hi, jet room[], affine *a)
{
    jet wide[4], centre[4], out[3], out_centre[3];
    const ld_interval t = ld_interval_make(lo, hi), at = ld_interval_of(middle(lo, hi));
    *a = (affine){.offset = {ld_interval_sub(t, at)}};
    wide[3] = jet_variable(1, 0, t), centre[3] = jet_variable(1, 0, at);
    centre[3].bends = 0;
    for (int c = 3; c >= 0; --c) {
        for (int i = 0; i < 3; ++i) wide[i] = centre[i] = jet_constant(1, ld_interval_of(i == c));
        const formula_boxes given = {wide, centre, a->offset, c == 3, 7};
        formula_jets_about(p->f, &given, room, out, out_centre);
        for (int i = 0; i < 3; ++i) {
            a->wide[i][c] = c < 3 ? jet_sub(&out[i], &a->wide[i][3]) : out[i];
            a->centre[i][c] = c < 3 ? jet_sub(&out_centre[i], &a->centre[i][3]) : out_centre[i];
        }
    }
}

static jet sum_of_products(const jet l[4], const jet r[3][4], int c, bool shifts)
{
    jet sum = jet_mul(&l[0], &r[0][c]);
    for (int k = 1; k < 3; ++k) {
        const jet term = jet_mul(&l[k], &r[k][c]);
        sum = jet_add(&sum, &term);
    }
    return c == 3 && shifts ? jet_add(&sum, &l[3]) : sum;
}

/* Applies `then` after `first`; without its shift, if `first` is a way. */
static void compose(const affine *then, affine *first, bool shifts)
{
    const affine was = *first;
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            first->wide[i][c] = sum_of_products(then->wide[i], was.wide, c, shifts);
            first->centre[i][c] = sum_of_products(then->centre[i], was.centre, c, shifts);
            jet_narrow(&first->wide[i][c], &first->centre[i][c], first->offset);
        }
}

/* --- Other clocks ----------------------------------------------------------------------------- */

/* What an affine map is at all values of its clock: middle + s slope, |s| <= 1, but for `rest`. */
typedef struct line_map {
    affine middle, slope; /* constants */
    double rest[3][4];
} line_map;

static void take_line(const part *p, double lo, double hi, const affine *all, jet room[],
                      line_map *to)
{
    affine a;
    take_affine(p, lo, hi, room, &a);
    to->middle = to->slope = *all; /* for the offset */
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            double line[2];
            motion_line_of_jets(&a.wide[i][c], &a.centre[i][c], lo, hi, line, &to->rest[i][c]);
            to->middle.wide[i][c] = to->middle.centre[i][c] =
                jet_constant(1, ld_interval_of(line[0]));
            to->slope.wide[i][c] = to->slope.centre[i][c] =
                jet_constant(1, ld_interval_of(line[1]));
        }
}

/* The affine map of a chain: base + the sum of s_k ways[k].of, |s_k| <= 1, but for `rest`, at each
 * time. Each s_k belongs to one clock. */
typedef struct layered {
    affine base;
    struct {
        size_t clock;
        affine of;
    } * ways; /* to be freed */
    size_t count;
    double rest[3][4];
} layered;

static double size_of(const affine *x, int i, int c) { return ld_interval_mag(x->wide[i][c].v); }

/* Lemma. For `then` = M + s L but for e, |s| <= 1, and x = base + ways but for rest, then(x) is
 * M base + (M ways + s L base) but for |M| rest + |L| (|ways| + rest) + e (|base| + |ways| + rest),
 * and for e alone of the shift. */
static void grow_rest(const affine *m, const line_map *line, layered *x)
{
    double was[3][4], moved[3][4];
    for (int l = 0; l < 3; ++l)
        for (int c = 0; c < 4; ++c) {
            was[l][c] = moved[l][c] = x->rest[l][c];
            for (size_t k = 0; k < x->count; ++k) moved[l][c] += size_of(&x->ways[k].of, l, c);
        }
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            double sum = line != NULL && c == 3 ? line->rest[i][3] : 0;
            for (int l = 0; l < 3; ++l) {
                sum += size_of(m, i, l) * was[l][c];
                if (line == NULL) continue;
                sum += size_of(&line->slope, i, l) * moved[l][c];
                sum += line->rest[i][l] * (size_of(&x->base, l, c) + moved[l][c]);
            }
            x->rest[i][c] = sum > 0 || isnan(sum) ? net_padded(sum) : 0;
            if (isnan(sum)) x->rest[i][c] = INFINITY;
        }
}

static void add_slope(const affine *slope, const affine *base, affine *way)
{
    affine more = *base;
    compose(slope, &more, true);
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            way->wide[i][c] = jet_add(&way->wide[i][c], &more.wide[i][c]);
            way->centre[i][c] = jet_add(&way->centre[i][c], &more.centre[i][c]);
        }
}

static void set_constant(affine *x, bool is_one)
{
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c)
            x->wide[i][c] = x->centre[i][c] = jet_constant(1, ld_interval_of(is_one && i == c));
}

/* Applies a map that follows T, or (line not NULL) another clock. */
static void apply(const affine *m, const line_map *line, size_t clock, layered *x)
{
    if (line != NULL || x->count > 0) grow_rest(m, line, x);
    for (size_t k = 0; k < x->count; ++k) compose(m, &x->ways[k].of, false);
    if (line != NULL) {
        size_t k = 0;
        while (k < x->count && x->ways[k].clock != clock) ++k;
        if (k == x->count) {
            x->ways[x->count++].clock = clock;
            x->ways[k].of = x->base;
            set_constant(&x->ways[k].of, false);
        }
        add_slope(&line->slope, &x->base, &x->ways[k].of);
    }
    compose(m, &x->base, true);
}

static void apply_stage(const place *p, size_t k, const part *found, double lo, double hi,
                        layered *x)
{
    const size_t clock = p->of->stages[p->chain->stages[k]].clock;
    affine next;
    line_map line;
    if (place_follows_main(p, k)) {
        take_affine(found, lo, hi, p->room, k == 1 ? &x->base : &next);
        if (k > 1) apply(&next, NULL, 0, x);
        return;
    }
    if (k == 1) {
        const double at = middle(lo, hi);
        x->base.offset[0] = ld_interval_sub(ld_interval_make(lo, hi), ld_interval_of(at));
        set_constant(&x->base, true);
    }
    take_line(found, p->when->lo[clock], p->when->hi[clock], &x->base, p->room, &line);
    apply(&line.middle, &line, clock, x);
}

/* The affine map of a whole chain, whose ways the caller frees. */
static enclosed take_chain(const place *p, double lo, double hi, layered *all, bool *all_affine,
                           split *divide)
{
    const box3 times = {{-INFINITY, -INFINITY, lo}, {INFINITY, INFINITY, hi}};
    size_t others = 0;
    for (size_t k = 1; k <= p->maps; ++k) others += !place_follows_main(p, k);
    *all = (layered){.ways = others > 0 ? malloc(others * sizeof *all->ways) : NULL};
    *all_affine = p->maps > 0 && (others == 0 || all->ways != NULL);
    for (size_t k = 1; k <= p->maps; ++k) {
        const part *found;
        const piece *map = enclose_piece(p, k);
        const box3 own = place_box(p, k, &times);
        const enclosed result = enclose_choose(p, k, &times, &found, divide);
        if (result != ENCLOSED) return result == ENCLOSED_EMPTY ? ENCLOSED_UNSAID : result;
        *all_affine =
            *all_affine && found->is_affine && enclose_next_part(map, found, &own) == NULL;
        if (*all_affine) apply_stage(p, k, found, lo, hi, all);
    }
    return ENCLOSED;
}

/* Writes the numbers of base and ways; false: they are not finite, or there is no memory. */
static bool take_numbers(const layered *all, double lo, double hi, motion *m)
{
    double error, size;
    bool known = true;
    if (all->count > 0) m->ways = malloc(all->count * sizeof *m->ways);
    if (all->count > 0 && m->ways == NULL) return false;
    m->way_count = all->count;
    for (size_t k = 0; k < all->count; ++k) m->ways[k].clock = all->ways[k].clock;
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            known = known && motion_of_jets(&all->base.wide[i][c], &all->base.centre[i][c], lo, hi,
                                            m->m[i][c], &m->error[i][c], &m->size[i][c]);
            if (all->count == 0) continue;
            for (size_t k = 0; k < all->count && known; ++k) {
                const affine *way = &all->ways[k].of;
                known = motion_of_jets(&way->wide[i][c], &way->centre[i][c], lo, hi,
                                       m->ways[k].m[i][c], &error, &size);
                m->error[i][c] += error;
                m->size[i][c] += size;
            }
            m->blur[i][c] = all->rest[i][c];
            m->error[i][c] = net_padded(m->error[i][c] + all->rest[i][c]);
            m->size[i][c] = net_padded(m->size[i][c] + all->rest[i][c]);
            known = known && m->size[i][c] < INFINITY;
        }
    return known;
}

enclosed motion_bound(const place *p, double lo, double hi, motion *m, bool *all_affine,
                      split *divide)
{
    layered all;
    const enclosed result = take_chain(p, lo, hi, &all, all_affine, divide);
    if (*all_affine && result == ENCLOSED) *all_affine = take_numbers(&all, lo, hi, m);
    free(all.ways);
    return result;
}

/* Returns the element i, k of N^T E N, N being M and d - c. */
static jet form_of(const jet n[3][4], ld_interval e[3][3], int i, int k)
{
    jet sum = jet_constant(1, ld_interval_of(0));
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            if (ld_interval_is(e[a][b], 0)) continue;
            const jet both = jet_mul(&n[a][i], &n[b][k]);
            const jet term = jet_scale(&both, e[a][b]);
            sum = jet_add(&sum, &term);
        }
    return sum;
}

/* Returns the element k of w^T N. */
static jet lift_of(const jet n[3][4], const double w[3], int k)
{
    jet sum = jet_constant(1, ld_interval_of(0));
    for (int a = 0; a < 3; ++a) {
        const jet term = jet_scale(&n[a][k], ld_interval_of(w[a]));
        sum = jet_add(&sum, &term);
    }
    return sum;
}

/* Row 4 holds w^T N; the others N^T E N, which is symmetric like E. */
typedef ld_interval form_elements[5][4];

/* Computes the elements over some times. False: the maps may not be affine there. */
static bool take_form(const place *p, double lo, double hi, const double c[3], ld_interval e[3][3],
                      const double w[3], form_elements g)
{
    layered all;
    affine *n = &all.base;
    bool all_affine;
    split unused;
    const enclosed result = take_chain(p, lo, hi, &all, &all_affine, &unused);
    const bool is_one = result == ENCLOSED && all_affine && all.count == 0;
    for (int i = 0; i < 3 && is_one; ++i) {
        const jet at = jet_constant(1, ld_interval_of(c[i]));
        n->wide[i][3] = jet_sub(&n->wide[i][3], &at);
        n->centre[i][3] = jet_sub(&n->centre[i][3], &at);
    }
    for (int i = 0; i < 4 && is_one; ++i)
        for (int k = i; k < 4; ++k) {
            const jet wide = form_of(n->wide, e, i, k), narrow = form_of(n->centre, e, i, k);
            g[i][k] = g[k][i] = jet_values(&wide, &narrow, n->offset);
        }
    for (int k = 0; k < 4 && is_one; ++k) {
        const jet wide = lift_of(n->wide, w, k), narrow = lift_of(n->centre, w, k);
        g[4][k] = jet_values(&wide, &narrow, n->offset);
    }
    free(all.ways);
    return is_one;
}

/* The elements of a form over some times, as motion_form_changes takes them. */
typedef struct form_course {
    const place *p;
    double lo, hi;
    const double *c, *w;
    ld_interval (*e)[3];
    form_elements before; /* at the middle */
} form_course;

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

void motion_form_changes(const place *p, double lo, double hi, const double c[3],
                         ld_interval e[3][3], const double w[3], form_changes *to)
{
    form_course f = {.p = p, .lo = lo, .hi = hi, .c = c, .w = w, .e = e};
    const double at = middle(lo, hi);
    *to = (form_changes){.are_known = p->maps == 0};
    if (p->maps == 0 || !take_course(&f, at, at, f.before)) return;
    to->are_known = find_changes(&f, 1, to);
    if (to->are_known && needs_finer(&f, to)) to->are_known = find_changes(&f, FINER, to);
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

/* --- Rigid maps ------------------------------------------------------------------------------- */

/* Returns the element i, k of J^T J - 1. */
static jet gram(const jet j[3][4], int i, int k)
{
    jet sum = jet_constant(1, ld_interval_of(i == k ? -1 : 0));
    for (int l = 0; l < 3; ++l) {
        const jet both = jet_mul(&j[l][i], &j[l][k]);
        sum = jet_add(&sum, &both);
    }
    return sum;
}

/* Lemma. The largest sum of a row bounds the norm of a symmetric matrix. */
static double deviation(const part *p, double lo, double hi, jet room[])
{
    affine a;
    if (!p->is_affine) return INFINITY;
    take_affine(p, lo, hi, room, &a);
    double most = 0;
    ld_interval size[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = i; k < 3; ++k) {
            const jet over = gram(a.wide, i, k), middle = gram(a.centre, i, k);
            size[i][k] = size[k][i] = ld_interval_abs(jet_values(&over, &middle, a.offset));
        }
    for (int i = 0; i < 3; ++i) {
        const ld_interval row =
            ld_interval_add(ld_interval_add(size[i][0], size[i][1]), size[i][2]);
        if (!(row.hi <= most)) most = row.hi;
    }
    return most;
}

/* The greatest deviation of the parts that hold all of the times. */
static double deviation_of_parts(const piece *p, const part *first, const box3 *times, double lo,
                                 double hi, jet room[])
{
    double most = 0;
    for (const part *q = first; q != NULL; q = enclose_next_part(p, q, times)) {
        const double d = deviation(q, lo, hi, room);
        if (!(d <= most)) most = d;
    }
    return most;
}

/* Times are halved until d is small or this deep. */
enum { HALVINGS = 14 };
#define DEVIATION_SMALL 0x1p-26

static double worst(const piece *p, double lo, double hi, int depth, jet room[])
{
    const part *found;
    split divide;
    const box3 times = {{-INFINITY, -INFINITY, lo}, {INFINITY, INFINITY, hi}};
    const enclosed result = enclose_choose_part(p, &times, &found, &divide);
    double at = lo + 0.5 * (hi - lo);
    if (result != ENCLOSED && result != ENCLOSED_SPLIT) return INFINITY;
    if (result == ENCLOSED) {
        const double d = deviation_of_parts(p, found, &times, lo, hi, room);
        if (d <= DEVIATION_SMALL || depth >= HALVINGS || !(lo < at && at < hi) || isinf(d))
            return d;
        /* it is no smaller there */
        if (deviation_of_parts(p, found, &times, at, at, room) > 0.5 * d) return d;
    } else {
        at = divide.at;
    }
    depth += result == ENCLOSED;
    const double first = worst(p, lo, at, depth, room);
    const double second = worst(p, at, hi, depth, room);
    return !(first <= second) ? first : second;
}

double map_deviation_upper(const statement *s, size_t map, double lo, double hi, jet *room)
{
    return worst(&s->stages[map].pieces[0], lo, hi, 0, room);
}
