/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/ffd_model.h"

/* --- Models ----------------------------------------------------------------------------------- */

/* a limited to [0, 1]; da/dx is 0 outside the box. */
static imp_model ffd_coordinate(const ffd_instance *s, int j, imp_model x, imp_interval *stretch)
{
    const near_constant k = s->per_length[j];
    const imp_model lo = imp_num(s->lo[j]), hi = imp_num(s->hi[j]);
    *stretch = imp_interval_make(imp_sum_down(k.value - k.error), imp_sum_up(k.value + k.error));
    if (!(x.lo >= s->lo[j] && x.hi <= s->hi[j])) stretch->lo = 0;
    if (x.hi <= s->lo[j] || x.lo >= s->hi[j]) *stretch = imp_interval_make(0, 0);
    imp_model inside = imp_min(imp_max(x, lo), hi);
    imp_model a = near_scale(imp_shift(inside, -s->lo[j]), k);
    return imp_min(imp_max(a, imp_num(0)), imp_num(1));
}

/* Below this a half-width is as good as 0, and its inverse might not be finite. */
#define HALF_MIN 0x1p-900

static void ffd_set_coordinate(ffd_place *place, int j, imp_model a)
{
    const imp_interval range = imp_interval_make(a.lo, a.hi);
    const double centre = imp_interval_mid(range);
    place->centre[j] = centre;
    place->half[j] = imp_larger(imp_interval_radius_upper(range, centre), HALF_MIN);
    near_constant inverse = near_of(imp_div(imp_num(1), imp_num(place->half[j])));
    place->s[j] =
        imp_model_within(near_scale(imp_shift(a, -centre), inverse), imp_interval_make(-1, 1));
}

static void ffd_set_products(ffd_place *place)
{
    const imp_model *s = place->s;
    for (int j = 0, k = 0; j < 3; ++j)
        for (int l = j; l < 3; ++l, ++k) {
            if (j < l) place->product[k] = imp_mul(s[j], s[l]);
            if (j == l) place->chebyshev[k] = imp_shift(imp_scale(imp_sqr(s[j]), 2), -1);
        }
}

void ffd_set_place(const ffd_instance *s, const imp_model x[3], imp_model t, ffd_place *place)
{
    for (int j = 0; j < 3; ++j)
        ffd_set_coordinate(place, j, ffd_coordinate(s, j, x[j], &place->stretch[j]));
    lattice_enter(&s->lattice, place->centre, place->half, &place->box);
    ffd_set_products(place);
    place->times = imp_interval_make(t.lo, t.hi);
    place->middle = imp_interval_mid(place->times);
    place->reach = imp_interval_radius_upper(place->times, place->middle);
    place->late = imp_shift(t, -place->middle);
}

/* The sum of two series is rounded twice: by |X| + 2 |middle Y| units at most. */
void ffd_set_terms(const ffd_instance *s, const ffd_place *place, int axis, ffd_terms *terms)
{
    const lattice_lane *shape = &s->shape[axis], *drift = &s->drift[axis];
    const double middle = place->middle;
    double series[LATTICE_POINTS_MAX];
    *terms = (ffd_terms){.noise = shape->noise};
    if (!s->moves) {
        terms->shape = lattice_over(&s->lattice, &place->box, shape->series);
        return;
    }
    for (size_t i = 0; i < lattice_points(&s->lattice); ++i)
        series[i] = shape->series[i] + middle * drift->series[i];
    terms->shape = lattice_over(&s->lattice, &place->box, series);
    terms->drift = lattice_over(&s->lattice, &place->box, drift->series);
    terms->drift_noise = drift->noise;
    double sum = fabs(middle) * (drift->noise + 2 * IMP_U * drift->sum) + IMP_U * shape->sum;
    terms->noise = (shape->noise + sum + place->reach * drift->noise + IMP_TINY) * LATTICE_SLACK;
}

static void ffd_add(imp_model *sum, double factor, imp_model x)
{
    if (factor != 0) *sum = imp_add(*sum, imp_scale(x, factor));
}

/* Where the displacement is at all: from what the series add up to, and from the control points. */
static imp_interval ffd_range(const ffd_instance *s, const ffd_place *place, int axis,
                              const ffd_terms *terms)
{
    const lattice_terms *x = &terms->shape, *y = &terms->drift;
    imp_interval hull = s->shape[axis].range;
    double reach = x->size + place->reach * (fabs(y->mean) + y->size) + terms->noise;
    if (s->moves)
        hull = imp_interval_add(hull, imp_interval_mul(place->times, s->drift[axis].range));
    reach *= LATTICE_SLACK;
    imp_interval around = imp_interval_make(-reach, reach);
    return imp_interval_intersect(hull,
                                  imp_interval_add(imp_interval_make(x->mean, x->mean), around));
}

/* kept x_i + constant + linear s_i stands for x_i + D_i's first terms, mean + d s_i. As x_i is lo +
 * length (centre + half s_i) while it is in the box, kept may be 1 + d / (length half), so that
 * what the lattice shrinks is not bounded as a large motion and its opposite. Outside kept is 1.
 *
 * Rounding, in units of 2^-53: of the constant, 4 |kept - 1| (|lo| + length); of `linear`, 4
 * |kept - 1| length half + |linear|, which is below 6 |d|. */
