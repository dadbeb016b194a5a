/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/keys.h"
#include "plugins/common/publish.h"
#include "plugins/common/quaternion.h"
#include "plugins/common/spline.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* Positions and orientations at given times
 * =========================================
 * Seven lanes of one spline (spline.h): the position, and a quaternion that turns (quaternion.h).
 */

enum { TIMES, POSITIONS, ROTATIONS, HOLD };

static const imp_parameter parameters[] = {
    [TIMES] =
        IMP_ROW_NUMBERS("times", "time", NULL, 0,
                        "of the keys, increasing, two or more; unless 'hold' is true, the map "
                        "is defined from the first to the last only"),
    [POSITIONS] = IMP_ROW_VECTORS("positions", "length", NULL, 3, IMP_PARAMETER_OPTIONAL,
                                  "where each key moves the origin to; default: no translation"),
    [ROTATIONS] = IMP_ROW_VECTORS(
        "rotations", "1", NULL, 4, IMP_PARAMETER_OPTIONAL,
        "rotation of each key about the origin, before the translation: a unit quaternion "
        "[w,x,y,z]; normalized if its length is within 1e-6 of 1; at most 170 degrees from the "
        "key before"),
    [HOLD] = IMP_ROW_BOOLEAN(
        "hold", "false",
        "whether the first key holds before its time, and the last key after its time"),
};

enum { LANES_MAX = 7 };

typedef struct keyframes_instance {
    size_t position, rotation;           /* number of lanes of either: 3 or 0, 4 or 0 */
    bool hold;                           /* defined at all times: held at both ends */
    imp_interval square;                 /* range of |q|^2 */
    const double *positions, *rotations; /* as given; NULL: none */
    spline path; /* one further column if there are rotations: angular speed */
    imp_interval memory[];
} keyframes_instance;

/* --- Checks ----------------------------------------------------------------------------------- */

static imp_status check(const imp_value *values, imp_create_error *why)
{
    imp_status status = keys_check_times(TIMES, &values[TIMES], why);
    if (!imp_is_given(&values[POSITIONS]) && !imp_is_given(&values[ROTATIONS]))
        return imp_reject(why, -1, -1,
                          "neither positions nor rotations are given; one of them is required");
    if (status == IMP_STATUS_OK)
        status = keys_check_count(parameters, values, POSITIONS, values[TIMES].count, why);
    if (status == IMP_STATUS_OK)
        status = keys_check_count(parameters, values, ROTATIONS, values[TIMES].count, why);
    if (status == IMP_STATUS_OK) status = keys_check_rotations(ROTATIONS, &values[ROTATIONS], why);
    if (status == IMP_STATUS_OK) status = quaternion_keys_check(ROTATIONS, &values[ROTATIONS], why);
    return status;
}

/* --- Making one ------------------------------------------------------------------------------- */

static void set_positions(const imp_value *positions, size_t lanes, imp_interval *key)
{
    for (size_t i = 0; i < positions->extent[0]; ++i)
        for (size_t j = 0; j < 3; ++j) {
            double x = positions->number[3 * i + j];
            key[lanes * i + j] = imp_interval_make(x, x);
        }
}

enum { PARTS = 16 };

/* |q|^2 and the angular speed over a part of a piece. The speed is 2 |q'_across| / |q|, where
 * q'_across is the part of q' perpendicular to q; so it is at most 2 |q'| / |q|. */
