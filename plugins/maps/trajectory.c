/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/keys.h"
#include "plugins/common/publish.h"
#include "plugins/common/spin.h"
#include "plugins/common/spin_across.h"
#include "plugins/common/spin_text.h"
#include "plugins/common/spline.h"

#include <impinge/formula.h>
#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* Rigid motion in pieces: parabolas with constant spin
 * ====================================================
 * Between the times T_i and T_i+1 of two keys, with h = T_i+1 - T_i and s = t - T_i, the body's
 * center moves along the parabola through both positions whose acceleration is a_i, and the body
 * turns about it by
 *
 *   R(s) = turn(spin_i, s) M_i + s D_i,   D_i = (M_i+1 - turn(spin_i, h) M_i) / h,
 *
 * where M_i is the rotation of key i: spin.h says more, and has a lemma. R is continuous.
 *
 * So velocities and spins may jump at keys, places do not. A span of times within one piece has the
 * formula above; across several pieces spline.h bounds the position and spin_across.h the rotation.
 */

enum { TIMES, POSITIONS, ACCELERATIONS, ROTATIONS, SPINS, CENTER };

static const imp_parameter parameters[] = {
    [TIMES] = IMP_ROW_NUMBERS("times", "time", NULL, 0,
                              "of the keys, increasing, two or more; the map is defined from the "
                              "first to the last only"),
    [POSITIONS] =
        IMP_ROW_VECTORS("positions", "length", NULL, 3, 0, "where each key moves the center to"),
    [ACCELERATIONS] =
        IMP_ROW_VECTORS("accelerations", "length/time^2", NULL, 3, IMP_PARAMETER_OPTIONAL,
                        "from each key to the next, one less than keys; default: none"),
    [ROTATIONS] = IMP_ROW_VECTORS(
        "rotations", "1", NULL, 4, IMP_PARAMETER_OPTIONAL,
        "rotation of each key about the center: a unit quaternion [w,x,y,z]; normalized if its "
        "length is within 1e-6 of 1; default: none"),
    [SPINS] = IMP_ROW(
        "spins", "rad/time", NULL, IMP_PARAMETER_OPTIONAL, 2, 0, 3, -1e100, 1e100,
        "with rotations: angular velocity from each key to the next, one less than keys; it "
        "must lead from each rotation to the next within 1e-6"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0,
                              "the point of the body that moves "
                              "to the positions"),
};

#define SPIN_MIN 1e-100

typedef struct trajectory_instance {
    double center[3];
    const double *positions, *accelerations, *rotations, *spins; /* as given; NULL: none */
    spin_turn *rotation; /* one for each piece; NULL: none */
    spline path; /* one further column if there are rotations: how fast entries of R change */
    imp_interval memory[];
} trajectory_instance;

/* --- Checks ----------------------------------------------------------------------------------- */

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
    return IMP_STATUS_OK;
}

static imp_status check(const imp_value *values, imp_create_error *why)
{
    imp_status status = keys_check_times(TIMES, &values[TIMES], why);
    if (status == IMP_STATUS_OK)
        status = keys_check_count(parameters, values, POSITIONS, values[TIMES].count, why);
    if (status == IMP_STATUS_OK)
        status = keys_check_count(parameters, values, ACCELERATIONS, values[TIMES].count - 1, why);
    if (status == IMP_STATUS_OK && imp_is_given(&values[ROTATIONS]) != imp_is_given(&values[SPINS]))
        return imp_reject(why, imp_is_given(&values[SPINS]) ? SPINS : ROTATIONS, -1,
                          "given alone; rotations and spins belong together");
    if (status == IMP_STATUS_OK)
        status = keys_check_count(parameters, values, ROTATIONS, values[TIMES].count, why);
    if (status == IMP_STATUS_OK)
        status = keys_check_count(parameters, values, SPINS, values[TIMES].count - 1, why);
    if (status == IMP_STATUS_OK) status = keys_check_rotations(ROTATIONS, &values[ROTATIONS], why);
    if (status == IMP_STATUS_OK) status = check_spins(&values[SPINS], why);
    return status;
}

