/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_parameters.h"

#include "plugins/mesh/mesh_file.h"

static imp_status take_points(const imp_value *values, triangles *to, imp_create_error *why)
{
    triangles_fault fault = {0, ""};
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
    const size_t corners = values[MESH_FACES].extent[1];
    int64_t *corner = malloc(corners * sizeof *corner);
    imp_status status = corner != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
    for (size_t k = 0; status == IMP_STATUS_OK && k < values[MESH_FACES].extent[0]; ++k) {
        triangles_fault fault = {0, ""};
        for (size_t j = 0; j < corners; ++j)
            corner[j] = (int64_t)values[MESH_FACES].number[corners * k + j];
        status = triangles_add_face(to, corner, corners, 0, &fault);
        if (status == IMP_STATUS_PARAMETER)
            imp_reject(why, MESH_FACES, (int64_t)k, "%s", fault.text);
    }
    free(corner);
    return status;
}

imp_status mesh_take_shape(const imp_value *values, triangles *to, imp_create_error *why)
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

imp_status mesh_take_velocities(const imp_value *values, size_t points, double **velocity,
                                imp_create_error *why)
{
    const imp_value *v = &values[MESH_VELOCITIES];
    *velocity = NULL;
    if (!imp_is_given(v)) return IMP_STATUS_OK;
    if (v->extent[0] != points)
        return imp_reject(why, MESH_VELOCITIES, -1, "%zu velocities for %zu points; give each one",
                          v->extent[0], points);
    *velocity = malloc(v->count * sizeof **velocity);
    if (*velocity == NULL) return IMP_STATUS_INTERNAL;
    memcpy(*velocity, v->number, v->count * sizeof **velocity);
    return IMP_STATUS_OK;
}
