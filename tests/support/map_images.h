/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MAP_IMAGES_H
#define TESTS_SUPPORT_MAP_IMAGES_H

#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"

/* Maps of the build tree, and where they take points. */

/* Lives as long as the process: instances need their plugins. */
static inline imp_registry *map_registry(void)
{
    static imp_registry *registry;
    if (registry == NULL) registry = built_registry();
    return registry;
}

static inline instance map(const char *type, const char *parameters)
{
    uint64_t random = suite_seed();
    return instance_make(map_registry(), type, parameters, &random);
}

static inline void image(const instance *made, double x, double y, double z, double t,
                         double out[3])
{
    const double p[4] = {x, y, z, t};
    ck_assert_int_eq(made->map->eval(made->self, 1, p, out, NULL), IMP_STATUS_OK);
}

static inline void expect_point(const double x[3], double a, double b, double c, double slip)
{
    const double want[3] = {a, b, c};
    for (int i = 0; i < 3; ++i)
        ck_assert_msg(fabs(x[i] - want[i]) <= slip, "coordinate %d: %.17g, not %.17g", i, x[i],
                      want[i]);
}

static inline void expect_image(const instance *made, const double p[4], const double want[3],
                                double slip)
{
    double x[3];
    image(made, p[0], p[1], p[2], p[3], x);
    expect_point(x, want[0], want[1], want[2], slip);
}

#endif