/* --- Making one ------------------------------------------------------------------------------- */

static imp_interval exact(double x) { return imp_interval_make(x, x); }

/* Returns the index of the first invalid piece; `pieces` if all are valid. */
static size_t set_rotations(trajectory_instance *s, const imp_value *values)
{
    const spline *path = &s->path;
    for (size_t i = 0; i < path->pieces; ++i) {
        const double *q = values[ROTATIONS].number + 4 * i;
        imp_interval *bound = spline_node(path, path->pieces + i) + path->width - 2;
        s->rotation[i] = spin_turn_make(values[SPINS].number + 3 * i, q, q + 4,
                                        spline_step(path, i, i + 1), bound);
        if (!imp_interval_is_finite(bound[0]) || !imp_interval_is_finite(bound[1])) return i;
    }
    return path->pieces;
}

/* Sets the path of an instance that has its places; *key has room for all positions. */
static imp_status set_path(trajectory_instance *s, const imp_value *values, imp_interval *key,
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
                          SPIN_MISMATCH);
    spline_grow(&s->path);
    return IMP_STATUS_OK;
}

static void keep_given(trajectory_instance *s, const imp_value *values, double *room)
{
    s->positions = keys_keep(&values[POSITIONS], &room);
    s->accelerations = keys_keep(&values[ACCELERATIONS], &room);
    s->rotations = keys_keep(&values[ROTATIONS], &room);
    s->spins = keys_keep(&values[SPINS], &room);
}

/* Bytes behind the instance: the path and the turns; and the numbers as given, with the positions
 * once more as intervals while the path is set. */
typedef struct room {
    size_t path, turns, numbers;
} room;

static room room_for(size_t keys)
{
    return (room){spline_bytes(SPLINE_CUBIC, keys, 3, 2), keys * sizeof(spin_turn),
                  13 * keys * sizeof(double) + 3 * keys * sizeof(imp_interval)};
}

/* Fills an instance that has room for as many keys as the checked values. */
static imp_status fill(trajectory_instance *s, const imp_value *values, imp_create_error *why)
{
    const size_t keys = values[TIMES].count;
    const room r = room_for(keys);
    const bool turns = imp_is_given(&values[ROTATIONS]);
    char *const turn = (char *)s->memory + r.path;
    imp_interval *const key = (imp_interval *)(void *)(turn + r.turns);
    s->path = spline_place(SPLINE_CUBIC, keys, 3, turns ? 2 : 0, s->memory);
    s->path.kinked = true;
    s->rotation = turns ? (spin_turn *)(void *)turn : NULL;
    keep_given(s, values, (double *)(void *)(key + 3 * keys));
    return set_path(s, values, key, why);
}

static imp_status trajectory_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    const room r = room_for(values[TIMES].count);
    trajectory_instance *s = malloc(sizeof *s + r.path + r.turns + r.numbers);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    status = fill(s, values, why);
    if (status == IMP_STATUS_OK)
        *self = s;
    else
        free(s);
    return status;
}

static imp_status trajectory_renew(void *self, const imp_value *values, imp_create_error *why)
{
    trajectory_instance *s = self;
    const imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    return values[TIMES].count == s->path.pieces + 1 ? fill(s, values, why) : IMP_STATUS_UNBOUNDED;
}

/* --- The map ---------------------------------------------------------------------------------- */

static void trajectory_time_domain(const void *self, double *lo, double *hi)
{
    const trajectory_instance *s = self;
    *lo = s->path.time[0];
    *hi = s->path.time[s->path.pieces];
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
        spin_matrix(&s->rotation[span.at], s->path.time[span.at], t, node[s->path.width - 2].hi, r);
        spin_apply(r, w, out);
    } else if (s->rotation != NULL) {
        spin_across(s->rotation, &s->path, &span, node, t, w, out);
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
        if (!is_inside(self, p[4 * k + 3], p[4 * k + 3])) return IMP_STATUS_DOMAIN;
    return trajectory_formula_eval(self, n, p, x, error);
}

