/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/near.h"
#include "plugins/common/publish.h"
#include "plugins/common/spline.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* Rigid motion in pieces: parabolas with constant spin
 * ====================================================
 * Between the times T_i and T_i+1 of two keys, with h = T_i+1 - T_i and s = t - T_i, the body's
 * center moves along the parabola through both positions whose acceleration is a_i, and the body
 * turns about it by
 *
 *   R(s) = turn(spin_i, s) M_i + s D_i,   D_i = (M_i+1 - turn(spin_i, h) M_i) / h,
 *
 * where M_i is the rotation of key i and turn(w, s) that by the angle |w| s about w. The last term
 * makes R continuous: R(h) = M_i+1 exactly, while doubles hold turn(spin_i, h) M_i only nearly. It
 * is refused where it is more than rounding and the like:
 *
 * Lemma. No entry of h D_i is above MISMATCH, so that no entry of R is beyond 1 + MISMATCH, |R x| <=
 * (1 + 3 MISMATCH) |x|, and no entry changes faster than |spin_i| + max |D_i|: a column of turn M_i
 * moves like a point at distance 1.
 *
 * So velocities and spins may jump at keys, places do not. A span of times within one piece has the
 * formula above; of the position across several pieces spline.h says what is known.
 *
 * Lemma. Over several pieces, with W at least all speeds of the last lemma and eta at least all 3 max
 * |D_i| (1 + |spin_i| h), X = R x moves by dX/dt = spin x X + E, |E| <= eta |x|: in one piece spin x X
 * = spin x (turn M x + s D x), and s |spin| |D x| and |D x| are the difference. So |dX/dt| <= V |x|
 * with V = W (1 + 4 MISMATCH) + eta, and from the middle m of the span, |y| <= r,
 *
 *   X(m + y) = X(m) + g x X(m) + F,   |F| <= (W V r / 2 + eta) r |x|,
 *
 * where g is the integral of the spin from m on, whose coordinates have slopes between the least and the
 * greatest of those pieces. F depends on time by at most (W V r + eta) |x|, and on x as it depends on
 * |x|, being linear in x. Near a point that touches, g x X(m) is along the surfaces. */

enum { TIMES, POSITIONS, ACCELERATIONS, ROTATIONS, SPINS, CENTER };

static const imp_parameter parameters[] = {
    [TIMES] = IMP_ROW_NUMBERS("times", "time", NULL, 0,
                              "of the keys, increasing, two or more; the map is defined from the "
                              "first to the last only"),
    [POSITIONS] =
        IMP_ROW_VECTORS("positions", "length", NULL, 3, 0, "where each key moves the center to"),
    [ACCELERATIONS] =
        IMP_ROW_VECTORS("accelerations", "length/time^2", NULL, 3, IMP_OPTIONAL,
                        "from each key to the next, one less than keys; default: none"),
    [ROTATIONS] = IMP_ROW_VECTORS(
        "rotations", "1", NULL, 4, IMP_OPTIONAL,
        "rotation of each key about the center: a unit quaternion [w,x,y,z]; normalized if its "
        "length is within 1e-6 of 1; default: none"),
    [SPINS] = IMP_ROW(
        "spins", "rad/time", NULL, IMP_OPTIONAL, 2, 0, 3, -1e100, 1e100,
        "with rotations: angular velocity from each key to the next, one less than keys; it "
        "must lead from each rotation to the next within 1e-6"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0,
                              "the point of the body that moves "
                              "to the positions"),
};

#define UNIT_SLACK 1e-6
#define MISMATCH 1e-6
#define SPIN_MIN 1e-100

/* Entry (i,j) of R is along + cos A across + sin A turned + s drift, A = speed s. */
typedef struct rotation {
    near_constant along[3][3], across[3][3], turned[3][3], drift[3][3], speed;
    double spin[3];
} rotation;

typedef struct trajectory_instance {
    double center[3];
    rotation *rotation; /* one for each piece; NULL: none */
    spline path; /* one further column if there are rotations: how fast entries of R change */
    spline_cubic memory[];
} trajectory_instance;

/* --- Checks --- */

static imp_status check_times(const imp_value *times, imp_create_error *why)
{
    if (times->count < 2) return imp_reject(why, TIMES, -1, "a single key; must be two or more");
    for (size_t i = 1; i < times->count; ++i)
        if (!(times->number[i - 1] < times->number[i]))
            return imp_reject(why, TIMES, (int64_t)i, "%.17g after %.17g; times must increase",
                              times->number[i], times->number[i - 1]);
    return IMP_OK;
}

