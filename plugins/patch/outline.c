/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/outline.h"

#include "plugins/patch/patch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Part of the greatest turn that rounding may have the wrong sign of; and part of the greatest
 * coordinate by which the last point of a closed curve may miss the first. */
#define NEARLY 0x1p-40

/* --- What is given ---------------------------------------------------------------------------- */

static imp_status read_degree(const imp_value *values, outline *o, imp_create_error *why)
{
    const bool is_bezier = !imp_is_given(&values[OUTLINE_DEGREE]);
    if (o->count < 2)
        return imp_reject(why, OUTLINE_PROFILE, -1, "got %zu points, must be 2 or more", o->count);
    if (is_bezier && imp_is_given(&values[OUTLINE_KNOTS]))
        return imp_reject(why, OUTLINE_KNOTS, -1, "given without degree, which a B-spline has");
    if (is_bezier && o->count > PATCH_SIDE_MAX)
        return imp_reject(why, OUTLINE_PROFILE, -1,
                          "got %zu points, must be at most %d of a Bezier curve; give degree for a "
                          "B-spline",
                          o->count, PATCH_SIDE_MAX);
    o->degree = is_bezier ? (int)o->count - 1 : (int)values[OUTLINE_DEGREE].number[0];
    if (o->count > (size_t)o->degree) return IMP_STATUS_OK;
    return imp_reject(why, OUTLINE_PROFILE, -1, "got %zu points, must be more than the degree, %d",
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
    o->row = (knot_row){o->knots, length, OUTLINE_PROFILE, -1};
    if (!imp_is_given(&values[OUTLINE_KNOTS])) return IMP_STATUS_OK;
    if (values[OUTLINE_KNOTS].count != length)
        return imp_reject(why, OUTLINE_KNOTS, -1, "got %zu, but %zu points of degree %d have %zu",
                          values[OUTLINE_KNOTS].count, o->count, o->degree, length);
    memcpy(o->knots, values[OUTLINE_KNOTS].number, length * sizeof *o->knots);
    o->row.parameter = OUTLINE_KNOTS;
    return knots_check(&o->row, o->degree, why);
}

/* Lemma. |p - q| <= NEARLY * size, so the curve, a mean of its points, moves by no more. Users who
 * compute the last point, as by the cosine of 2 pi, mean the first. */
static imp_status join_profile(outline *o)
{
    const size_t last = 2 * (o->count - 1);
    double size = 0, apart = 0;
    for (size_t k = 0; k < 2 * o->count; ++k) size = fmax(size, fabs(o->profile[k]));
    for (size_t i = 0; i < 2; ++i) apart = fmax(apart, fabs(o->profile[last + i] - o->profile[i]));
    if (apart == 0 || apart > NEARLY * size) return IMP_STATUS_OK;
    o->joined = malloc(2 * o->count * sizeof *o->joined);
    if (o->joined == NULL) return IMP_STATUS_INTERNAL;
    memcpy(o->joined, o->profile, 2 * o->count * sizeof *o->joined);
    memcpy(o->joined + last, o->profile, 2 * sizeof *o->joined);
    o->profile = o->joined;
    return IMP_STATUS_OK;
}

imp_status outline_read(const imp_value *values, outline *o, imp_create_error *why)
{
    *o = (outline){.count = values[OUTLINE_PROFILE].extent[0],
                   .profile = values[OUTLINE_PROFILE].number};
    imp_status status = read_degree(values, o, why);
    if (status == IMP_STATUS_OK) status = read_knots(values, o, why);
    if (status == IMP_STATUS_OK && values[OUTLINE_ENDS].number[0] != 0) status = join_profile(o);
    if (status != IMP_STATUS_OK) return status;
    if (values[OUTLINE_VECTOR].number[2] == 0)
        return imp_reject(why, OUTLINE_VECTOR, 2, "is 0, must lead out of the plane of the curve");
    if (!imp_is_given(&values[OUTLINE_WEIGHTS])) return IMP_STATUS_OK;
    o->weights = values[OUTLINE_WEIGHTS].number;
    if (values[OUTLINE_WEIGHTS].count == o->count) return IMP_STATUS_OK;
    return imp_reject(why, OUTLINE_WEIGHTS, -1, "got %zu, must be one for each of the %zu points",
                      values[OUTLINE_WEIGHTS].count, o->count);
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

/* The curve returns to where it begins, and is seen from the center without overlap: then the ends
 * are the areas in it. The coefficients tell so; where they do not, the curve may still be seen. */
static imp_status check_ends(const outline *o, const knots *k, imp_create_error *why)
{
    const double *first = o->profile, *last = o->profile + 2 * (o->count - 1);
    const double *at = o->row.number;
    const size_t p = (size_t)o->degree;
    double least = INFINITY, greatest = -INFINITY;
    if (!(at[0] == at[p] && at[o->count] == at[o->count + p]))
        return imp_reject(why, OUTLINE_KNOTS, -1,
                          "must be there degree + 1 times at either end, with ends");
    if (first[0] != last[0] || first[1] != last[1])
        return imp_reject(why, OUTLINE_PROFILE, -1,
                          "ends at [%.15g,%.15g], must end at its first point, [%.15g,%.15g], "
                          "with ends",
                          last[0], last[1], first[0], first[1]);
    for (size_t span = 0; span < k->spans; ++span) {
        arc a;
        make_arc(o, k, span, &a);
        turn_of(&a, &least, &greatest);
    }
    const double room = NEARLY * (greatest > -least ? greatest : -least);
    if (least >= -room || greatest <= room) return IMP_STATUS_OK;
    return imp_reject(why, OUTLINE_CENTER, -1,
                      "the curve is not seen to turn one way about [%g,%g], must be a point in it "
                      "from which all of it is seen; or take a mesh for the ends",
                      o->center[0], o->center[1]);
}

static void take_center(const imp_value *values, outline *o)
{
    for (size_t i = 0; i < 2; ++i) {
        double sum = 0;
        for (size_t k = 1; k < o->count; ++k) sum += o->profile[2 * k + i] / (double)(o->count - 1);
        o->center[i] =
            imp_is_given(&values[OUTLINE_CENTER]) ? values[OUTLINE_CENTER].number[i] : sum;
    }
}

imp_status outline_close(const imp_value *values, const knots *k, outline *o, imp_create_error *why)
{
    take_center(values, o);
    return check_ends(o, k, why);
}

void outline_clear(outline *o)
{
    free(o->knots);
    free(o->joined);
    o->knots = o->joined = NULL;
}
