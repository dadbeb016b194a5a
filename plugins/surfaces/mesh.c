/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear.h"
#include "plugins/common/publish.h"
#include "plugins/mesh/mesh_parameters.h"

#include <impinge/formula_text.h>

/* Each triangle is a piece: that of the type for single triangles, made of the points when it is
 * asked for something. */

static const imp_parameter parameters[] = {
    [MESH_FILE] = ROW_MESH_FILE("triangles or polygons: .obj, .off, .stl, .ply, .gltf, .glb"),
    [MESH_POINTS] = ROW_MESH_POINTS,
    [MESH_FACES] = ROW_MESH_FACES("corners of each face, by number of the point, from 0; polygons "
                                  "that are not plane and convex are cut by their ears"),
    [MESH_VELOCITIES] = ROW_MESH_VELOCITIES,
    [MESH_SCALE] = ROW_MESH_SCALE,
};

typedef struct mesh mesh;

/* What all callbacks but create, renew, destroy and those for pieces get as `self`. Its place in
 * the list of pieces says which triangle it is. */
typedef struct piece {
    const mesh *of;
} piece;

struct mesh {
    piece first; /* so that the whole can be asked like its first piece */
    triangles triangles;
    double *velocity; /* of each point; NULL: at rest */
    piece *pieces;
};

static void mesh_destroy(void *self)
{
    mesh *m = self;
    triangles_clear(&m->triangles);
    free(m->velocity);
    free(m->pieces);
    free(m);
}

/* --- Creation --------------------------------------------------------------------------------- */

static imp_status make_pieces(mesh *m, imp_create_error *why)
{
    const size_t of_points = 3 * m->triangles.point_count * sizeof *m->triangles.point;
    const size_t of_piece = sizeof *m->pieces + 3 * sizeof *m->triangles.corner;
    if (!imp_goes_on(why, of_points + m->triangles.count * of_piece)) return IMP_STATUS_INTERNAL;
    triangles_fit(&m->triangles);
    m->pieces = malloc(m->triangles.count * sizeof *m->pieces);
    if (m->pieces == NULL) return IMP_STATUS_INTERNAL;
    for (size_t k = 0; k < m->triangles.count; ++k) m->pieces[k].of = m;
    m->first = m->pieces[0];
    return IMP_STATUS_OK;
}

static imp_status mesh_create(const imp_value *values, void **self, imp_create_error *why)
{
    mesh *m = calloc(1, sizeof *m);
    if (m == NULL) return IMP_STATUS_INTERNAL;
    imp_status status = mesh_take_shape(values, &m->triangles, why);
    if (status == IMP_STATUS_OK)
        status = mesh_take_velocities(values, m->triangles.point_count, &m->velocity, why);
    if (status == IMP_STATUS_OK) status = make_pieces(m, why);
    if (status == IMP_STATUS_OK)
        *self = m;
    else
        mesh_destroy(m);
    return status;
}

/* Refills a mesh with as many points and triangles. Those of a file are left to create. */
static imp_status mesh_renew(void *self, const imp_value *values, imp_create_error *why)
{
    mesh *m = self;
    triangles *const t = &m->triangles;
    const size_t points = t->point_count, count = t->count;
    const bool moves = imp_is_given(&values[MESH_VELOCITIES]);
    if (imp_is_given(&values[MESH_FILE]) || moves != (m->velocity != NULL) ||
        values[MESH_POINTS].extent[0] != points)
        return IMP_STATUS_UNBOUNDED;
    triangles_empty(t);
    imp_status status = mesh_take_shape(values, t, why);
    if (status == IMP_STATUS_OK) status = mesh_take_velocities(values, points, &m->velocity, why);
    if (status == IMP_STATUS_OK && t->count != count) status = IMP_STATUS_UNBOUNDED;
    return status;
}

static size_t mesh_piece_count(const void *self) { return ((const mesh *)self)->triangles.count; }

static const void *mesh_piece(const void *self, size_t k)
{
    return &((const mesh *)self)->pieces[k];
}

/* --- One triangle ----------------------------------------------------------------------------- */