/* `less`: by how much there are fewer than keys. */
static imp_status check_count(const imp_value *values, int row, size_t less, imp_create_error *why)
{
    const size_t wanted = values[TIMES].count - less;
    if (!imp_is_given(&values[row]) || values[row].extent[0] == wanted) return IMP_OK;
    return imp_reject(why, row, -1, "%zu %s for %zu times; must be %zu", values[row].extent[0],
                      parameters[row].name, values[TIMES].count, wanted);
}

static imp_status check_rotations(const imp_value *rotations, imp_create_error *why)
{
    for (size_t i = 0; i < rotations->count / 4; ++i) {
        const double *q = rotations->number + 4 * i;
        const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (!(fabs(length - 1) <= UNIT_SLACK))
            return imp_reject(why, ROTATIONS, (int64_t)i,
                              "[%g,%g,%g,%g] has length %.9g; must be 1 within %g", q[0], q[1],
                              q[2], q[3], length, UNIT_SLACK);
    }
    return IMP_OK;
}

/* No spin at all, or one whose square is no subnormal. */
static imp_status check_spins(const imp_value *spins, imp_create_error *why)
{
    for (size_t i = 0; i < spins->count / 3; ++i) {
        const double *w = spins->number + 3 * i;
        const double most = imp_larger(fabs(w[0]), imp_larger(fabs(w[1]), fabs(w[2])));
        if (most > 0 && most < SPIN_MIN)
            return imp_reject(why, SPINS, (int64_t)i, "[%g,%g,%g]; must be 0, or %g at least", w[0],
                              w[1], w[2], SPIN_MIN);
    }
    return IMP_OK;
}

static imp_status check(const imp_value *values, imp_create_error *why)
{
    imp_status status = check_times(&values[TIMES], why);
    if (status == IMP_OK) status = check_count(values, POSITIONS, 0, why);
    if (status == IMP_OK) status = check_count(values, ACCELERATIONS, 1, why);
    if (status == IMP_OK && imp_is_given(&values[ROTATIONS]) != imp_is_given(&values[SPINS]))
        return imp_reject(why, imp_is_given(&values[SPINS]) ? SPINS : ROTATIONS, -1,
                          "given alone; rotations and spins belong together");
    if (status == IMP_OK) status = check_count(values, ROTATIONS, 0, why);
    if (status == IMP_OK) status = check_count(values, SPINS, 1, why);
    if (status == IMP_OK) status = check_rotations(&values[ROTATIONS], why);
    if (status == IMP_OK) status = check_spins(&values[SPINS], why);
    return status;
}

/* --- Making one --- */

typedef struct matrix {
    imp_interval at[3][3];
} matrix;

static imp_interval exact(double x) { return imp_interval_make(x, x); }

static matrix matrix_mul(const matrix *a, const matrix *b)
{
    matrix r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            r.at[i][j] = exact(0);
            for (int k = 0; k < 3; ++k)
                r.at[i][j] =
                    imp_interval_add(r.at[i][j], imp_interval_mul(a->at[i][k], b->at[k][j]));
        }
    return r;
}

/* The rotation of q / |q|: 1 + 2 (w [v] + v v' - v'v) / |q|^2. */
static matrix matrix_of_quaternion(const double *q)
{
    matrix r;
    imp_interval square[4], sum = exact(0);
    for (int i = 0; i < 4; ++i) {
        square[i] = imp_interval_sqr(exact(q[i]));
        sum = imp_interval_add(sum, square[i]);
    }
    const imp_interval twice = imp_interval_div(exact(2), sum);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        imp_interval both = imp_interval_mul(exact(q[1 + i]), exact(q[1 + j]));
        imp_interval turn = imp_interval_mul(exact(q[0]), exact(q[1 + k]));
        imp_interval lost = imp_interval_mul(imp_interval_add(square[1 + j], square[1 + k]), twice);
        r.at[i][i] = imp_interval_sub(exact(1), lost);
        r.at[i][j] = imp_interval_mul(imp_interval_sub(both, turn), twice);
        r.at[j][i] = imp_interval_mul(imp_interval_add(both, turn), twice);
    }
    return r;
}

/* The parts of a turn about w: k k', 1 - k k' and k x, for k = w / |w|; and |w|. */
typedef struct turn_parts {
    matrix along, across, turned;
    imp_interval speed;
} turn_parts;

