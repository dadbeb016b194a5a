/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/prism.h"
#include "plugins/common/publish.h"
#include "plugins/patch/nurbs_surface.h"
#include "plugins/patch/outline.h"
#include "plugins/patch/parameters.h"
#include "plugins/patch/patch_text.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>
#include <stdlib.h>

/* A plane curve moved along a vector: its control points, and these plus the vector, rounded to
 * doubles, are those of a NURBS surface of degree 1 along v. Ends are two more pieces, between the
 * curve and a point from which all of it is seen. A curve of degree 1 is a polygon, whatever its
 * weights: then each segment is a parallelogram, and has a triangle at each end, pieces that know
 * their planes. */

/* So that sums stay within the limits of patch.h. */
#define EXTRUSION_FAR 1e99

static const imp_parameter parameters[] = {
    [OUTLINE_PROFILE] =
        IMP_ROW("profile", "length", "[[1,0],[0.5,1],[-1,1],[-1,-1],[0.5,-1],[1,0]]", 0, 2, 0, 2,
                -EXTRUSION_FAR, EXTRUSION_FAR,
                "control points [x,y] of the curve; counter-clockwise: u cross v is outward"),
    [OUTLINE_DEGREE] = IMP_ROW_OF(
        IMP_KIND_INTEGER, "degree", "1", NULL, IMP_PARAMETER_OPTIONAL, 0, 0, 0, 1, PATCH_DEGREE_MAX,
        "of a B-spline; left out: a Bezier curve, of one less than it has points"),
    [OUTLINE_KNOTS] =
        IMP_ROW("knots", "1", NULL, IMP_PARAMETER_OPTIONAL, 1, 0, 0, -KNOT_FAR, KNOT_FAR,
                "of a B-spline, as many as points and degree and 1; left out: 0, ..., 0, 1, 2, "
                "..., so that it goes from the first point to the last"),
    [OUTLINE_WEIGHTS] =
        ROW_PATCH_WEIGHTS("weights", "one per point, for a rational curve; default: all 1"),
    [OUTLINE_VECTOR] = IMP_ROW("vector", "length", "[0,0,1]", 0, 1, 3, 0, -EXTRUSION_FAR,
                               EXTRUSION_FAR, "from the curve to the other end; its z is not 0"),
    [OUTLINE_ENDS] = IMP_ROW_BOOLEAN("ends", "false", "closed by the two plane areas in the curve"),
    [OUTLINE_CENTER] = IMP_ROW(
        "center", "length", NULL, IMP_PARAMETER_OPTIONAL, 1, 2, 0, -EXTRUSION_FAR, EXTRUSION_FAR,
        "with ends: [x,y] from which all of the curve is seen; default: the mean of "
        "its points"),
};

/* What all callbacks but create, destroy and those for pieces get as `self`. */
typedef struct piece {
    prism flat;                   /* first member */
    const nurbs_instance *curved; /* or NULL: it is flat */
} piece;

typedef struct extrusion_pieces {
    piece first; /* so that the whole can be asked like its first piece */
    piece *of;
    size_t count;
    nurbs_instance part[PRISM_PARTS]; /* of a curve that is not straight */
    size_t parts;
} extrusion_pieces;

static imp_status refuse_size(double bytes, imp_create_error *why)
{
    return imp_reject(why, OUTLINE_PROFILE, -1, "would take %.0f MiB, must be at most %.0f MiB",
                      ceil(bytes * 0x1p-20), NURBS_CELLS_MAX * 0x1p-20);
}

/* --- Flat pieces ------------------------------------------------------------------------------ */

static bool has_length(const outline *o, size_t last)
{
    const double *p = o->profile + 2 * (last - 1), *q = o->profile + 2 * last;
    return p[0] != q[0] || p[1] != q[1];
}

/* The last point of each segment of the polygon, none of length 0 if there are others. */
static size_t list_segments(const outline *o, const knots *k, size_t *last)
{
    size_t count = 0;
    for (size_t span = 0; span < k->spans; ++span)
        if (has_length(o, k->last[span])) last[count++] = k->last[span];
    if (count == 0) last[count++] = k->last[0];
    return count;
}

