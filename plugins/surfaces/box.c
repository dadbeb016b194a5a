/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/facet.h"
#include "plugins/common/publish.h"

#include <impinge/formula_text.h>

/* Six rectangles, as pieces, that meet in common corners. A corner is center - size / 2 or center +
 * size / 2, rounded to double once: the box has these doubles for corners, exactly. */

enum { SIZE, CENTER };

static const imp_parameter parameters[] = {
    [SIZE] = IMP_ROW("size", "length", "[1,1,1]", IMP_PARAMETER_MIN_OPEN, 1, 3, 0, 0, LINEAR_FAR,
                     "edges along x, y and z"),
    [CENTER] = ROW_NEAR_VECTOR("center", "length", "[0,0,0]", 0, "centre of the box"),
};

enum { FACES = 6 };

typedef struct box_instance {
    facet face[FACES]; /* the instance is its first piece */
} box_instance;

/* The face across axis i at its upper or lower end; edge_u x edge_v points outward. Its normal is a
 * unit vector that is exact, and perpendicular to both edges exactly: flatness 0 (facet.c). */
static void make_face(facet *f, const double lo[3], const double hi[3], int i, bool is_upper)
{
    const int first = (i + (is_upper ? 1 : 2)) % 3, second = (i + (is_upper ? 2 : 1)) % 3;
    double origin[3] = {lo[0], lo[1], lo[2]}, edge_u[3] = {0, 0, 0}, edge_v[3] = {0, 0, 0};
    if (is_upper) origin[i] = hi[i];
    edge_u[first] = hi[first] - lo[first];
    edge_v[second] = hi[second] - lo[second];
    facet_span(f, origin, edge_u, edge_v);
    for (int j = 0; j < 3; ++j) f->normal[j] = j == i ? (is_upper ? 1 : -1) : 0;
    f->flatness = 0;
}

static imp_status box_fill(box_instance *s, const imp_value *values, imp_create_error *why)
{
    const double *size = values[SIZE].number, *center = values[CENTER].number;
    double lo[3], hi[3];
    for (int i = 0; i < 3; ++i) {
        lo[i] = center[i] - 0.5 * size[i];
        hi[i] = center[i] + 0.5 * size[i];
        if (!(lo[i] < hi[i]))
            return imp_reject(why, SIZE, i,
                              "%g is lost in the rounding of the center's %g; move it "
                              "by a map translate instead",
                              size[i], center[i]);
    }
    for (int k = 0; k < FACES; ++k) make_face(&s->face[k], lo, hi, k / 2, k % 2 == 1);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(box, box_instance)

static size_t box_piece_count(const void *self)
{
    (void)self;
    return FACES;
}

static const void *box_piece(const void *self, size_t k)
{
    return &((const box_instance *)self)->face[k];
}

static void box_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

/* The distance from the endless plane of a face. */
static imp_model box_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    (void)t;
    return facet_gap(self, x, y, z);
}
IMP_DISTANCE_FORMULA(box_gap)

/* The corners are rounded, so the numbers of the face are printed. */
static imp_status box_write_formula(const void *self, const imp_text_sink *to)
{
    const linear *f = self;
    for (size_t i = 0; i < 3; ++i) imp_define_at(to, "corner", i, f->still[LINEAR_1][i]);
    for (size_t i = 0; i < 3; ++i) imp_define_at(to, "edge_u", i, f->still[LINEAR_U][i]);
    for (size_t i = 0; i < 3; ++i) imp_define_at(to, "edge_v", i, f->still[LINEAR_V][i]);
    imp_add_text(to, "u in [0, 1]; v in [0, 1]; corner0 + edge_u0*u + edge_v0*v; corner1 + "
                     "edge_u1*u + edge_v1*v; corner2 + edge_u2*u + edge_v2*v");
    return IMP_STATUS_OK;
}

static const imp_surface_type box = {
    IMP_SURFACE_FIELDS(box, linear),
    .renew = box_renew,
    .net = linear_net,
    .piece_count = box_piece_count,
    .piece = box_piece,
    .distance = box_gap_distance,
    .symmetry = facet_symmetry,
    .write_formula = box_write_formula,
    .summary = "box with edges along x, y and z, of six rectangles",
    .equation =
        "faces across x, y, z, each at its lower and upper end: corner + u edge_u + v edge_v, "
        "u and v in [0,1]; corners center -+ size/2, rounded to doubles; pieces: 0 and 1 across x, "
        "2 and 3 across y, 4 and 5 across z, the lower end first",
    .source = NULL,
    .example = "box size=2,1,0.5 center=0,0,1",
};

PUBLISH_SURFACE(box);
