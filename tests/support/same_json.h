/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SAME_JSON_H
#define TESTS_SUPPORT_SAME_JSON_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include <jansson.h>

/* Whether two JSON values are the same: members in the same order, numbers bit for bit. */
static inline bool same_json(const json_t *x, const json_t *y);

static inline bool same_json_objects(const json_t *x, const json_t *y)
{
    void *of_x = json_object_iter((json_t *)(uintptr_t)x);
    void *of_y = json_object_iter((json_t *)(uintptr_t)y);
    while (of_x != NULL && of_y != NULL) {
        if (strcmp(json_object_iter_key(of_x), json_object_iter_key(of_y)) != 0) return false;
        if (!same_json(json_object_iter_value(of_x), json_object_iter_value(of_y))) return false;
        of_x = json_object_iter_next((json_t *)(uintptr_t)x, of_x);
        of_y = json_object_iter_next((json_t *)(uintptr_t)y, of_y);
    }
    return of_x == NULL && of_y == NULL;
}

static inline bool same_json(const json_t *x, const json_t *y)
{
    if (json_typeof(x) != json_typeof(y)) return false;
    if (json_is_object(x)) return same_json_objects(x, y);
    if (json_is_real(x)) {
        const double a = json_real_value(x), b = json_real_value(y);
        return a == b && !signbit(a) == !signbit(b);
    }
    if (!json_is_array(x)) return json_equal(x, y);
    if (json_array_size(x) != json_array_size(y)) return false;
    for (size_t k = 0; k < json_array_size(x); ++k)
        if (!same_json(json_array_get(x, k), json_array_get(y, k))) return false;
    return true;
}

#endif
