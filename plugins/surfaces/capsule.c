/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/frame.h"
#include "plugins/common/publish.h"
#include "plugins/common/squares.h"

/* All points at one distance from a segment: the lateral surface of a cylinder and two half
 * spheres, as pieces. f_u x f_v points outward on each. */

enum { RADIUS, FROM, TO };

static const imp_parameter parameters[] = {
    [RADIUS] = IMP_ROW_POSITIVE("radius", "length", "0.5", "distance from the segment"),
    [FROM] = IMP_ROW("from", "length", "[0,0,-1]", 0, 1, 3, 0, -AXIS_MAX, AXIS_MAX,
                     "where the segment begins"),
    [TO] = IMP_ROW("to", "length", "[0,0,1]", 0, 1, 3, 0, -AXIS_MAX, AXIS_MAX,
                   "where the segment ends; the same point: a sphere"),
};

enum { LATERAL, AT_FROM, AT_TO, PARTS };

/* What the callbacks get as `self`: one piece. */
typedef struct capsule_instance {
    double radius, end[3];  /* of the lateral surface: where it begins; else the middle */
    near_constant along[3]; /* to - from */
    frame frame;            /* along the segment */
    int part;
    bool is_exact; /* to - from is known exactly */
} capsule_instance;

typedef struct capsule_pieces {
    capsule_instance part[PARTS]; /* the instance is its first piece */
} capsule_pieces;

/* x - y. Lemma (Knuth's sum of two): the rounding of d = x - y is (x - (d - b)) - (y + b), b = d -
 * x, exactly; where that is 0, so is the error. */
static imp_model difference_of(double x, double y)
{
    const double d = x - y, b = d - x, rounding = (x - (d - b)) - (y + b);
    return rounding == 0 ? imp_num(d) : imp_known(d, imp_round_up(fabs(rounding)));
}

/* to - from with its rounding; a segment that is a point has the frame of z. */
static imp_status measure(const imp_value *values, capsule_instance *s, imp_create_error *why)
{
    imp_model along[3];
    double greatest = 0;
    s->is_exact = true;
    for (int i = 0; i < 3; ++i) {
        const double from = values[FROM].number[i], to = values[TO].number[i];
        along[i] = difference_of(to, from);
        s->is_exact = s->is_exact && along[i].e == 0;
        s->along[i] = near_of(along[i]);
        greatest = imp_larger(greatest, fabs(along[i].a));
    }
    if (greatest == 0)
        for (int i = 0; i < 3; ++i) along[i] = imp_num(i == 2);
    else if (greatest < AXIS_MIN)
        return imp_reject(why, TO, -1, "is %g from `from`, must be %g or more, or the same point",
                          greatest, AXIS_MIN);
    s->frame = frame_about(along);
    return IMP_STATUS_OK;
}

static imp_status capsule_fill(capsule_pieces *pieces, const imp_value *values,
                               imp_create_error *why)
{
    capsule_instance whole = {.radius = values[RADIUS].number[0]};
    const imp_status status = measure(values, &whole, why);
    if (status != IMP_STATUS_OK) return status;
    for (int k = 0; k < PARTS; ++k) {
        pieces->part[k] = whole;
        pieces->part[k].part = k;
        imp_copy_vector(pieces->part[k].end, &values[k == AT_TO ? TO : FROM]);
    }
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(capsule, capsule_pieces)

static size_t capsule_piece_count(const void *self)
{
    (void)self;
    return PARTS;
}

static const void *capsule_piece(const void *self, size_t k)
{
    return &((const capsule_pieces *)self)->part[k];
}

static void capsule_domain(const void *self, double lo[3], double hi[3])
{
    const capsule_instance *s = self;
    const double from = s->part == AT_FROM ? -IMP_HALF_PI_UPPER : 0;
    const double to = s->part == AT_FROM ? 0 : s->part == AT_TO ? IMP_HALF_PI_UPPER : 1;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, from, to);
}

static void capsule_formula(const void *self, imp_model u, imp_model v, imp_model t,
                            imp_model out[3])
{
    const capsule_instance *s = self;
    imp_model sin_v = imp_num(0), cos_v = imp_num(1);
    const bool lateral = s->part == LATERAL;
    (void)t;
    if (!lateral) imp_sincos(v, &sin_v, &cos_v);
    frame_ring(&s->frame, imp_scale(cos_v, s->radius), u, out);
    const imp_model up = lateral ? v : imp_scale(sin_v, s->radius);
    for (int i = 0; i < 3; ++i)
        out[i] = imp_add(out[i], near_scale(up, lateral ? s->along[i] : s->frame.k[i]));
    axis_add_center(s->end, out);
}
IMP_SURFACE_FORMULA(capsule_formula)