static imp_status make_flat_pieces(extrusion_pieces *s, const imp_value *values, const outline *o,
                                   const knots *k, imp_create_error *why)
{
    const size_t parts = values[OUTLINE_ENDS].number[0] != 0 ? PRISM_PARTS : 1;
    const double bytes = (double)k->spans * (double)sizeof *s->of;
    if (bytes > NURBS_CELLS_MAX) return refuse_size(bytes, why);
    size_t *last = malloc(k->spans * sizeof *last);
    const size_t segments = last != NULL ? list_segments(o, k, last) : 0;
    if (last != NULL) s->of = malloc(parts * segments * sizeof *s->of);
    for (size_t j = 0; s->of != NULL && j < parts * segments; ++j) {
        const double *q = o->profile + 2 * last[j % segments];
        prism_make(&s->of[j].flat, (int)(j / segments), q - 2, q, o->center,
                   values[OUTLINE_VECTOR].number);
        s->of[j].curved = NULL;
    }
    s->count = parts * segments;
    free(last);
    return s->of != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static imp_status make_polygon(extrusion_pieces *s, const imp_value *values, outline *o,
                               imp_create_error *why)
{
    knots k;
    imp_status status = knots_make(&k, &o->row, o->degree) ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
    if (status == IMP_STATUS_OK && values[OUTLINE_ENDS].number[0] != 0)
        status = outline_close(values, &k, o, why);
    if (status == IMP_STATUS_OK) status = make_flat_pieces(s, values, o, &k, why);
    knots_free(&k);
    return status;
}

/* --- Curved pieces ---------------------------------------------------------------------------- */

static const double along_v[] = {0, 0, 1, 1};

/* Ends lie between the curve and the center, in the order that makes f_u x f_v point outward where
 * the curve runs counter-clockwise. */
static imp_status make_part(extrusion_pieces *s, int part, const outline *o, const double *vector,
                            imp_create_error *why)
{
    double *points = malloc(6 * o->count * sizeof *points), bytes = 0;
    double *weights = malloc(2 * o->count * sizeof *weights);
    for (size_t k = 0; points != NULL && weights != NULL && k < o->count; ++k) {
        const double *at = o->profile + 2 * k;
        prism_place(points + 6 * k, part == PRISM_LOWER ? o->center : at,
                    part == PRISM_UPPER ? vector : NULL);
        prism_place(points + 6 * k + 3, part == PRISM_UPPER ? o->center : at,
                    part == PRISM_LOWER ? NULL : vector);
        weights[2 * k] = weights[2 * k + 1] = o->weights != NULL ? o->weights[k] : 1;
    }
    const nurbs_data data = {.degree = {o->degree, 1},
                             .knots = {o->row, {along_v, 4, OUTLINE_PROFILE, -1}},
                             .points = points,
                             .weights = weights};
    const bool made =
        points != NULL && weights != NULL && nurbs_make(&s->part[part], &data, &bytes);
    s->parts += 1;
    free(points);
    free(weights);
    if (made) return IMP_STATUS_OK;
    return bytes > NURBS_CELLS_MAX ? refuse_size(bytes, why) : IMP_STATUS_INTERNAL;
}

static imp_status make_curved(extrusion_pieces *s, const imp_value *values, outline *o,
                              imp_create_error *why)
{
    const double *vector = values[OUTLINE_VECTOR].number;
    imp_status status = make_part(s, PRISM_SIDE, o, vector, why);
    if (status == IMP_STATUS_OK && values[OUTLINE_ENDS].number[0] != 0) {
        status = outline_close(values, &s->part[PRISM_SIDE].side[0], o, why);
        for (int part = PRISM_LOWER; part < PRISM_PARTS && status == IMP_STATUS_OK; ++part)
            status = make_part(s, part, o, vector, why);
    }
    if (status != IMP_STATUS_OK) return status;
    s->of = calloc(s->parts, sizeof *s->of);
    if (s->of == NULL) return IMP_STATUS_INTERNAL;
    for (s->count = 0; s->count < s->parts; ++s->count) s->of[s->count].curved = &s->part[s->count];
    return IMP_STATUS_OK;
}

/* --- All pieces ------------------------------------------------------------------------------- */

static void extrusion_destroy(void *self)
{
    extrusion_pieces *s = self;
    if (s == NULL) return;
    for (size_t k = 0; k < s->parts; ++k) nurbs_clear(&s->part[k]);
    free(s->of);
    free(s);
}

static imp_status extrusion_create(const imp_value *values, void **self, imp_create_error *why)
{
    outline o;
    extrusion_pieces *s = NULL;
    imp_status status = outline_read(values, &o, why);
    if (status == IMP_STATUS_OK) s = calloc(1, sizeof *s);
    if (status == IMP_STATUS_OK && s == NULL) status = IMP_STATUS_INTERNAL;
    if (status == IMP_STATUS_OK)
        status = o.degree == 1 ? make_polygon(s, values, &o, why) : make_curved(s, values, &o, why);
    outline_clear(&o);
    if (status == IMP_STATUS_OK) {
        s->first = s->of[0];
        *self = s;
    } else {
        extrusion_destroy(s);
    }
    return status;
}

static size_t extrusion_piece_count(const void *self)
{
    return ((const extrusion_pieces *)self)->count;
}

static const void *extrusion_piece(const void *self, size_t k)
{
    return &((const extrusion_pieces *)self)->of[k];
}

/* --- One piece -------------------------------------------------------------------------------- */

static void extrusion_domain(const void *self, double lo[3], double hi[3])
{
    const piece *p = self;
    if (p->curved != NULL)
        nurbs_domain(p->curved, lo, hi);
    else
        imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static imp_status extrusion_eval(const void *self, size_t n, const double *p, double *x,
                                 double *error)
{
    const piece *s = self;
    return s->curved != NULL ? nurbs_eval(s->curved, n, p, x, error)
                             : linear_eval(s, n, p, x, error);
}

static imp_status extrusion_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const piece *p = self;
    return p->curved != NULL ? nurbs_rate(p->curved, region, rates) : linear_rate(p, region, rates);
}

static imp_status extrusion_include(const void *self, const imp_region *region, imp_model model[3])
{
    const piece *p = self;
    return p->curved != NULL ? nurbs_include(p->curved, region, model)
                             : linear_include(p, region, model);
}

static imp_status extrusion_net(const void *self, const imp_region *region, imp_net *net)
{
    const piece *p = self;
    return p->curved != NULL ? nurbs_net(p->curved, region, net) : linear_net(p, region, net);
}

/* The distance from the endless plane. */
static imp_model flat_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    (void)t;
    return facet_gap(self, x, y, z);
}
IMP_DISTANCE_FORMULA(flat_gap)

