/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/polynomial.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* The map is Lipschitz but not smooth: the factor has a kink at both ends of the range. */

enum { AXIS, CENTER, RANGE, START, END };

static const imp_parameter parameters[] = {
    [AXIS] = ROW_AXIS("axis", "[0,0,1]", "direction of the axis, any vector but 0"),
    [CENTER] =
        IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "point of the axis at coordinate 0"),
    [RANGE] = ROW_RANGE("[-1,1]", "where the factor changes, in coordinates along the axis"),
    [START] = ROW_IN_TIME("start", "1", "1", "factor across the axis up to the range"),
    [END] = ROW_IN_TIME("end", "1", "0.5", "factor across the axis beyond the range"),
};

typedef struct taper_instance {
    double center[3], lo, hi;
    axis_frame axis;
    near_constant per_length; /* 1 / (hi - lo) */
    polynomial start, end;
    double coefficients[];
} taper_instance;

static imp_status taper_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = axis_check(AXIS, values[AXIS].number, why);
    if (status == IMP_STATUS_OK) status = axis_check_range(RANGE, values[RANGE].number, why);
    if (status != IMP_STATUS_OK) return status;
    size_t numbers = values[START].count + values[END].count;
    taper_instance *s = malloc(sizeof *s + numbers * sizeof(double));
    if (s == NULL) return IMP_STATUS_INTERNAL;
    s->axis = axis_frame_of(values[AXIS].number);
    imp_copy_vector(s->center, &values[CENTER]);
    s->lo = values[RANGE].number[0];
    s->hi = values[RANGE].number[1];
    s->per_length = near_of(imp_div(imp_num(1), imp_sub(imp_num(s->hi), imp_num(s->lo))));
    s->start = polynomial_copy(&values[START], 1, s->coefficients);
    s->end = polynomial_copy(&values[END], 1, s->coefficients + s->start.count);
    *self = s;
    return IMP_STATUS_OK;
}

/* Fraction of the distance from lo to hi. */
static imp_model part_of_range(const taper_instance *s, imp_model along)
{
    imp_model inside = axis_clamp(along, s->lo, s->hi);
    return axis_clamp(near_scale(imp_shift(inside, -s->lo), s->per_length), 0, 1);
}

static void taper_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    const taper_instance *s = self;
    imp_model w[3];
    axis_from_center(s->center, x, y, z, w);
    imp_model factor = imp_lerp(polynomial_at(&s->start, 0, t), polynomial_at(&s->end, 0, t),
                                part_of_range(s, axis_dot(s->axis.unit, w)));
    axis_stretch(&s->axis, factor, w, out);
    axis_add_center(s->center, out);
}
IMP_MAP_FORMULA(taper_formula)
IMP_MAP_AT_ALL_TIMES(taper)

static imp_status taper_write_formula(const void *self, const imp_text_sink *to)
{
    const taper_instance *s = self;
    imp_add_text(to, AXIS_TEXT);
    polynomial_define(&s->start, 0, "first", to);
    polynomial_define(&s->end, 0, "last", to);
    imp_add_text(to, "p = clamp((d - range0)/(range1 - range0), 0, 1); "
                     "f = first + p*(last - first); center0 + k0*d + f*(w0 - k0*d); "
                     "center1 + k1*d + f*(w1 - k1*d); center2 + k2*d + f*(w2 - k2*d)");
    return IMP_STATUS_OK;
}

static const imp_map_type taper = {
    IMP_MAP_FIELDS(taper, taper_formula),
    .write_formula = taper_write_formula,
    .summary = "widens or narrows along an axis, linearly within a range; may change in time",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, h = k.w, p = (h - lo)/(hi - lo) limited to "
                "[0,1], f = start + p (end - start): center + k h + f (w - k h); start and end are "
                "polynomials in t",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, eqs. 35-40",
    .example = "taper axis=0,0,1 range=-1,1 start=1 end=[1,-0.5]",
};

PUBLISH_MAP(taper);