static void bound_part(const keyframes_instance *s, size_t piece, int part, imp_interval *square,
                       imp_interval *speed)
{
    const double m = (part + 0.5) / PARTS, r = 0.5 / PARTS;
    const imp_interval at = imp_interval_make(m, m), around = imp_interval_make(-r, r);
    const imp_interval reach = imp_interval_mul(around, spline_step(&s->path, piece, piece + 1));
    imp_interval slopes = imp_interval_make(0, 0);
    *square = slopes;
    for (size_t j = 0; j < 4; ++j) {
        const imp_interval *term[3];
        for (int k = 0; k < 3; ++k) term[k] = spline_term(&s->path, piece, s->position + j, k);
        imp_interval rise = imp_interval_scale(spline_hull(term[2][0], term[2][1]), 2);
        imp_interval slope =
            imp_interval_add(spline_at(term[1], 3, at), imp_interval_mul(rise, reach));
        imp_interval value =
            imp_interval_add(spline_at(term[0], 4, at), imp_interval_mul(slope, reach));
        *square = imp_interval_add(*square, imp_interval_sqr(value));
        slopes = imp_interval_add(slopes, imp_interval_sqr(slope));
    }
    *speed = imp_interval_scale(imp_interval_sqrt(imp_interval_div(slopes, *square)), 2);
}

/* Bounds |q|^2 and the angular speed over the whole piece. False: the speed is not finite. */
static bool bound_piece(keyframes_instance *s, size_t piece)
{
    const spline *path = &s->path;
    imp_interval *speed = spline_node(path, path->pieces + piece) + path->width - 1;
    *speed = imp_interval_make(0, 0);
    for (int k = 0; k < PARTS; ++k) {
        imp_interval square, part;
        bound_part(s, piece, k, &square, &part);
        s->square = spline_hull(s->square, square);
        *speed = spline_hull(*speed, part);
    }
    return imp_interval_is_finite(*speed);
}

/* Returns the index of the first invalid piece; `pieces` if all are valid. */
static size_t set_path(keyframes_instance *s, const imp_value *values, imp_interval *keys)
{
    const size_t lanes = s->path.lanes;
    size_t piece;
    memcpy(s->path.time, values[TIMES].number, values[TIMES].count * sizeof(double));
    if (s->position) set_positions(&values[POSITIONS], lanes, keys);
    if (s->rotation) quaternion_keys_set(&values[ROTATIONS], lanes, keys + s->position);
    if (!spline_set(&s->path, keys, &piece)) return piece;
    s->square = imp_interval_make(1, 1);
    for (piece = 0; s->rotation && piece < s->path.pieces; ++piece)
        if (!bound_piece(s, piece)) return piece;
    spline_grow(&s->path);
    return s->path.pieces;
}

/* Fills an instance that knows its lanes, and has room for as many keys as the checked values. */
static imp_status fill(keyframes_instance *s, const imp_value *values, imp_create_error *why)
{
    const size_t keys = values[TIMES].count, lanes = s->position + s->rotation;
    const size_t bytes = spline_bytes(SPLINE_CUBIC, keys, lanes, s->rotation > 0);
    double *room = (double *)(void *)((char *)s->memory + bytes);
    s->hold = values[HOLD].number[0] != 0;
    s->path = spline_place(SPLINE_CUBIC, keys, lanes, s->rotation > 0, s->memory);
    s->positions = keys_keep(&values[POSITIONS], &room);
    s->rotations = keys_keep(&values[ROTATIONS], &room);
    const size_t piece = set_path(s, values, (imp_interval *)(void *)room);
    if (piece == keys - 1) return IMP_STATUS_OK;
    return imp_reject(
        why, s->rotation ? ROTATIONS : POSITIONS, (int64_t)piece + 1,
        "too far from the key before for the time between them: speeds are not finite");
}

/* Which lanes the values have. */
static void take_lanes(keyframes_instance *s, const imp_value *values)
{
    s->position = imp_is_given(&values[POSITIONS]) ? 3 : 0;
    s->rotation = imp_is_given(&values[ROTATIONS]) ? 4 : 0;
}

static imp_status keyframes_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check(values, why);
    keyframes_instance lanes_of;
    if (status != IMP_STATUS_OK) return status;
    take_lanes(&lanes_of, values);
    const size_t keys = values[TIMES].count, lanes = lanes_of.position + lanes_of.rotation;
    const size_t bytes = spline_bytes(SPLINE_CUBIC, keys, lanes, lanes_of.rotation > 0);
    const size_t each = sizeof(double) + sizeof(imp_interval); /* as given, and while it is set */
    keyframes_instance *s = malloc(sizeof *s + bytes + keys * lanes * each);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    take_lanes(s, values);
    status = fill(s, values, why);
    if (status == IMP_STATUS_OK)
        *self = s;
    else
        free(s);
    return status;
}

