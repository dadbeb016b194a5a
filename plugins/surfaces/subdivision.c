/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/mesh/mesh_parameters.h"
#include "plugins/subdivision/face.h"

/* A quad between quads, of whose corners one at most is extraordinary, is a piece. Other faces are
 * divided by steps of subdivision until they are such quads: two steps at most, as the first leaves
 * only quads, and the second one extraordinary corner each. So is a triangle of Loop's scheme, for
 * which one step is enough. */

enum { SCHEME = MESH_ROWS };

static const imp_parameter parameters[] = {
    [MESH_FILE] = ROW_MESH_FILE("control mesh: .obj, .off or .ply"),
    [MESH_POINTS] = ROW_MESH_POINTS,
    [MESH_FACES] =
        ROW_MESH_FACES("corners of each face, by number of the point, from 0; all faces go "
                       "round the same way"),
    [MESH_VELOCITIES] = ROW_MESH_VELOCITIES,
    [MESH_SCALE] = ROW_MESH_SCALE,
    [SCHEME] =
        IMP_ROW_OF(IMP_KIND_STRING, "scheme", "1", "\"catmull-clark\"", 0, 0, 0, 0, -INFINITY,
                   INFINITY, "rules of subdivision: catmull-clark, or loop, for triangles"),
};

enum { LEVELS = 3 };

typedef struct subdivision {
    face first; /* so that the whole can be asked like its first piece */
    control_mesh level[LEVELS];
    box_tables *loop; /* NULL: not Loop's scheme */
    face *pieces;
    size_t count, capacity;
    face_gauge *gauges;
    size_t gauge_count;
} subdivision;

static void subdivision_destroy(void *self)
{
    subdivision *s = self;
    for (int k = 0; k < LEVELS; ++k) control_clear(&s->level[k]);
    free(s->pieces);
    free(s->gauges);
    free(s->loop);
    free(s);
}

/* --- Pieces ----------------------------------------------------------------------------------- */

/* Whether all faces at a point are quads, or Loop's triangles. */
static bool is_among_alike(const control_mesh *m, uint32_t h)
{
    if (m->loop != NULL) return true;
    const control_point *p = &m->fan[m->corner[h]];
    uint32_t g = p->start;
    for (uint16_t k = 0; k < p->faces; ++k, g = control_turn_left(m, g))
        if (!control_is_quad(m, m->face[g])) return false;
    return true;
}

/* Whether a face is a piece; *start is then its half-edge from the extraordinary corner, or its
 * first. */
static bool is_piece(const control_mesh *m, uint32_t f, uint32_t *start, bool *is_regular)
{
    *start = m->first[f];
    *is_regular = true;
    for (uint32_t h = m->first[f]; h < m->first[f + 1]; ++h) {
        if (!is_among_alike(m, h)) return false;
        if (corner_is_regular(m, &m->fan[m->corner[h]])) continue;
        if (!*is_regular) return false;
        *is_regular = false;
        *start = h;
    }
    return true;
}

static bool add_piece(subdivision *s, face piece)
{
    if (s->count == s->capacity) {
        const size_t wanted = 2 * s->capacity + 64;
        face *grown = realloc(s->pieces, wanted * sizeof *grown);
        if (grown == NULL) return false;
        s->pieces = grown;
        s->capacity = wanted;
    }
    s->pieces[s->count++] = piece;
    return true;
}

/* A gauge that is not there yet, for pieces that will have one. */
static const face_gauge to_be_measured;

/* Makes pieces of the wanted faces of a level; those that are none stay wanted. *left: how many
 * faces these become, at least. */
static imp_status take_level(subdivision *s, const control_mesh *m, bool *wanted, size_t *left)
{
    *left = 0;
    for (uint32_t f = 0; f < m->face_count; ++f) {
        uint32_t start;
        bool is_regular;
        if (!wanted[f]) continue;
        wanted[f] = !is_piece(m, f, &start, &is_regular);
        if (wanted[f]) {
            *left += m->loop != NULL ? 4 : m->first[f + 1] - m->first[f];
        } else {
            if (!add_piece(s, (face){m, is_regular ? NULL : &to_be_measured, start}))
                return IMP_STATUS_INTERNAL;
            s->gauge_count += !is_regular;
        }
    }
    return IMP_STATUS_OK;
}

static imp_status divide(subdivision *s, imp_create_error *why)
{
    size_t left = 0;
    bool *wanted = malloc(s->level[0].face_count * sizeof *wanted);
    if (wanted == NULL) return IMP_STATUS_INTERNAL;
    for (size_t f = 0; f < s->level[0].face_count; ++f) wanted[f] = true;
    imp_status status = take_level(s, &s->level[0], wanted, &left);
    for (int k = 1; k < LEVELS && status == IMP_STATUS_OK && left > 0; ++k) {
        bool *finer = NULL;
        if (s->count + left > IMP_PIECES_MAX)
            status = imp_reject(why, -1, -1, "more than %zu faces after %d steps; divide the mesh",
                                IMP_PIECES_MAX, k);
        if (status == IMP_STATUS_OK)
            status = control_refine(&s->level[k - 1], wanted, &s->level[k], &finer);
        free(wanted);
        wanted = finer;
        if (status == IMP_STATUS_OK) status = take_level(s, &s->level[k], wanted, &left);
    }
    free(wanted);
    return status;
}

