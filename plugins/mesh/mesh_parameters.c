/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_parameters.h"

#include "plugins/mesh/mesh_file.h"

static imp_status take_points(const imp_value *values, triangles *to, imp_create_error *why)
{
    triangles_fault fault = {0, "", 0};
    for (size_t k = 0; k < values[MESH_POINTS].extent[0]; ++k) {
        const imp_status status =
            triangles_add_point(to, values[MESH_POINTS].number + 3 * k, 0, &fault);
        if (status == IMP_STATUS_PARAMETER)
            imp_reject(why, MESH_POINTS, (int64_t)k, "%s", fault.text);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

static imp_status take_faces(const imp_value *values, triangles *to, imp_create_error *why)
{
    enum { FEW = 16 };
    int64_t few[FEW];
    const size_t corners = values[MESH_FACES].extent[1];
    int64_t *corner = corners <= FEW ? few : malloc(corners * sizeof *corner);
    imp_status status = corner != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
    for (size_t k = 0; status == IMP_STATUS_OK && k < values[MESH_FACES].extent[0]; ++k) {
        triangles_fault fault = {0, "", 0};
        for (size_t j = 0; j < corners; ++j)
            corner[j] = (int64_t)values[MESH_FACES].number[corners * k + j];
        status = triangles_add_face(to, corner, corners, 0, &fault);
        if (status == IMP_STATUS_PARAMETER)
            imp_reject(why, MESH_FACES, (int64_t)k, "%s", fault.text);
    }
    if (corner != few) free(corner);
    return status;
}

/* The factors of x, y and z. */
static imp_status take_scale(const imp_value *value, double scale[3], imp_create_error *why)
{
    if (value->count != 1 && value->count != 3)
        return imp_reject(why, MESH_SCALE, -1, "%zu factors, must be 1, or 3 for x, y and z",
                          value->count);
    for (size_t i = 0; i < 3; ++i) {
        scale[i] = value->number[value->count == 3 ? i : 0];
        if (scale[i] == 0) return imp_reject(why, MESH_SCALE, -1, "a factor of 0, must not be 0");
    }
    return IMP_STATUS_OK;
}

/* A point is scaled by one rounding, and is then exactly where it is. */
static imp_status apply_scale(const imp_value *values, triangles *to, imp_create_error *why)
{
    double scale[3];
    const imp_status status = take_scale(&values[MESH_SCALE], scale, why);
    for (size_t k = 0; k < 3 * to->point_count && status == IMP_STATUS_OK; ++k) {
        to->point[k] *= scale[k % 3];
        if (!(fabs(to->point[k]) <= TRIANGLES_FAR))
            return imp_reject(why, MESH_SCALE, -1,
                              "makes a coordinate %g, which must be from -1e100 to 1e100",
                              to->point[k]);
    }
    return status;
}

static imp_status take_shape(const imp_value *values, triangles *to, imp_create_error *why)
{
    const bool points = imp_is_given(&values[MESH_POINTS]),
               faces = imp_is_given(&values[MESH_FACES]);
    if (imp_is_given(&values[MESH_FILE]) && (points || faces))
        return imp_reject(why, MESH_FILE, -1, "a file and points or faces are given; give one");
    if (imp_is_given(&values[MESH_FILE]))
        return mesh_read_file(values[MESH_FILE].string[0], MESH_FILE, to, why);
    if (!points || !faces)
        return imp_reject(
            why, points ? MESH_FACES : MESH_POINTS, -1,
            "must be given, where no file is; a mesh has points and faces, or a file");
    const imp_status status = take_points(values, to, why);
    return status == IMP_STATUS_OK ? take_faces(values, to, why) : status;
}

/* Says in the host's words what was done that the author of the mesh may not expect. */
static void tell(const triangles *t, bool is_file, imp_create_error *why)
{
    char text[200];
    const size_t count = triangles_tell(t, text, sizeof text);
    if (count > 0) imp_note(why, is_file ? MESH_FILE : MESH_FACES, count, "%s", text);
}

imp_status mesh_take_shape(const imp_value *values, triangles *to, imp_create_error *why)
{
    to->why = why;
    imp_status status = take_shape(values, to, why);
    if (status == IMP_STATUS_OK) status = apply_scale(values, to, why);
    if (status == IMP_STATUS_OK) tell(to, imp_is_given(&values[MESH_FILE]), why);
    to->why = NULL;
    return status;
}

imp_status mesh_take_velocities(const imp_value *values, size_t points, double **velocity,
                                imp_create_error *why)
{
    const imp_value *v = &values[MESH_VELOCITIES];
    if (!imp_is_given(v)) return IMP_STATUS_OK;
    if (v->extent[0] != points)
        return imp_reject(why, MESH_VELOCITIES, -1, "%zu velocities for %zu points; give each one",
                          v->extent[0], points);
    if (*velocity == NULL) *velocity = malloc(v->count * sizeof **velocity);
    if (*velocity == NULL) return IMP_STATUS_INTERNAL;
    memcpy(*velocity, v->number, v->count * sizeof **velocity);
    return IMP_STATUS_OK;
}
