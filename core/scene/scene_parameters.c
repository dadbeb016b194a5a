/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_parameters.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

bool scene_parameters_add(scene_parameters *p, const char *name, double lo, double hi)
{
    scene_parameter *grown = array_reserve(p->at, p->count, &p->capacity, sizeof *grown);
    if (grown == NULL) return false;
    p->at = grown;
    char *copy = strdup(name);
    if (copy == NULL) return false;
    grown[p->count++] = (scene_parameter){.name = copy, .lo = lo, .hi = hi};
    return true;
}

void scene_parameters_clear(scene_parameters *p)
{
    for (size_t k = 0; k < p->count; ++k) free(p->at[k].name);
    free(p->at);
    *p = (scene_parameters){.count = 0};
}

size_t scene_parameters_find(const scene_parameters *p, const char *name)
{
    size_t k = 0;
    while (k < p->count && strcmp(p->at[k].name, name) != 0) ++k;
    return k;
}

double scene_parameter_middle(double lo, double hi)
{
    const double middle = 0.5 * lo + 0.5 * hi;
    return middle < lo ? lo : middle > hi ? hi : middle;
}