static imp_status trajectory_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    if (!is_inside(self, box->lo[3], box->hi[3])) return IMP_STATUS_DOMAIN;
    return trajectory_formula_rate(self, box, rates);
}

static imp_status trajectory_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    if (!is_inside(self, in[3].lo, in[3].hi)) return IMP_STATUS_DOMAIN;
    return trajectory_formula_apply(self, in, out);
}

/* Over times of one piece. The matrix is Q + E, Q a rotation and no entry of E above SPIN_MISMATCH,
 * of which (Q + E)^T (Q + E) - 1 = Q^T E + E^T Q + E^T E; an entry of Q^T E is at most sqrt(3)
 * SPIN_MISMATCH. So the whole is below 4 SPIN_MISMATCH, and IMP_RIGID_SLACK is 15 SPIN_MISMATCH. */
static imp_status trajectory_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    const trajectory_instance *s = self;
    imp_interval node[SPLINE_WIDTH_MAX];
    if (!is_inside(s, t->lo, t->hi)) return IMP_STATUS_DOMAIN;
    const imp_series around = imp_series_around(imp_model_range(t));
    const spline_span span = spline_span_of(&s->path, t->lo, around.m, t->hi);
    if (s->rotation != NULL && span.first != span.last) return IMP_STATUS_UNBOUNDED;
    imp_pose_at_rest(pose);
    spline_models(&s->path, *t, pose->shift, node);
    memcpy(pose->pivot, s->center, sizeof pose->pivot);
    if (s->rotation != NULL)
        spin_matrix(&s->rotation[span.at], s->path.time[span.at], *t, node[s->path.width - 2].hi,
                    pose->turn);
    return imp_pose_status(pose);
}

/* --- As text ---------------------------------------------------------------------------------- */

/* Where the center is, c0 ... c2, by the positions a and b of both keys. */
static void write_position(const trajectory_instance *s, size_t piece, const imp_text_sink *to)
{
    keys_define(to, "a", s->positions + 3 * piece, 3);
    keys_define(to, "b", s->positions + 3 * piece + 3, 3);
    if (s->accelerations == NULL) {
        imp_add_text(to, "c0 = a0 + (b0 - a0)*s/h; c1 = a1 + (b1 - a1)*s/h; "
                         "c2 = a2 + (b2 - a2)*s/h; ");
        return;
    }
    keys_define(to, "g", s->accelerations + 3 * piece, 3);
    imp_add_text(to, "c0 = a0 + (b0 - a0)*s/h - g0/2*s*(h - s); "
                     "c1 = a1 + (b1 - a1)*s/h - g1/2*s*(h - s); "
                     "c2 = a2 + (b2 - a2)*s/h - g2/2*s*(h - s); ");
}

static imp_status trajectory_write_formula(const void *self, const imp_text_sink *to)
{
    const trajectory_instance *s = self;
    for (size_t k = 0; k < s->path.pieces; ++k) {
        if (k > 0) imp_add_text(to, "| ");
        imp_add_range(to, "t", s->path.time[k], s->path.time[k + 1]);
        imp_define(to, "t0", s->path.time[k]);
        imp_define(to, "t1", s->path.time[k + 1]);
        imp_add_text(to, "h = t1 - t0; s = t - t0; w0 = x - center0; w1 = y - center1; "
                         "w2 = z - center2; ");
        write_position(s, k, to);
        if (s->rotations != NULL)
            spin_write(s->spins + 3 * k, s->rotations + 4 * k, s->rotations + 4 * k + 4, to);
        imp_add_text(to, s->rotations != NULL ? "c0 + r0; c1 + r1; c2 + r2"
                                              : "c0 + w0; c1 + w1; c2 + w2");
    }
    return IMP_STATUS_OK;
}

static const imp_map_type trajectory = {
    IMP_MAP_FIELDS(trajectory, trajectory),
    .renew = trajectory_renew,
    .rigid = trajectory_rigid,
    .write_formula = trajectory_write_formula,
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
