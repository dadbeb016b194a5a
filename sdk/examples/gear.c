/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* The flanks of an involute gear, each a piece. A flank unrolls from the base circle. The crate
 * gear-rs beside this folder is the same type in Rust. */

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { TEETH, BASE, ROLL, WIDTH };

static const imp_parameter parameters[] = {
    [TEETH] = IMP_ROW_INTEGER("teeth", "1", "12", 3, 1000, "how many teeth it has"),
    [BASE] = IMP_ROW_POSITIVE("base", "length", "1", "radius of the base circle"),
    [ROLL] = IMP_ROW_BETWEEN("roll", "rad", "0.6", 0.01, 3, "how far a flank unrolls"),
    [WIDTH] = IMP_ROW_POSITIVE("width", "length", "0.5", "along the z axis"),
};

typedef struct flank {
    double base, angle, sign, roll, width;
} flank;

typedef struct gear {
    size_t count;
    flank flanks[];
} gear;

/* The half tooth at the base circle, in parts of the pitch. */
static const double HALF_TOOTH = 0.3;

static imp_status gear_create(const imp_value *values, void **self, imp_create_error *why)
{
    const double teeth = values[TEETH].number[0], roll = values[ROLL].number[0];
    const double pitch = 2 * 3.14159265358979311600 / teeth;
    const size_t count = 2 * (size_t)teeth;
    if (roll - atan(roll) >= HALF_TOOTH * pitch)
        return imp_reject(why, ROLL, -1,
                          "the flanks of a tooth meet before that; must be smaller for %g teeth",
                          teeth);
    gear *made = malloc(sizeof *made + count * sizeof(flank));
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->count = count;
    for (size_t k = 0; k < count; ++k) {
        const double sign = k % 2 == 0 ? 1 : -1, tooth = (double)(k / 2);
        made->flanks[k] = (flank){values[BASE].number[0], pitch * (tooth - sign * HALF_TOOTH), sign,
                                  roll, values[WIDTH].number[0]};
    }
    *self = made;
    return IMP_STATUS_OK;
}

static size_t gear_count(const void *self) { return ((const gear *)self)->count; }

static const void *gear_piece(const void *self, size_t k)
{
    return &((const gear *)self)->flanks[k];
}

/* --- One flank: self is a piece from here on -------------------------------------------------- */

static void gear_domain(const void *self, double lo[3], double hi[3])
{
    const flank *f = self;
    imp_set_domain(lo, hi, 0, f->roll, -0.5 * f->width, 0.5 * f->width);
}

/* With phi = angle + s u, s = 1 or -1 for either side of a tooth: (base (cos phi + s u sin phi),
 * base (sin phi - s u cos phi), v). */
static void gear_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const flank *f = self;
    imp_model sine, cosine, way = imp_scale(u, f->sign);
    (void)t;
    imp_sincos(imp_shift(way, f->angle), &sine, &cosine);
    out[0] = imp_scale(imp_add(cosine, imp_mul(way, sine)), f->base);
    out[1] = imp_scale(imp_sub(sine, imp_mul(way, cosine)), f->base);
    out[2] = v;
}
IMP_SURFACE_FORMULA(gear_formula)

static const imp_surface_type type = {
    IMP_SURFACE_FIELDS_OF("involute-flanks", gear, gear_formula, free),
    .piece_count = gear_count,
    .piece = gear_piece,
    .summary = "flanks of an involute gear",
    .equation =
        "phi = angle + s u: (base (cos phi + s u sin phi), base (sin phi - s u cos phi), v)",
    .example = "involute-flanks teeth=20 roll=0.5",
};

IMPINGE_SURFACE_PLUGIN("involute-flanks", "1.0", "MIT", "The Impinge authors", type);