static imp_status keyframes_renew(void *self, const imp_value *values, imp_create_error *why)
{
    keyframes_instance *s = self, lanes_of;
    const imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    take_lanes(&lanes_of, values);
    const bool has_room = lanes_of.position == s->position && lanes_of.rotation == s->rotation &&
                          values[TIMES].count == s->path.pieces + 1;
    return has_room ? fill(s, values, why) : IMP_STATUS_UNBOUNDED;
}

/* --- The map ---------------------------------------------------------------------------------- */

static void keyframes_time_domain(const void *self, double *lo, double *hi)
{
    const keyframes_instance *s = self;
    *lo = s->hold ? -INFINITY : s->path.time[0];
    *hi = s->hold ? INFINITY : s->path.time[s->path.pieces];
}

static void keyframes_span(const void *self, double *lo, double *hi)
{
    const keyframes_instance *s = self;
    *lo = s->path.time[0];
    *hi = s->path.time[s->path.pieces];
}

static void keyframes_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                              imp_model out[3])
{
    const keyframes_instance *s = self;
    const imp_model at[3] = {x, y, z};
    imp_model lane[LANES_MAX], r[3][3];
    imp_interval node[SPLINE_WIDTH_MAX];
    if (s->hold) t = spline_hold(&s->path, t);
    spline_models(&s->path, t, lane, node);
    memcpy(out, at, sizeof at);
    if (s->rotation) {
        quaternion_matrix(lane + s->position, s->square, &t, node[s->path.width - 1].hi, r);
        quaternion_turn(r, at, out);
    }
    if (s->position)
        for (int i = 0; i < 3; ++i) out[i] = imp_add(out[i], lane[i]);
}
IMP_MAP_FORMULA(keyframes_formula)

static bool is_inside(const keyframes_instance *s, double lo, double hi)
{
    return s->hold || (lo >= s->path.time[0] && hi <= s->path.time[s->path.pieces]);
}

static imp_status keyframes_eval(const void *self, size_t n, const double *p, double *x,
                                 double *error)
{
    for (size_t k = 0; k < n; ++k)
        if (!is_inside(self, p[4 * k + 3], p[4 * k + 3])) return IMP_STATUS_DOMAIN;
    return keyframes_formula_eval(self, n, p, x, error);
}

static imp_status keyframes_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    if (!is_inside(self, box->lo[3], box->hi[3])) return IMP_STATUS_DOMAIN;
    return keyframes_formula_rate(self, box, rates);
}

static imp_status keyframes_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    if (!is_inside(self, in[3].lo, in[3].hi)) return IMP_STATUS_DOMAIN;
    return keyframes_formula_apply(self, in, out);
}

static imp_status keyframes_rigid(const void *self, const imp_model *time, imp_pose *pose)
{
    const keyframes_instance *s = self;
    imp_model lane[LANES_MAX], t = *time;
    imp_interval node[SPLINE_WIDTH_MAX];
    if (!is_inside(s, t.lo, t.hi)) return IMP_STATUS_DOMAIN;
    if (s->hold) t = spline_hold(&s->path, t);
    spline_models(&s->path, t, lane, node);
    imp_pose_at_rest(pose);
    if (s->rotation)
        quaternion_matrix(lane + s->position, s->square, &t, node[s->path.width - 1].hi,
                          pose->turn);
    if (s->position) memcpy(pose->shift, lane, sizeof pose->shift);
    return imp_pose_status(pose);
}

/* --- As text ---------------------------------------------------------------------------------- */

/* A key's position, or its quaternion, of unit length and with the sign that it has in the path:
 * that of the interval there, which may hold 0 only where the number is 0. */