typedef struct ffd_first {
    double kept, constant, linear, noise;
} ffd_first;

static ffd_first ffd_first_terms(const ffd_instance *s, const ffd_place *place, int axis,
                                 const lattice_terms *x)
{
    const double lo = s->lo[axis], length = s->hi[axis] - lo, half = place->half[axis];
    const double d = x->linear[axis], kept = 1 + d / (length * half);
    if (!(place->stretch[axis].lo > 0 && half > HALF_MIN && fabs(kept) < 1))
        return (ffd_first){1, x->mean, d, 0};
    ffd_first first = {.kept = kept};
    const double more = kept - 1, size = fabs(lo) + length;
    first.constant = x->mean - more * (lo + length * place->centre[axis]);
    first.linear = d - more * (length * half);
    first.noise = 8 * IMP_U * (fabs(more) * size + fabs(d) + fabs(x->mean)) * LATTICE_SLACK;
    return first;
}

/* x_i + D_i. C T_2 is 2 C s^2 - C. */
imp_model ffd_image(const ffd_instance *s, const ffd_place *place, int axis, const ffd_terms *terms,
                    imp_model at)
{
    static const bool is_square[6] = {[IMP_UU] = true, [IMP_VV] = true, [IMP_TT] = true};
    const lattice_terms *x = &terms->shape, *y = &terms->drift;
    const ffd_first first = ffd_first_terms(s, place, axis, x);
    imp_model sum = imp_shift(imp_scale(at, first.kept), first.constant), speed = imp_num(y->mean);
    for (int j = 0; j < 3; ++j) {
        ffd_add(&sum, j == axis ? first.linear : x->linear[j], place->s[j]);
        ffd_add(&speed, y->linear[j], place->s[j]);
    }
    for (int k = 0; k < 6; ++k)
        ffd_add(&sum, x->product[k], is_square[k] ? place->chebyshev[k] : place->product[k]);
    if (s->moves) sum = imp_add(sum, imp_mul(place->late, speed));
    double rest = (x->rest + place->reach * y->bowed + terms->noise + first.noise) * LATTICE_SLACK;
    sum.e = imp_sum_up(sum.e + rest);
    sum.lo = imp_sum_down(sum.lo - rest);
    sum.hi = imp_sum_up(sum.hi + rest);
    return imp_model_within(
        sum, imp_interval_add(imp_interval_make(at.lo, at.hi), ffd_range(s, place, axis, terms)));
}

/* --- Rates ------------------------------------------------------------------------------------ */

static imp_interval ffd_widened(double x, double more)
{
    more *= LATTICE_SLACK;
    return imp_interval_make(imp_sum_down(x - more), imp_sum_up(x + more));
}

/* The displacement's derivative with respect to x (j = 0), y or z, 0 where space moves as a whole:
 * from the series over the place, and from the control points' slopes all over the box. */
static imp_interval ffd_strain(const ffd_instance *s, const ffd_place *place, int axis, int j,
                               const ffd_terms *terms)
{
    const lattice_terms *x = &terms->shape, *y = &terms->drift;
    const int n = s->lattice.degree[j];
    double more = x->along[j] + place->reach * (fabs(y->linear[j]) + y->along[j]);
    imp_interval half = imp_interval_make(place->half[j], place->half[j]);
    imp_interval hull = s->shape[axis].slope[j];
    imp_interval slope =
        imp_interval_div(ffd_widened(x->linear[j], more + n * n * terms->noise), half);
    if (s->moves)
        hull = imp_interval_add(hull, imp_interval_mul(place->times, s->drift[axis].slope[j]));
    return imp_interval_mul(imp_interval_intersect(slope, hull), place->stretch[j]);
}

static double ffd_speed_upper(const ffd_instance *s, int axis, const ffd_terms *terms)
{
    const lattice_terms *y = &terms->drift;
    if (!s->moves) return 0;
    return imp_interval_mag(imp_interval_intersect(
        s->drift[axis].range, ffd_widened(y->mean, y->size + terms->drift_noise)));
}

/* |d phi_i / dp| <= sum_j |d phi_i / dx_j| |dx_j / dp|, and the speed for p = t. */
void ffd_set_rates(const ffd_instance *s, const ffd_place *place, int axis, const ffd_terms *terms,
                   const imp_model in[4], imp_model *out)
{
    double sum[3] = {0, 0, 0}, speed = ffd_speed_upper(s, axis, terms);
    for (int j = 0; j < 3; ++j) {
        imp_interval same = imp_interval_make(j == axis, j == axis);
        imp_interval slope = imp_interval_add(same, ffd_strain(s, place, axis, j, terms));
        for (int p = 0; p < 3; ++p) sum[p] += imp_interval_mag(slope) * in[j].rate[p];
    }
    for (int p = 0; p < 3; ++p)
        out->rate[p] = (sum[p] + speed * in[3].rate[p] + IMP_TINY) * LATTICE_SLACK;
}
