/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/nurbs_surface.h"
#include "plugins/patch/parameters.h"
#include "plugins/patch/patch_text.h"

#include <impinge/plugin.h>
#include <stdlib.h>
#include <string.h>

/* A plane curve moved along a vector: its control points, and these plus the vector, rounded to
 * doubles, are those of a NURBS surface of degree 1 along v. Ends are two more pieces, between the
 * curve and a point from which all of it is seen. */

enum { PROFILE, DEGREE, KNOTS, WEIGHTS, VECTOR, ENDS, CENTER };

/* So that sums stay within the limits of patch.h. */
#define EXTRUSION_FAR 1e99

static const imp_parameter parameters[] = {
    [PROFILE] =
        IMP_ROW("profile", "length", "[[1,0],[0.5,1],[-1,1],[-1,-1],[0.5,-1],[1,0]]", 0, 2, 0, 2,
                -EXTRUSION_FAR, EXTRUSION_FAR,
                "control points [x,y] of the curve; counter-clockwise: u cross v is outward"),
    [DEGREE] = IMP_ROW_OF(
        IMP_KIND_INTEGER, "degree", "1", NULL, IMP_PARAMETER_OPTIONAL, 0, 0, 0, 1, PATCH_DEGREE_MAX,
        "of a B-spline; left out: a Bezier curve, of one less than it has points"),
    [KNOTS] =
        IMP_ROW("knots", "1", NULL, IMP_PARAMETER_OPTIONAL, 1, 0, 0, -KNOT_FAR, KNOT_FAR,
                "of a B-spline, as many as points and degree and 1; left out: 0, ..., 0, 1, 2, "
                "..., so that it goes from the first point to the last"),
    [WEIGHTS] = ROW_PATCH_WEIGHTS("weights", "one per point, for a rational curve; default: all 1"),
    [VECTOR] = IMP_ROW("vector", "length", "[0,0,1]", 0, 1, 3, 0, -EXTRUSION_FAR, EXTRUSION_FAR,
                       "from the curve to the other end; its z is not 0"),
    [ENDS] = IMP_ROW_BOOLEAN("ends", "false", "closed by the two plane areas in the curve"),
    [CENTER] = IMP_ROW("center", "length", NULL, IMP_PARAMETER_OPTIONAL, 1, 2, 0, -EXTRUSION_FAR,
                       EXTRUSION_FAR,
                       "with ends: [x,y] from which all of the curve is seen; default: the mean of "
                       "its points"),
};

enum { LATERAL, LOWER, UPPER, PARTS };

typedef struct extrusion_pieces {
    nurbs_instance part[PARTS]; /* the instance is its first piece */
    size_t count;
} extrusion_pieces;

/* --- What is given ---------------------------------------------------------------------------- */

/* The curve, checked; knots are the parameter's, or made. */
typedef struct outline {
    size_t count;
    int degree;
    const double *profile, *weights; /* weights: NULL where all are 1 */
    double center[2];
    double *knots;
    knot_row row;
} outline;

static imp_status read_degree(const imp_value *values, outline *o, imp_create_error *why)
{
    const bool is_bezier = !imp_is_given(&values[DEGREE]);
    if (o->count < 2)
        return imp_reject(why, PROFILE, -1, "got %zu points, must be 2 or more", o->count);
    if (is_bezier && imp_is_given(&values[KNOTS]))
        return imp_reject(why, KNOTS, -1, "given without degree, which a B-spline has");
    if (is_bezier && o->count > PATCH_SIDE_MAX)
        return imp_reject(why, PROFILE, -1,
                          "got %zu points, must be at most %d of a Bezier curve; give degree for a "
                          "B-spline",
                          o->count, PATCH_SIDE_MAX);
    o->degree = is_bezier ? (int)o->count - 1 : (int)values[DEGREE].number[0];
    if (o->count > (size_t)o->degree) return IMP_STATUS_OK;
    return imp_reject(why, PROFILE, -1, "got %zu points, must be more than the degree, %d",
                      o->count, o->degree);
}

/* 0 and the last are there degree + 1 times, so that the curve begins and ends at its points. */
static imp_status read_knots(const imp_value *values, outline *o, imp_create_error *why)
{
    const size_t p = (size_t)o->degree, length = o->count + p + 1;
    o->knots = malloc(length * sizeof *o->knots);
    if (o->knots == NULL) return IMP_STATUS_INTERNAL;
    for (size_t k = 0; k < length; ++k)
        o->knots[k] = k <= p ? 0 : k < o->count ? (double)(k - p) : (double)(o->count - p);
    o->row = (knot_row){o->knots, length, PROFILE, -1};
    if (!imp_is_given(&values[KNOTS])) return IMP_STATUS_OK;
    if (values[KNOTS].count != length)
        return imp_reject(why, KNOTS, -1, "got %zu, but %zu points of degree %d have %zu",
                          values[KNOTS].count, o->count, o->degree, length);
    memcpy(o->knots, values[KNOTS].number, length * sizeof *o->knots);
    o->row.parameter = KNOTS;
    return knots_check(&o->row, o->degree, why);
}