static imp_status extrusion_distance(const void *self, const imp_model point[4],
                                     imp_model *distance)
{
    const piece *p = self;
    return p->curved != NULL ? nurbs_distance(p->curved, point, distance)
                             : flat_gap_distance(p, point, distance);
}

static imp_status extrusion_symmetry(const void *self, imp_symmetry *symmetry)
{
    const piece *p = self;
    return p->curved != NULL ? nurbs_symmetry(p->curved, symmetry) : facet_symmetry(p, symmetry);
}

static imp_status extrusion_write_formula(const void *self, const imp_text_sink *to)
{
    const piece *p = self;
    if (p->curved != NULL)
        nurbs_write(p->curved, to);
    else
        prism_write(&p->flat, to);
    return IMP_STATUS_OK;
}

static const imp_surface_type extrusion = {
    IMP_SURFACE_FIELDS_OF("extrusion", extrusion, extrusion, extrusion_destroy),
    .net = extrusion_net,
    .piece_count = extrusion_piece_count,
    .piece = extrusion_piece,
    .distance = extrusion_distance,
    .symmetry = extrusion_symmetry,
    .write_formula = extrusion_write_formula,
    .summary = "plane Bezier or B-spline curve moved along a vector, with ends=true closed",
    .equation = "c(u) + v vector, c = sum_i N_i(u) w_i profile_i / sum_i N_i(u) w_i, N: B-splines "
                "over the knots, from 0 to the number of spans (a Bezier curve: 1), v in [0,1]; "
                "ends: center + v (c(u) - center), c(u) + vector + v (center - c(u)); of degree 1 "
                "each segment from p to q is a piece, c(u) = p + u (q - p), u in [0,1], in the "
                "order of the profile, without those of length 0, then all of the lower end, then "
                "of the upper; of another degree the pieces are: 0 side, 1 lower end, 2 upper end",
    .source = NULL,
    .example =
        "extrusion profile=[[1,0],[1,2],[-1,2],[-1,0],[1,0]] degree=2 vector=0,0,3 ends=true",
};

PUBLISH_SURFACE(extrusion);