/* The distance from the whole sphere, or from the endless cylinder, which hold the piece. */
static imp_model capsule_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const capsule_instance *s = self;
    imp_model m[3];
    (void)t;
    axis_from_center(s->end, x, y, z, m);
    return beyond_radius(
        s->part == LATERAL ? frame_across_squared(&s->frame, m) : sum_of_squares(m, 3), s->radius);
}
IMP_DISTANCE_FORMULA(capsule_gap)

/* Sets the axis of a symmetry, which must be exact. False: to - from is rounded, or too long. */
static bool set_axis(const capsule_instance *s, double axis[3])
{
    double greatest = 0;
    for (int i = 0; i < 3; ++i) {
        axis[i] = s->along[i].value;
        greatest = imp_larger(greatest, fabs(axis[i]));
    }
    if (greatest == 0) axis[2] = 1;
    return s->is_exact && greatest <= AXIS_MAX;
}

/* A half sphere turned about its middle is not itself, but about the axis it is. */
static imp_status capsule_symmetry(const void *self, imp_symmetry *symmetry)
{
    const capsule_instance *s = self;
    const bool has_axis = set_axis(s, symmetry->axis);
    memcpy(symmetry->center, s->end, sizeof s->end);
    if (s->part == LATERAL) {
        symmetry->kind = IMP_SYMMETRY_ALONG_LINE;
        symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
        return has_axis ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
    }
    symmetry->kind = IMP_SYMMETRY_ABOUT_POINT;
    symmetry->is_closed = IMP_SYMMETRY_ORBIT_ALL;
    if (has_axis) symmetry->is_closed |= IMP_SYMMETRY_ORBIT_U | IMP_SYMMETRY_ZONE;
    return IMP_STATUS_OK;
}

static imp_status capsule_write_formula(const void *self, const imp_text_sink *to)
{
    static const char *const text[PARTS] = {
        [LATERAL] = "v in [0, 1]; from0 + w0*v + radius*x0; from1 + w1*v + radius*x1; from2 + "
                    "w2*v + radius*x2",
        [AT_FROM] = "v in [-pi/2, 0]; from0 + radius*(cos(v)*x0 + sin(v)*k0); from1 + "
                    "radius*(cos(v)*x1 + sin(v)*k1); from2 + radius*(cos(v)*x2 + sin(v)*k2)",
        [AT_TO] = "v in [0, pi/2]; to0 + radius*(cos(v)*x0 + sin(v)*k0); to1 + "
                  "radius*(cos(v)*x1 + sin(v)*k1); to2 + radius*(cos(v)*x2 + sin(v)*k2)"};
    const capsule_instance *s = self;
    imp_add_text(to, "w0 = to0 - from0; w1 = to1 - from1; w2 = to2 - from2; ");
    frame_write(&s->frame, to);
    imp_add_text(to, "x0 = a0*cos(u) + b0*sin(u); x1 = a1*cos(u) + b1*sin(u); "
                     "x2 = a2*cos(u) + b2*sin(u); u in [0, 2*pi]; ");
    imp_add_text(to, text[s->part]);
    return IMP_STATUS_OK;
}

static const imp_surface_type capsule = {
    IMP_SURFACE_FIELDS(capsule, capsule_formula),
    .renew = capsule_renew,
    .piece_count = capsule_piece_count,
    .piece = capsule_piece,
    .distance = capsule_gap_distance,
    .symmetry = capsule_symmetry,
    .write_formula = capsule_write_formula,
    .summary =
        "all points at one distance from a segment: a cylinder with half spheres at its ends",
    .equation = "from + v (to - from) + radius (a cos u + b sin u), v in [0,1]; from, then to, + "
                "radius (cos v (a cos u + b sin u) + k sin v), v in [-pi/2,0], then [0,pi/2]; u in "
                "[0,2pi], k along to - from, a, b across; a = x, b = y for the axis z; pieces: 0 "
                "lateral surface, 1 half sphere at from, 2 half sphere at to",
    .source = NULL,
    .example = "capsule radius=0.2 from=0,0,0 to=1,0,1",
};

PUBLISH_SURFACE(capsule);