static turn_parts parts_of_spin(const double *w)
{
    turn_parts p = {.speed = exact(0)};
    imp_interval k[3];
    for (int i = 0; i < 3; ++i) p.speed = imp_interval_add(p.speed, imp_interval_sqr(exact(w[i])));
    p.speed = imp_interval_sqrt(p.speed);
    const bool still = w[0] == 0 && w[1] == 0 && w[2] == 0;
    for (int i = 0; i < 3; ++i) k[i] = still ? exact(0) : imp_interval_div(exact(w[i]), p.speed);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            imp_interval both = i == j ? imp_interval_sqr(k[i]) : imp_interval_mul(k[i], k[j]);
            p.along.at[i][j] = both;
            p.across.at[i][j] = imp_interval_sub(exact(i == j), both);
        }
        p.turned.at[i][i] = exact(0);
        p.turned.at[i][(i + 2) % 3] = k[(i + 1) % 3];
        p.turned.at[i][(i + 1) % 3] = imp_interval_neg(k[(i + 2) % 3]);
    }
    return p;
}

static near_constant near_within(imp_interval x)
{
    const double m = imp_interval_mid(x);
    return (near_constant){m, imp_interval_radius_upper(x, m)};
}

/* One piece, from the rotation `from` to `to` in the time h. bound[0]: how fast entries change at most,
 * infinite where spin and rotations do not agree; bound[1]: eta. */
static void set_rotation(rotation *r, const double *spin, const matrix *from, const matrix *to,
                         imp_interval h, imp_interval bound[2])
{
    turn_parts p = parts_of_spin(spin);
    const imp_interval angle = imp_interval_mul(p.speed, h);
    const imp_interval cosine = imp_interval_cos(angle), sine = imp_interval_sin(angle);
    p.along = matrix_mul(&p.along, from);
    p.across = matrix_mul(&p.across, from);
    p.turned = matrix_mul(&p.turned, from);
    double most = 0, miss = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            imp_interval end = imp_interval_mul(cosine, p.across.at[i][j]);
            end = imp_interval_add(end, imp_interval_mul(sine, p.turned.at[i][j]));
            end = imp_interval_sub(to->at[i][j], imp_interval_add(end, p.along.at[i][j]));
            const imp_interval drift = imp_interval_div(end, h);
            miss = imp_larger(imp_interval_mag(end), miss);
            most = imp_larger(imp_interval_mag(drift), most);
            r->along[i][j] = near_within(p.along.at[i][j]);
            r->across[i][j] = near_within(p.across.at[i][j]);
            r->turned[i][j] = near_within(p.turned.at[i][j]);
            r->drift[i][j] = near_within(drift);
        }
    r->speed = near_within(p.speed);
    memcpy(r->spin, spin, sizeof r->spin);
    const double speed = miss <= MISMATCH ? imp_sum_up(p.speed.hi + most) : INFINITY;
    bound[0] = imp_interval_make(0, speed);
    bound[1] = imp_interval_make(0, 3 * most * (1 + angle.hi) * IMP_SLACK);
}

/* Returns the index of the first invalid piece; `pieces` if all are valid. */
static size_t set_rotations(trajectory_instance *s, const imp_value *values)
{
    const spline *path = &s->path;
    const double *q = values[ROTATIONS].number;
    matrix from = matrix_of_quaternion(q);
    for (size_t i = 0; i < path->pieces; ++i) {
        const matrix to = matrix_of_quaternion(q + 4 * (i + 1));
        imp_interval *bound = spline_node(path, path->pieces + i) + path->width - 2;
        set_rotation(&s->rotation[i], values[SPINS].number + 3 * i, &from, &to,
                     spline_step(path, i, i + 1), bound);
        if (!imp_interval_is_finite(bound[0]) || !imp_interval_is_finite(bound[1])) return i;
        from = to;
    }
    return path->pieces;
}

static imp_status fill(trajectory_instance *s, const imp_value *values, imp_interval *key,
                       imp_create_error *why)
{
    const double *accelerations =
        imp_is_given(&values[ACCELERATIONS]) ? values[ACCELERATIONS].number : NULL;
    size_t piece;
    imp_copy_vector(s->center, &values[CENTER]);
    memcpy(s->path.time, values[TIMES].number, values[TIMES].count * sizeof(double));
    for (size_t k = 0; k < values[POSITIONS].count; ++k)
        key[k] = exact(values[POSITIONS].number[k]);
    if (!spline_set_parabolas(&s->path, key, accelerations, &piece))
        return imp_reject(why, POSITIONS, (int64_t)piece + 1,
                          "too far from the key before for the time between them: speeds are not "
                          "finite");
    piece = s->rotation != NULL ? set_rotations(s, values) : s->path.pieces;
    if (piece < s->path.pieces)
        return imp_reject(why, ROTATIONS, (int64_t)piece + 1,
                          "not where the spin leads to from the rotation before; entries of both "
                          "matrices must agree within %g",
                          MISMATCH);
    spline_grow(&s->path);
    return IMP_OK;
}