static void set_corners(double term[LINEAR_TERMS][4], const double *list, const uint32_t *corner)
{
    const double *a = list + 3 * (size_t)corner[0], *b = list + 3 * (size_t)corner[1];
    const double *c = list + 3 * (size_t)corner[2];
    for (int i = 0; i < 3; ++i) {
        term[LINEAR_1][i] = a[i];
        term[LINEAR_U][i] = b[i] - a[i];
        term[LINEAR_UV][i] = c[i] - b[i];
    }
}

static const uint32_t *corners_of(const piece *p)
{
    const mesh *m = p->of;
    return m->triangles.corner + (p == &m->first ? 0 : 3 * (p - m->pieces));
}

static linear triangle_of(const void *self)
{
    const piece *p = self;
    const uint32_t *const corner = corners_of(p);
    linear f = {.depends = {0, 0, 0, 0}};
    set_corners(f.still, p->of->triangles.point, corner);
    if (p->of->velocity != NULL) set_corners(f.motion, p->of->velocity, corner);
    linear_finish(&f);
    return f;
}

static void mesh_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static imp_status mesh_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const linear f = triangle_of(self);
    return linear_eval(&f, n, p, x, error);
}

static imp_status mesh_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const linear f = triangle_of(self);
    return linear_rate(&f, region, rates);
}

static imp_status mesh_include(const void *self, const imp_region *region, imp_model model[3])
{
    const linear f = triangle_of(self);
    return linear_include(&f, region, model);
}

static imp_status mesh_net(const void *self, const imp_region *region, imp_net *net)
{
    const linear f = triangle_of(self);
    return linear_net(&f, region, net);
}

/* Defines the nine coordinates of a triangle's corners, or their velocities. */
static void define_corners(const imp_text_sink *to, const char *name, const double *list,
                           const uint32_t *corner)
{
    for (size_t k = 0; k < 9; ++k)
        imp_define_at(to, name, k, list[3 * (size_t)corner[k / 3] + k % 3]);
}

static imp_status mesh_write_formula(const void *self, const imp_text_sink *to)
{
    const piece *p = self;
    define_corners(to, "p", p->of->triangles.point, corners_of(p));
    if (p->of->velocity != NULL) define_corners(to, "w", p->of->velocity, corners_of(p));
    imp_add_text(to, p->of->velocity != NULL
                         ? "u in [0, 1]; v in [0, 1]; (1 - u)*(p0 + w0*t) + u*((1 - v)*(p3 + "
                           "w3*t) + v*(p6 + w6*t)); (1 - u)*(p1 + w1*t) + u*((1 - v)*(p4 + "
                           "w4*t) + v*(p7 + w7*t)); (1 - u)*(p2 + w2*t) + u*((1 - v)*(p5 + "
                           "w5*t) + v*(p8 + w8*t))"
                         : "u in [0, 1]; v in [0, 1]; (1 - u)*p0 + u*((1 - v)*p3 + v*p6); (1 - "
                           "u)*p1 + u*((1 - v)*p4 + v*p7); (1 - u)*p2 + u*((1 - v)*p5 + v*p8)");
    return IMP_STATUS_OK;
}

static const imp_surface_type mesh_type = {
    IMP_TYPE_FIELDS(imp_surface_type, "mesh", mesh, mesh_destroy),
    .domain = mesh_domain,
    .eval = mesh_eval,
    .rate = mesh_rate,
    .include = mesh_include,
    .net = mesh_net,
    .piece_count = mesh_piece_count,
    .piece = mesh_piece,
    .write_formula = mesh_write_formula,
    .renew = mesh_renew,
    .summary = "triangles and polygons from a file or a list, whose points may move linearly",
    .equation = "each triangle: p_0(t) + u (p_1(t) - p_0(t) + v (p_2(t) - p_1(t))), p_k(t) = "
                "scale points_k + t velocities_k, u and v in [0,1]",
    .source = NULL,
    .example = "mesh points=[[0,0,0],[1,0,0],[0,1,0],[0,0,1]] "
               "faces=[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]",
};

IMPINGE_SURFACE_PLUGIN("mesh", PLUGIN_VERSION, "Apache-2.0", "The Impinge authors", mesh_type);
