/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/parameters.h"
#include "plugins/patch/patch_include.h"
#include "plugins/patch/patch_net.h"
#include "plugins/patch/patch_rate.h"
#include "plugins/patch/patch_text.h"
#include "plugins/patch/triangle.h"

#include <impinge/plugin.h>

/* Bezier triangles whose control points move linearly: one, or many that share points. Each is a
 * piece; all of its mathematics is in triangle.h and in what that says of patches. */

enum { DEGREE, POINTS, WEIGHTS, VELOCITIES, FACES };

/* The most that the triangles of one surface may take, in bytes. */
#define TRIANGLES_MAX 0x1p30

static const imp_parameter parameters[] = {
    [DEGREE] = IMP_ROW_INTEGER("degree", "1", "2", 1, TRIANGLE_DEGREE_MAX, "polynomial degree n"),
    [POINTS] = ROW_PATCH_POINTS(
        "points", "length", "[[0,0,0],[0.5,0,0.3],[0,0.5,0.3],[1,0,0],[0.5,0.5,0.3],[0,1,0]]", 3, 0,
        "control points [x,y,z], row by row from the first corner to the opposite edge: point j of "
        "row k, j <= k <= n, is at index k*(k+1)/2+j"),
    [WEIGHTS] =
        ROW_PATCH_WEIGHTS("weights", "one per point, for rational triangles; default: all 1"),
    [VELOCITIES] = ROW_PATCH_VELOCITIES,
    [FACES] =
        IMP_ROW_OF(IMP_KIND_INTEGER, "faces", "1", NULL, IMP_PARAMETER_OPTIONAL, 2, 0, 0, 0, 0x1p32,
                   "of many triangles: the (n+1)*(n+2)/2 control points of each, by number of "
                   "the point, from 0; left out: one triangle"),
};

typedef struct triangles {
    patch first; /* so that the whole can be asked like its first piece */
    size_t count;
    patch *piece[];
} triangles;

/* --- Creation --------------------------------------------------------------------------------- */

static imp_status check_points(const imp_value *values, size_t each, imp_create_error *why)
{
    const size_t points = values[POINTS].extent[0];
    const double n = values[DEGREE].number[0];
    if (!imp_is_given(&values[FACES]) && points != each)
        return imp_reject(
            why, POINTS, -1,
            "%zu given, but a triangle of degree %g has (%g+1)*(%g+2)/2 = %zu control "
            "points; give faces for more triangles",
            points, n, n, n, each);
    for (int parameter = WEIGHTS; parameter <= VELOCITIES; ++parameter) {
        const size_t found = values[parameter].extent[0];
        if (imp_is_given(&values[parameter]) && found != points)
            return imp_reject(why, parameter, -1, "%zu given for %zu points; give one each", found,
                              points);
    }
    return IMP_STATUS_OK;
}

static imp_status check_faces(const imp_value *values, size_t each, imp_create_error *why)
{
    const imp_value *faces = &values[FACES];
    const size_t points = values[POINTS].extent[0];
    if (!imp_is_given(faces)) return IMP_STATUS_OK;
    if (faces->extent[1] != each)
        return imp_reject(why, FACES, -1,
                          "%zu numbers a face, must be %zu, the control points of a triangle of "
                          "degree %g",
                          faces->extent[1], each, values[DEGREE].number[0]);
    for (size_t k = 0; k < faces->count; ++k)
        if (!(faces->number[k] < (double)points))
            return imp_reject(why, FACES, (int64_t)(k / each),
                              "point %.0f is not there: points are numbered from 0 to %zu",
                              faces->number[k], points - 1);
    return IMP_STATUS_OK;
}

/* The memory of as many triangles. */
static imp_status check_size(const imp_value *values, size_t count, imp_create_error *why)
{
    const double side = values[DEGREE].number[0] + 1;
    const double lanes = imp_is_given(&values[VELOCITIES]) ? 8 : 4;
    const double numbers = (2 * side * side + 2 * side * (side - 1)) * lanes;
    const double bytes = (double)count * (sizeof(patch) + numbers * sizeof(double));
    if (bytes <= TRIANGLES_MAX) return IMP_STATUS_OK;
    return imp_reject(why, FACES, -1,
                      "%zu triangles of degree %g would take %.0f MiB, must be at most %.0f MiB: "
                      "divide the surface",
                      count, values[DEGREE].number[0], ceil(bytes * 0x1p-20),
                      TRIANGLES_MAX * 0x1p-20);
}