static void write_key(const void *of, int order, size_t key, size_t lane, const imp_text_sink *to)
{
    (void)order;
    const keyframes_instance *s = of;
    if (lane < s->position) {
        imp_add_number(to, s->positions[3 * key + lane]);
        return;
    }
    const double *q = s->rotations + 4 * key;
    double sign = 1;
    for (size_t j = 0; j < 4; ++j) {
        const size_t piece = key < s->path.pieces ? key : key - 1;
        const bool begins = key < s->path.pieces;
        const imp_interval there =
            spline_term(&s->path, piece, s->position + j, 0)[begins ? 0 : s->path.degree];
        if (q[j] != 0 && (q[j] > 0) != (there.lo > 0)) sign = -1;
    }
    imp_add_number(to, sign * q[lane - s->position]);
    imp_add_text(to, "/hypot(hypot(");
    for (int j = 0; j < 4; ++j) {
        imp_add_number(to, q[j]);
        imp_add_text(to, j == 1 ? "), hypot(" : j == 3 ? "))" : ", ");
    }
}

/* The path's lanes are named a0 ..., positions first; the quaternion is w, e0, e1, e2. |q| > 0.64
 * by the lemma of quaternion.h, so 0.4 is never reached; intervals of long times know it by this.
 */
static void write_rotation(const keyframes_instance *s, const imp_text_sink *to)
{
    static const char *const name[4] = {"w = a", "e0 = a", "e1 = a", "e2 = a"};
    for (size_t j = 0; j < 4; ++j) {
        imp_add_text(to, name[j]);
        imp_add_whole(to, s->position + j);
        imp_add_text(to, "; ");
    }
    imp_add_text(to,
                 "n = 2/max(0.4, w^2 + e0^2 + e1^2 + e2^2); c0 = e1*z - e2*y; c1 = e2*x - e0*z; "
                 "c2 = e0*y - e1*x; r0 = x + n*(w*c0 + e1*c2 - e2*c1); "
                 "r1 = y + n*(w*c1 + e2*c0 - e0*c2); r2 = z + n*(w*c2 + e0*c1 - e1*c0); ");
}

static imp_status keyframes_write_formula(const void *self, const imp_text_sink *to)
{
    const keyframes_instance *s = self;
    const spline_text text = {&s->path, s->hold, 0, "a", write_key, s};
    for (size_t k = 0; k < s->path.pieces; ++k) {
        if (k > 0) imp_add_text(to, "| ");
        spline_write_part(&text, k, to);
        if (s->rotation > 0) write_rotation(s, to);
        imp_add_text(to, s->rotation == 0   ? "x + a0; y + a1; z + a2"
                         : s->position == 0 ? "r0; r1; r2"
                                            : "r0 + a0; r1 + a1; r2 + a2");
    }
    return IMP_STATUS_OK;
}

static const imp_map_type keyframes = {
    IMP_MAP_FIELDS(keyframes, keyframes),
    .flags = IMP_FLAG_TURNS_EXACTLY,
    .renew = keyframes_renew,
    .rigid = keyframes_rigid,
    .span = keyframes_span,
    .write_formula = keyframes_write_formula,
    .summary = "moves and turns smoothly through positions and orientations at given times",
    .equation =
        "R(q) (x,y,z) + p; p and q are cubics between keys, with the slope at each key from the "
        "one before to the one after, and parabolas at both ends; q has keys "
        "rotations/|rotations|, with signs that keep neighbours near, and R(q) is the "
        "rotation of q/|q|; with hold, t is the nearest time of the keys",
    .source = "Catmull and Rom, A Class of Local Interpolating Splines, 1974",
    .example = "keyframes times=0,0.5,1 positions=[[0,0,0],[1,0,0],[1,1,0]] "
               "rotations=[[1,0,0,0],[0.8,0.6,0,0],[0.8,0,0.6,0]]",
};

PUBLISH_MAP(keyframes);
