/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear.h"
#include "plugins/common/publish.h"
#include "plugins/mesh/mesh_file.h"

/* Each triangle is a piece: that of the type for single triangles, made of the points when it is asked
 * for something. */

enum { FILE_NAME, POINTS, FACES, VELOCITIES };

static const imp_parameter parameters[] = {
    [FILE_NAME] = IMP_ROW_OF(IMP_STRING, "file", "1", NULL, IMP_OPTIONAL | IMP_FILE, 0, 0, 0,
                             -INFINITY, INFINITY,
                             "triangles or polygons: .obj, .off, or .stl (text or binary)"),
    [POINTS] = IMP_ROW("points", "length", NULL, IMP_OPTIONAL, 2, 0, 3, -TRIANGLES_FAR,
                       TRIANGLES_FAR, "points [x,y,z] at t = 0, in place of a file"),
    [FACES] = IMP_ROW_OF(IMP_INTEGER, "faces", "1", NULL, IMP_OPTIONAL, 2, 0, 0, 0, 0x1p32,
                         "corners of each face, by number of the point, from 0; polygons are plane "
                         "and convex"),
    [VELOCITIES] = IMP_ROW("velocities", "length/time", NULL, IMP_OPTIONAL, 2, 0, 3,
                           -TRIANGLES_FAR, TRIANGLES_FAR,
                           "velocity of each point; default: at rest"),
};

typedef struct mesh mesh;

/* What all callbacks but create, destroy and those for pieces get as `self`. */
typedef struct piece {
    const mesh *of;
    uint32_t corner[3];
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

/* --- Creation ------------------------------------------------------------------------------- */

static imp_status take_points(const imp_value *values, triangles *to, imp_create_error *why)
{
    triangles_fault fault = {0, ""};
    for (size_t k = 0; k < values[POINTS].extent[0]; ++k) {
        const imp_status status =
            triangles_add_point(to, values[POINTS].number + 3 * k, 0, &fault);
        if (status == IMP_PARAMETER) imp_reject(why, POINTS, (int64_t)k, "%s", fault.text);
        if (status != IMP_OK) return status;
    }
    return IMP_OK;
}

static imp_status take_faces(const imp_value *values, triangles *to, imp_create_error *why)
{
    const size_t corners = values[FACES].extent[1];
    int64_t *corner = malloc(corners * sizeof *corner);
    imp_status status = corner != NULL ? IMP_OK : IMP_INTERNAL;
    for (size_t k = 0; status == IMP_OK && k < values[FACES].extent[0]; ++k) {
        triangles_fault fault = {0, ""};
        for (size_t j = 0; j < corners; ++j)
            corner[j] = (int64_t)values[FACES].number[corners * k + j];
        status = triangles_add_face(to, corner, corners, 0, &fault);
        if (status == IMP_PARAMETER) imp_reject(why, FACES, (int64_t)k, "%s", fault.text);
    }
    free(corner);
    return status;
}

static imp_status take_shape(const imp_value *values, triangles *to, imp_create_error *why)
{
    const bool points = imp_is_given(&values[POINTS]), faces = imp_is_given(&values[FACES]);
    if (imp_is_given(&values[FILE_NAME]) && (points || faces))
        return imp_reject(why, FILE_NAME, -1, "a file and points or faces are given; give one");
    if (imp_is_given(&values[FILE_NAME]))
        return mesh_read_file(values[FILE_NAME].string[0], FILE_NAME, to, why);
    if (!points || !faces)
        return imp_reject(why, points ? FACES : POINTS, -1,
                          "must be given, where no file is; a mesh has points and faces, or a file");
    const imp_status status = take_points(values, to, why);
    return status == IMP_OK ? take_faces(values, to, why) : status;
}

static imp_status take_velocities(const imp_value *values, mesh *m, imp_create_error *why)
{
    const imp_value *v = &values[VELOCITIES];
    if (!imp_is_given(v)) return IMP_OK;
    if (v->extent[0] != m->triangles.point_count)
        return imp_reject(why, VELOCITIES, -1, "%zu velocities for %zu points; give each one",
                          v->extent[0], m->triangles.point_count);
    m->velocity = malloc(v->count * sizeof *m->velocity);
    if (m->velocity == NULL) return IMP_INTERNAL;
    memcpy(m->velocity, v->number, v->count * sizeof *m->velocity);
    return IMP_OK;
}

static imp_status make_pieces(mesh *m)
{
    m->pieces = malloc(m->triangles.count * sizeof *m->pieces);
    if (m->pieces == NULL) return IMP_INTERNAL;
    for (size_t k = 0; k < m->triangles.count; ++k) {
        m->pieces[k].of = m;
        memcpy(m->pieces[k].corner, m->triangles.corner + 3 * k, sizeof m->pieces[k].corner);
    }
    m->first = m->pieces[0];
    free(m->triangles.corner);
    m->triangles.corner = NULL;
    return IMP_OK;
}

static imp_status mesh_create(const imp_value *values, void **self, imp_create_error *why)
{
    mesh *m = calloc(1, sizeof *m);
    if (m == NULL) return IMP_INTERNAL;
    imp_status status = take_shape(values, &m->triangles, why);
    if (status == IMP_OK) status = take_velocities(values, m, why);
    if (status == IMP_OK) status = make_pieces(m);
    if (status == IMP_OK)
        *self = m;
    else
        mesh_destroy(m);
    return status;
}

static size_t mesh_piece_count(const void *self) { return ((const mesh *)self)->triangles.count; }

static const void *mesh_piece(const void *self, size_t k)
{
    return &((const mesh *)self)->pieces[k];
}

/* --- One triangle ----------------------------------------------------------------------------- */

static void set_corners(double term[LINEAR_TERMS], const double *list, const uint32_t *corner, int i)
{
    const double a = list[3 * (size_t)corner[0] + (size_t)i];
    const double b = list[3 * (size_t)corner[1] + (size_t)i];
    const double c = list[3 * (size_t)corner[2] + (size_t)i];
    term[LINEAR_1] = a;
    term[LINEAR_U] = b - a;
    term[LINEAR_V] = 0;
    term[LINEAR_UV] = c - b;
}

static linear triangle_of(const void *self)
{
    const piece *p = self;
    linear f;
    for (int i = 0; i < 3; ++i) {
        set_corners(f.still[i], p->of->triangles.point, p->corner, i);
        if (p->of->velocity != NULL)
            set_corners(f.motion[i], p->of->velocity, p->corner, i);
        else
            memset(f.motion[i], 0, sizeof f.motion[i]);
    }
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

static const imp_surface_type mesh_type = {
    IMP_TYPE_FIELDS(imp_surface_type, "mesh", mesh, mesh_destroy),
    .domain = mesh_domain,
    .eval = mesh_eval,
    .rate = mesh_rate,
    .include = mesh_include,
    .net = mesh_net,
    .piece_count = mesh_piece_count,
    .piece = mesh_piece,
    .summary = "triangles and polygons from a file or a list, whose points may move linearly",
    .equation = "each triangle: p_0(t) + u (p_1(t) - p_0(t) + v (p_2(t) - p_1(t))), p_k(t) = points_k "
                "+ t velocities_k, u and v in [0,1]",
    .source = NULL,
    .example = "mesh points=[[0,0,0],[1,0,0],[0,1,0],[0,0,1]] "
               "faces=[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]",
};

IMPINGE_SURFACE_PLUGIN("mesh", PLUGIN_VERSION, "Apache-2.0", "The Impinge authors", mesh_type);
