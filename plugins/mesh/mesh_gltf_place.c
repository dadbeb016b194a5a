/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_gltf_place.h"

#include <math.h>
#include <stddef.h>

const gltf_place gltf_place_identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/* `count` numbers into a list that has its presets; false: anything else stands there. */
static bool read_numbers(const json_t *node, const char *key, size_t count, double *numbers)
{
    const json_t *list = json_object_get(node, key);
    if (list == NULL) return true;
    if (!json_is_array(list) || json_array_size(list) != count) return false;
    for (size_t k = 0; k < count; ++k) {
        const json_t *number = json_array_get(list, k);
        if (!json_is_number(number)) return false;
        numbers[k] = json_number_value(number);
    }
    return true;
}

/* The matrix in the document goes column by column. */
static bool read_matrix(const json_t *node, gltf_place *own)
{
    double m[16];
    if (!read_numbers(node, "matrix", 16, m)) return false;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) own->at[i][j] = m[4 * j + i];
    return true;
}

static bool read_parts(const json_t *node, gltf_place *own)
{
    double shift[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    if (!read_numbers(node, "translation", 3, shift) || !read_numbers(node, "rotation", 4, q) ||
        !read_numbers(node, "scale", 3, scale))
        return false;
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0)) return false;
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    const double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) own->at[i][j] = turn[i][j] * scale[j];
        own->at[i][3] = shift[i];
    }
    return true;
}

bool gltf_place_under(const gltf_place *above, const json_t *node, gltf_place *place)
{
    gltf_place own;
    const bool has_matrix = json_object_get(node, "matrix") != NULL;
    if (!(has_matrix ? read_matrix(node, &own) : read_parts(node, &own))) return false;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {
            double sum = j == 3 ? above->at[i][3] : 0;
            for (int k = 0; k < 3; ++k) sum += above->at[i][k] * own.at[k][j];
            place->at[i][j] = sum;
        }
    return true;
}

void gltf_place_point(const gltf_place *place, const double x[3], double y[3])
{
    for (int i = 0; i < 3; ++i) {
        const double *row = place->at[i];
        y[i] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3];
    }
}

bool gltf_place_is_turned(const gltf_place *place)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += place->at[0][i] *
               (place->at[1][j] * place->at[2][k] - place->at[1][k] * place->at[2][j]);
    }
    return sum < 0;
}