static imp_status trajectory_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check(values, why);
    if (status != IMP_OK) return status;
    const size_t keys = values[TIMES].count, bytes = spline_bytes(keys, 3, 2);
    const bool turns = imp_is_given(&values[ROTATIONS]);
    trajectory_instance *s = malloc(sizeof *s + bytes + keys * sizeof(rotation));
    imp_interval *key = malloc(3 * keys * sizeof *key);
    if (s != NULL && key != NULL) {
        s->path = spline_place(keys, 3, turns ? 2 : 0, s->memory);
        s->path.kinked = true;
        s->rotation = turns ? (rotation *)((char *)s->memory + bytes) : NULL;
        status = fill(s, values, key, why);
        *self = s;
    } else {
        status = IMP_INTERNAL;
    }
    free(key);
    if (status != IMP_OK) free(s);
    return status;
}

/* --- The map --- */

static void trajectory_time_domain(const void *self, double *lo, double *hi)
{
    const trajectory_instance *s = self;
    *lo = s->path.time[0];
    *hi = s->path.time[s->path.pieces];
}

/* An entry of R, at most 1 + MISMATCH, rates at most `speed`. */
static imp_model entry(imp_model r, const imp_model *t, double speed)
{
    const double most = 1 + 2 * MISMATCH;
    for (int j = 0; j < 3; ++j)
        if (r.depends >> j & 1)
            r.rate[j] = imp_smaller(r.rate[j], imp_round_up(speed * t->rate[j]));
    return imp_model_within(r, imp_interval_make(-most, most));
}

/* R over times t of one piece. */
static void matrix_at(const rotation *r, double start, imp_model t, double speed,
                      imp_model out[3][3])
{
    const imp_model s = imp_shift(t, -start);
    imp_model sine, cosine;
    imp_sincos(near_scale(s, r->speed), &sine, &cosine);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            imp_model sum =
                imp_add(near_scale(cosine, r->across[i][j]), near_scale(sine, r->turned[i][j]));
            sum = imp_add(sum, near_scale(s, r->drift[i][j]));
            out[i][j] = entry(near_shift(sum, r->along[i][j]), &t, speed);
        }
}

static double size_upper(const imp_model x[3])
{
    imp_interval square = exact(0);
    for (int i = 0; i < 3; ++i)
        square = imp_interval_add(square, imp_interval_sqr(imp_interval_make(x[i].lo, x[i].hi)));
    return imp_interval_sqrt(square).hi;
}

/* R x, no longer than (1 + 3 MISMATCH) |x|. */
static void turn(imp_model r[3][3], const imp_model x[3], imp_model out[3])
{
    const double most = imp_round_up(size_upper(x) * (1 + 4 * MISMATCH));
    for (int i = 0; i < 3; ++i)
        out[i] = imp_model_within(imp_dot3(r[i], x), imp_interval_make(-most, most));
}

/* Joins the spins of the pieces of a span; as the speed says, where these are too many to ask each. */
static void spins_of(const trajectory_instance *s, const spline_span *span, double speed,
                     imp_interval spin[3])
{
    enum { FEW = 16 };
    const bool many = span->last - span->first >= FEW;
    for (int j = 0; j < 3; ++j) {
        spin[j] = many ? imp_interval_make(-speed, speed) : exact(s->rotation[span->first].spin[j]);
        for (size_t k = span->first + 1; k <= span->last && !many; ++k)
            spin[j] = spline_hull(spin[j], exact(s->rotation[k].spin[j]));
    }
}

/* The integral of the spin from the middle of t on, a coordinate of it. */
static imp_model turned_since_middle(imp_interval spin, const imp_model *t)
{
    imp_series g = imp_series_around(imp_model_range(t));
    g.c[1] = imp_interval_mid(spin);
    g.e = imp_interval_radius_upper(spin, g.c[1]) * g.r * IMP_SLACK;
    const double most = imp_interval_mag(spin), far = imp_round_up(most * g.r);
    return imp_compose(t, &g, imp_interval_make(-far, far), most);
}