static imp_status measure(subdivision *s)
{
    size_t used = 0;
    if (s->gauge_count == 0) return IMP_STATUS_OK;
    s->gauges = malloc(s->gauge_count * sizeof *s->gauges);
    if (s->gauges == NULL) return IMP_STATUS_INTERNAL;
    for (size_t k = 0; k < s->count; ++k)
        if (s->pieces[k].gauge != NULL) {
            face_measure(&s->pieces[k], &s->gauges[used]);
            s->pieces[k].gauge = &s->gauges[used++];
        }
    return IMP_STATUS_OK;
}

/* --- Creation --------------------------------------------------------------------------------- */

static imp_status take_mesh(subdivision *s, const imp_value *values, imp_create_error *why)
{
    triangles given = {.keeps_faces = true};
    triangles_fault fault = {0, "", 0};
    double *velocity = NULL;
    imp_status status = mesh_take_shape(values, &given, why);
    if (status == IMP_STATUS_OK)
        status = mesh_take_velocities(values, given.point_count, &velocity, why);
    if (status != IMP_STATUS_OK) {
        triangles_clear(&given);
        return status;
    }
    status = control_begin(&s->level[0], &given, velocity, s->loop, &fault);
    if (status == IMP_STATUS_PARAMETER && imp_is_given(&values[MESH_FILE]))
        imp_reject(why, MESH_FILE, -1, "'%.60s': %s (numbers from 0)", values[MESH_FILE].string[0],
                   fault.text);
    else if (status == IMP_STATUS_PARAMETER)
        imp_reject(why, MESH_FACES, -1, "%s", fault.text);
    return status;
}

static imp_status take_scheme(subdivision *s, const imp_value *values, imp_create_error *why)
{
    const char *name = values[SCHEME].string[0];
    if (strcmp(name, "catmull-clark") == 0) return IMP_STATUS_OK;
    if (strcmp(name, "loop") != 0)
        return imp_reject(why, SCHEME, -1, "'%.60s' is not a scheme; catmull-clark and loop are",
                          name);
    s->loop = malloc(sizeof *s->loop);
    if (s->loop == NULL) return IMP_STATUS_INTERNAL;
    box_make_tables(s->loop);
    return IMP_STATUS_OK;
}

static imp_status subdivision_create(const imp_value *values, void **self, imp_create_error *why)
{
    subdivision *s = calloc(1, sizeof *s);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    imp_status status = take_scheme(s, values, why);
    if (status == IMP_STATUS_OK) status = take_mesh(s, values, why);
    if (status == IMP_STATUS_OK) status = divide(s, why);
    if (status == IMP_STATUS_OK) status = measure(s);
    if (status == IMP_STATUS_OK) {
        for (int k = 0; k < LEVELS; ++k) control_settle(&s->level[k]);
        s->first = s->pieces[0];
        *self = s;
    } else {
        subdivision_destroy(s);
    }
    return status;
}

static size_t subdivision_piece_count(const void *self)
{
    return ((const subdivision *)self)->count;
}

static const void *subdivision_piece(const void *self, size_t k)
{
    return &((const subdivision *)self)->pieces[k];
}

/* --- One piece -------------------------------------------------------------------------------- */

static void subdivision_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static imp_status subdivision_include(const void *self, const imp_region *region,
                                      imp_model model[3])
{
    return face_include(self, region, model);
}

static imp_status subdivision_rate(const void *self, const imp_region *region,
                                   imp_rate_matrix *rates)
{
    imp_model model[3];
    const imp_status status = face_include(self, region, model);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i)
        memcpy(rates->m[i], model[i].rate, sizeof rates->m[i]);
    return status;
}

static imp_status subdivision_net(const void *self, const imp_region *region, imp_net *net)
{
    return face_net(self, region, net);
}

static imp_status subdivision_write_formula(const void *self, const imp_text_sink *to)
{
    return face_write(self, to);
}

static const imp_surface_type subdivision_type = {
    IMP_TYPE_FIELDS(imp_surface_type, "subdivision", subdivision, subdivision_destroy),
    .domain = subdivision_domain,
    .eval = face_eval,
    .rate = subdivision_rate,
    .include = subdivision_include,
    .net = subdivision_net,
    .piece_count = subdivision_piece_count,
    .piece = subdivision_piece,
    .write_formula = subdivision_write_formula,
    .summary = "Catmull-Clark surface of a control mesh of any polygons, or Loop surface of one of "
               "triangles; points may move linearly",
    .equation =
        "limit of subdivision, points_k + t velocities_k; at a border: of its cubic B-spline, "
        "which ends at corners; each quad: u and v in [0,1]; each triangle: as bezier-triangle",
    .source =
        "E. Catmull, J. Clark, Recursively generated B-spline surfaces, Computer-Aided Design "
        "1978; C. Loop, Smooth subdivision surfaces based on triangles, 1987; J. Stam, SIGGRAPH "
        "1998 and 1999",
    .example = "subdivision points=[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],"
               "[-1,1,1],[1,1,1]] "
               "faces=[[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]]",
};

IMPINGE_SURFACE_PLUGIN("subdivision", PLUGIN_VERSION, "Apache-2.0", "The Impinge authors",
                       subdivision_type);