static void triangles_destroy(void *self)
{
    triangles *f = self;
    for (size_t k = 0; k < f->count; ++k) free(f->piece[k]);
    free(f);
}

static const double *given(const imp_value *value)
{
    return imp_is_given(value) ? value->number : NULL;
}

/* One after the other; `count` says how many are there. */
static imp_status make_pieces(triangles *f, const imp_value *values, size_t count, size_t each)
{
    triangle_data data = {.degree = (int)values[DEGREE].number[0],
                          .points = values[POINTS].number,
                          .velocities = given(&values[VELOCITIES]),
                          .weights = given(&values[WEIGHTS]),
                          .which = given(&values[FACES])};
    while (f->count < count) {
        patch *made = triangle_new(&data);
        if (made == NULL) return IMP_STATUS_INTERNAL;
        f->piece[f->count++] = made;
        if (data.which != NULL) data.which += each;
    }
    f->first = *f->piece[0];
    return IMP_STATUS_OK;
}

static imp_status triangles_create(const imp_value *values, void **self, imp_create_error *why)
{
    const size_t each = triangle_points((int)values[DEGREE].number[0]);
    const size_t count = imp_is_given(&values[FACES]) ? values[FACES].extent[0] : 1;
    imp_status status = check_points(values, each, why);
    if (status == IMP_STATUS_OK) status = check_faces(values, each, why);
    if (status == IMP_STATUS_OK) status = check_size(values, count, why);
    if (status != IMP_STATUS_OK) return status;
    triangles *f = calloc(1, sizeof *f + count * sizeof f->piece[0]);
    if (f == NULL) return IMP_STATUS_INTERNAL;
    status = make_pieces(f, values, count, each);
    if (status == IMP_STATUS_OK)
        *self = f;
    else
        triangles_destroy(f);
    return status;
}

static size_t triangles_piece_count(const void *self) { return ((const triangles *)self)->count; }

static const void *triangles_piece(const void *self, size_t k)
{
    return ((const triangles *)self)->piece[k];
}

/* --- One triangle ----------------------------------------------------------------------------- */

static void triangle_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static imp_status triangle_eval(const void *self, size_t n, const double *p, double *x,
                                double *error)
{
    return patch_eval(self, n, p, x, error);
}

static imp_status triangle_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    return patch_rate(self, region, rates);
}

static imp_status triangle_include(const void *self, const imp_region *region, imp_model model[3])
{
    return patch_include(self, region, model);
}

static imp_status triangle_net(const void *self, const imp_region *region, imp_net *net)
{
    return patch_net(self, region, net);
}

static imp_status triangle_write_formula(const void *self, const imp_text_sink *to)
{
    triangle_write(self, to);
    return IMP_STATUS_OK;
}

static const imp_surface_type bezier_triangle = {
    IMP_TYPE_FIELDS(imp_surface_type, "bezier-triangle", triangles, triangles_destroy),
    .domain = triangle_domain,
    .eval = triangle_eval,
    .rate = triangle_rate,
    .include = triangle_include,
    .net = triangle_net,
    .piece_count = triangles_piece_count,
    .piece = triangles_piece,
    .write_formula = triangle_write_formula,
    .summary = "Bezier triangles of any degree up to 10, polynomial or rational, moving linearly",
    .equation =
        "sum_kj B_kj w_kj (points_kj + t velocities_kj) / sum_kj B_kj w_kj, B_kj = "
        "n!/((n-k)! (k-j)! j!) a^(n-k) b^(k-j) c^j, a = 1-u, b = u(1-v), c = u v, u and v in "
        "[0,1]",
    .source = "G. Farin, Curves and Surfaces for CAGD",
    .example = "bezier-triangle degree=2 "
               "points=[[0,0,0],[0.5,0,0.2],[0,0.5,0.2],[1,0,0],[0.7,0.7,0.2],[0,1,0]]",
};

IMPINGE_SURFACE_PLUGIN("bezier-triangle", PLUGIN_VERSION, "Apache-2.0", "The Impinge authors",
                       bezier_triangle);