/* R x over times of several pieces, by the last lemma above. */
static void turn_across(const trajectory_instance *s, const spline_span *span,
                        const imp_interval *node, imp_model t, const imp_model x[3],
                        imp_model out[3])
{
    const double speed = node[s->path.width - 2].hi, stray = node[s->path.width - 1].hi;
    const double r = imp_series_around(imp_model_range(&t)).r;
    const double fast = speed * (1 + 4 * MISMATCH) + stray, most = size_upper(x);
    const double slip = (0.5 * speed * fast * r + stray) * r * IMP_SLACK;
    const double drift = (speed * fast * r + stray) * most * IMP_SLACK;
    imp_model m[3][3], w[3], g[3];
    imp_interval spin[3];
    matrix_at(&s->rotation[span->at], s->path.time[span->at], imp_num(span->m), speed, m);
    turn(m, x, w);
    spins_of(s, span, speed, spin);
    for (int j = 0; j < 3; ++j) g[j] = turned_since_middle(spin[j], &t);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        imp_model sum = imp_sub(imp_mul(g[j], w[k]), imp_mul(g[k], w[j]));
        sum = imp_add(w[i], sum);
        const double e = slip * most * IMP_SLACK + IMP_TINY;
        sum.e = imp_sum_up(sum.e + e);
        sum.lo = imp_sum_down(sum.lo - e);
        sum.hi = imp_sum_up(sum.hi + e);
        sum.depends |= t.depends;
        for (int p = 0; p < 3; ++p) {
            const double rates = x[0].rate[p] + x[1].rate[p] + x[2].rate[p];
            sum.rate[p] = (sum.rate[p] + (slip * rates + drift * t.rate[p]) + IMP_TINY) * IMP_SLACK;
        }
        const double limit = imp_round_up(most * (1 + 4 * MISMATCH));
        out[i] = imp_model_within(imp_model_finish(sum), imp_interval_make(-limit, limit));
    }
}

static void trajectory_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                               imp_model out[3])
{
    const trajectory_instance *s = self;
    const imp_model w[3] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                            imp_shift(z, -s->center[2])};
    const imp_series around = imp_series_around(imp_model_range(&t));
    const spline_span span = spline_span_of(&s->path, t.lo, around.m, t.hi);
    imp_model lane[3], r[3][3];
    imp_interval node[SPLINE_WIDTH_MAX];
    spline_models(&s->path, t, lane, node);
    memcpy(out, w, sizeof w);
    if (s->rotation != NULL && span.first == span.last) {
        matrix_at(&s->rotation[span.at], s->path.time[span.at], t, node[s->path.width - 2].hi, r);
        turn(r, w, out);
    } else if (s->rotation != NULL) {
        turn_across(s, &span, node, t, w, out);
    }
    for (int i = 0; i < 3; ++i) out[i] = imp_add(out[i], lane[i]);
}
IMP_MAP_FORMULA(trajectory_formula)

static bool is_inside(const trajectory_instance *s, double lo, double hi)
{
    return lo >= s->path.time[0] && hi <= s->path.time[s->path.pieces];
}

static imp_status trajectory_eval(const void *self, size_t n, const double *p, double *x,
                                  double *error)
{
    for (size_t k = 0; k < n; ++k)
        if (!is_inside(self, p[4 * k + 3], p[4 * k + 3])) return IMP_DOMAIN;
    return trajectory_formula_eval(self, n, p, x, error);
}

static imp_status trajectory_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    if (!is_inside(self, box->lo[3], box->hi[3])) return IMP_DOMAIN;
    return trajectory_formula_rate(self, box, rates);
}

static imp_status trajectory_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    if (!is_inside(self, in[3].lo, in[3].hi)) return IMP_DOMAIN;
    return trajectory_formula_apply(self, in, out);
}

static const imp_map_type trajectory = {
    IMP_MAP_FIELDS(trajectory, trajectory),
    .summary = "moves along parabolas and turns at constant spin, from key to key",
    .equation = "with s = t - times_i, h = times_i+1 - times_i: p + R ((x,y,z) - center); p = "
                "positions_i + "
                "(positions_i+1 - positions_i) s/h - accelerations_i s (h - s)/2; R = T(s) M_i + "
                "(M_i+1 - T(h) M_i) s/h, M_i: rotation of rotations_i/|rotations_i|, T(s): by "
                "|spins_i| s about spins_i",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, section 6",
    .example = "trajectory times=0,1,2 positions=[[0,0,1],[1,0,0],[2,0,1]] "
               "accelerations=[[0,0,-2],[0,0,-2]]",
};

PUBLISH_MAP(trajectory);
