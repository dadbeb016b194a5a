/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/base/rounding.h"
#include "core/bounds/spine.h"
#include "core/surface/carried.h"

/* The radius of a spine by what the type claims of points beside the surface. */

typedef struct probe {
    const spine *of;
    double across[3]; /* a unit vector across the axis, up to rounding */
    double moment;
    int looks;
} probe;

/* Looks at a surface for one reduction, and the halvings of a stretch of the line. */
enum { LOOKS_MOST = 512, STRETCHES = 32, STRETCH_DEPTH = 24, REDUCTIONS = 32 };

/* A bound of what the type claims of all points center + distance across + z axis, z from lo to hi;
 * 0: none. */
static imp_code claim(probe *p, double distance, double lo, double hi, double *lower,
                      imp_error *error)
{
    const spine *of = p->of;
    const imp_region r = region_make((double[3]){0, lo, p->moment}, (double[3]){0, hi, p->moment});
    const imp_model z = imp_param(&r, PARAMETER_V);
    time_window window = {p->moment, p->moment};
    imp_model x[3], g;
    *lower = 0;
    p->looks += 1;
    for (int i = 0; i < 3; ++i) {
        const imp_model beside = imp_scale(imp_num(p->across[i]), distance);
        x[i] = imp_add(imp_shift(beside, of->center[i]), imp_scale(z, of->axis[i]));
    }
    const imp_status status = surface_distance(of->of, &r, 0, x, &g);
    if (status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    if (status != IMP_STATUS_OK) return distance_fault(of->of, status, error);
    distance_cut_heights(&g, 2, &r, 0x1p300, &window, lower);
    return IMP_SUCCESS;
}

/* Finds a number that is claimed of all points with z from lo to hi, near the least claimed of
 * some; 0: none is found. */
static imp_code claim_of_all(probe *p, double distance, double lo, double hi, double *least,
                             imp_error *error)
{
    double ends[STRETCH_DEPTH + 1][2], some = INFINITY, lower;
    *least = 0;
    p->looks = 0;
    for (int k = 0; k <= STRETCHES; ++k) {
        const double z = lo + (hi - lo) * k / STRETCHES;
        const imp_code code = claim(p, distance, z, z, &lower, error);
        if (code != IMP_SUCCESS) return code;
        if (lower < some) some = lower;
    }
    const double wanted = 0.75 * some;
    for (int k = 0; k < STRETCHES && wanted > 0; ++k) {
        int count = 1;
        ends[0][0] = k == 0 ? lo : lo + (hi - lo) * k / STRETCHES;
        ends[0][1] = k + 1 == STRETCHES ? hi : lo + (hi - lo) * (k + 1) / STRETCHES;
        while (count > 0) {
            const double from = ends[count - 1][0], to = ends[count - 1][1];
            const double middle = 0.5 * from + 0.5 * to;
            const imp_code code = claim(p, distance, from, to, &lower, error);
            if (code != IMP_SUCCESS) return code;
            --count;
            if (lower >= wanted) continue;
            if (count + 2 > STRETCH_DEPTH || p->looks > LOOKS_MOST) return IMP_SUCCESS;
            ends[count][0] = from, ends[count][1] = middle;
            ends[count + 1][0] = middle, ends[count + 1][1] = to;
            count += 2;
        }
    }
    *least = wanted;
    return IMP_SUCCESS;
}

/* More than what rounding moves points beside the line, as a part of their distance from its
 * center: of the axis and the vector across it, 16 u each. */
#define BESIDE 0x1p-46

/* Lemma. Let all points of the surface be within r of the line, D >= r, and let the type claim L of
 * all points at the distance D in one half plane whose places along the line are in a stretch. This
 * is as long as the lead of a screw, or all of the surface for rotations about the line, or any for
 * translations along it. A motion of the symmetry takes one of these points to the angle and the
 * place of any point x of the surface. That one is D - q from x, q <= r being how far x is from the
 * line, and at least L. So q <= D - L. The stretch is longer by a part, since the lead is rounded;
 * the line that is computed is off by a part of the distance from its center. */
imp_code spine_reduce(spine *of, const time_window *times, double goal, imp_error *error)
{
    imp_symmetry line;
    const imp_status status = surface_symmetry(of->of, &line);
    if (status != IMP_STATUS_OK) return IMP_SUCCESS;
    const vec3 across = vec3_across(vec3_from(of->axis));
    probe p = {.of = of,
               .across = {across.x[0], across.x[1], across.x[2]},
               .moment = 0.5 * times->lo + 0.5 * times->hi};
    const double middle = 0.5 * of->from + 0.5 * of->to;
    double reach = of->to - middle;
    if (symmetry_is_screw(&line)) reach = 0.5 * vec3_norm(vec3_from(line.axis));
    if (line.kind == IMP_SYMMETRY_ALONG_LINE) reach = 0;
    if (line.kind == IMP_SYMMETRY_ACROSS_LINE) return IMP_SUCCESS;
    reach += BESIDE * (reach + fabs(middle));
    for (int k = 0; k < REDUCTIONS && of->radius > goal; ++k) {
        const double distance = of->radius * (1 + BESIDE);
        const double far =
            fabs(of->from) + fabs(of->to) + distance + vec3_norm(vec3_from(of->center));
        double least;
        const imp_code code =
            claim_of_all(&p, distance, middle - reach, middle + reach, &least, error);
        const double radius = sum_upper(difference_lower(distance, least), 2 * BESIDE * far);
        if (code != IMP_SUCCESS || !(radius < of->radius)) return code;
        of->radius = radius;
    }
    return IMP_SUCCESS;
}