static imp_status read_outline(const imp_value *values, outline *o, imp_create_error *why)
{
    *o = (outline){.count = values[PROFILE].extent[0], .profile = values[PROFILE].number};
    imp_status status = read_degree(values, o, why);
    if (status == IMP_STATUS_OK) status = read_knots(values, o, why);
    if (status != IMP_STATUS_OK) return status;
    if (values[VECTOR].number[2] == 0)
        return imp_reject(why, VECTOR, 2, "is 0, must lead out of the plane of the curve");
    if (!imp_is_given(&values[WEIGHTS])) return IMP_STATUS_OK;
    o->weights = values[WEIGHTS].number;
    if (values[WEIGHTS].count == o->count) return IMP_STATUS_OK;
    return imp_reject(why, WEIGHTS, -1, "got %zu, must be one for each of the %zu points",
                      values[WEIGHTS].count, o->count);
}

/* --- Ends ------------------------------------------------------------------------------------- */

/* Numerators of the curve less the center, of one span, as a Bezier curve. */
typedef struct arc {
    int degree;
    double x[PATCH_SIDE_MAX], y[PATCH_SIDE_MAX];
} arc;

static void make_arc(const outline *o, const knots *k, size_t span, arc *a)
{
    double matrix[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    const size_t side = (size_t)o->degree + 1, first = k->last[span] - (size_t)o->degree;
    knots_extract(k, span, matrix);
    a->degree = o->degree;
    for (size_t i = 0; i < side; ++i) {
        a->x[i] = a->y[i] = 0;
        for (size_t j = 0; j < side; ++j) {
            const double *at = o->profile + 2 * (first + j);
            const double w =
                matrix[i * side + j] * (o->weights != NULL ? o->weights[first + j] : 1);
            a->x[i] += w * (at[0] - o->center[0]);
            a->y[i] += w * (at[1] - o->center[1]);
        }
    }
}

/* n over k */
static double choose(int n, int k)
{
    double c = 1;
    for (int i = 0; i < k; ++i) c = c * (n - i) / (i + 1);
    return c;
}

/* The least and greatest Bernstein coefficient of X x X', whose sign is that in which the curve
 * turns about the center. */
static void turn_of(const arc *a, double *least, double *greatest)
{
    const int n = a->degree;
    for (int k = 0; k < 2 * n; ++k) {
        double sum = 0;
        for (int i = k < n ? 0 : k - n + 1; i <= n && i <= k; ++i) {
            const int j = k - i;
            const double turn =
                a->x[i] * (a->y[j + 1] - a->y[j]) - a->y[i] * (a->x[j + 1] - a->x[j]);
            sum += choose(n, i) * choose(n - 1, j) / choose(2 * n - 1, k) * turn;
        }
        if (!(sum >= *least)) *least = sum;
        if (!(sum <= *greatest)) *greatest = sum;
    }
}

#define NEARLY 0x1p-40 /* part of the greatest turn that rounding may have the wrong sign of */

/* The curve returns to where it begins, and is seen from the center without overlap: then the ends
 * are the areas in it. The coefficients tell so; where they do not, the curve may still be seen. */
static imp_status check_ends(const outline *o, const knots *k, imp_create_error *why)
{
    const double *first = o->profile, *last = o->profile + 2 * (o->count - 1);
    const double *at = o->row.number;
    const size_t p = (size_t)o->degree;
    double least = INFINITY, greatest = -INFINITY;
    if (!(at[0] == at[p] && at[o->count] == at[o->count + p]))
        return imp_reject(why, KNOTS, -1,
                          "must be there degree + 1 times at either end, with ends");
    if (first[0] != last[0] || first[1] != last[1])
        return imp_reject(why, PROFILE, -1,
                          "ends at [%g,%g], must end at its first point, [%g,%g], with ends",
                          last[0], last[1], first[0], first[1]);
    for (size_t span = 0; span < k->spans; ++span) {
        arc a;
        make_arc(o, k, span, &a);
        turn_of(&a, &least, &greatest);
    }
    const double room = NEARLY * (greatest > -least ? greatest : -least);
    if (least >= -room || greatest <= room) return IMP_STATUS_OK;
    return imp_reject(why, CENTER, -1,
                      "the curve is not seen to turn one way about [%g,%g], must be a point in it "
                      "from which all of it is seen; or take a mesh for the ends",
                      o->center[0], o->center[1]);
}

static void take_center(const imp_value *values, outline *o)
{
    for (size_t i = 0; i < 2; ++i) {
        double sum = 0;
        for (size_t k = 1; k < o->count; ++k) sum += o->profile[2 * k + i] / (double)(o->count - 1);
        o->center[i] = imp_is_given(&values[CENTER]) ? values[CENTER].number[i] : sum;
    }
}

/* --- Pieces ----------------------------------------------------------------------------------- */

static const double along_v[] = {0, 0, 1, 1};

static void put(double *to, const double at[2], const double *vector)
{
    to[0] = at[0] + (vector != NULL ? vector[0] : 0);
    to[1] = at[1] + (vector != NULL ? vector[1] : 0);
    to[2] = vector != NULL ? vector[2] : 0;
}

/* Ends lie between the curve and the center, in the order that makes f_u x f_v point outward where
 * the curve runs counter-clockwise. */
static imp_status make_piece(extrusion_pieces *s, int part, const outline *o, const double *vector,
                             imp_create_error *why)
{
    double *points = malloc(6 * o->count * sizeof *points), bytes = 0;
    double *weights = malloc(2 * o->count * sizeof *weights);
    for (size_t k = 0; points != NULL && weights != NULL && k < o->count; ++k) {
        const double *at = o->profile + 2 * k;
        put(points + 6 * k, part == LOWER ? o->center : at, part == UPPER ? vector : NULL);
        put(points + 6 * k + 3, part == UPPER ? o->center : at, part == LOWER ? NULL : vector);
        weights[2 * k] = weights[2 * k + 1] = o->weights != NULL ? o->weights[k] : 1;
    }
    const nurbs_data data = {.degree = {o->degree, 1},
                             .knots = {o->row, {along_v, 4, PROFILE, -1}},
                             .points = points,
                             .weights = weights};
    const bool made =
        points != NULL && weights != NULL && nurbs_make(&s->part[part], &data, &bytes);
    s->count += 1;
    free(points);
    free(weights);
    if (made) return IMP_STATUS_OK;
    return bytes > NURBS_CELLS_MAX
               ? imp_reject(why, PROFILE, -1, "would take %.0f MiB, must be at most %.0f MiB",
                            ceil(bytes * 0x1p-20), NURBS_CELLS_MAX * 0x1p-20)
               : IMP_STATUS_INTERNAL;
}

static void extrusion_destroy(void *self)
{
    extrusion_pieces *s = self;
    for (size_t k = 0; s != NULL && k < s->count; ++k) nurbs_clear(&s->part[k]);
    free(s);
}

static imp_status make_pieces(extrusion_pieces *s, const imp_value *values, outline *o,
                              imp_create_error *why)
{
    imp_status status = make_piece(s, LATERAL, o, values[VECTOR].number, why);
    if (status != IMP_STATUS_OK || values[ENDS].number[0] == 0) return status;
    take_center(values, o);
    status = check_ends(o, &s->part[LATERAL].side[0], why);
    for (int part = LOWER; part < PARTS && status == IMP_STATUS_OK; ++part)
        status = make_piece(s, part, o, values[VECTOR].number, why);
    return status;
}

static imp_status extrusion_create(const imp_value *values, void **self, imp_create_error *why)
{
    outline o;
    extrusion_pieces *s = NULL;
    imp_status status = read_outline(values, &o, why);
    if (status == IMP_STATUS_OK) s = calloc(1, sizeof *s);
    if (status == IMP_STATUS_OK)
        status = s != NULL ? make_pieces(s, values, &o, why) : IMP_STATUS_INTERNAL;
    free(o.knots);
    if (status == IMP_STATUS_OK)
        *self = s;
    else
        extrusion_destroy(s);
    return status;
}

static size_t extrusion_piece_count(const void *self)
{
    return ((const extrusion_pieces *)self)->count;
}

static const void *extrusion_piece(const void *self, size_t k)
{
    return &((const extrusion_pieces *)self)->part[k];
}

static imp_status extrusion_write_formula(const void *self, const imp_text_sink *to)
{
    nurbs_write(self, to);
    return IMP_STATUS_OK;
}

static const imp_surface_type extrusion = {
    IMP_TYPE_FIELDS(imp_surface_type, "extrusion", extrusion, extrusion_destroy),
    .domain = nurbs_domain,
    .eval = nurbs_eval,
    .rate = nurbs_rate,
    .include = nurbs_include,
    .net = nurbs_net,
    .piece_count = extrusion_piece_count,
    .piece = extrusion_piece,
    .write_formula = extrusion_write_formula,
    .summary = "plane Bezier or B-spline curve moved along a vector, with ends=true closed",
    .equation = "c(u) + v vector, c = sum_i N_i(u) w_i profile_i / sum_i N_i(u) w_i, N: B-splines "
                "over the knots, from 0 to the number of spans (a Bezier curve: 1), v in [0,1]; "
                "ends: center + v (c(u) - center), c(u) + vector + v (center - c(u))",
    .source = NULL,
    .example =
        "extrusion profile=[[1,0],[1,2],[-1,2],[-1,0],[1,0]] degree=2 vector=0,0,3 ends=true",
};

PUBLISH_SURFACE(extrusion);
