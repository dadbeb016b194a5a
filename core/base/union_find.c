/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/union_find.h"

#include <stdlib.h>

bool union_find_make(union_find *sets, size_t count)
{
    *sets = (union_find){malloc((count + 1) * sizeof *sets->up),
                         malloc((count + 1) * sizeof *sets->sign)};
    if (sets->up == NULL || sets->sign == NULL) return union_find_clear(sets), false;
    for (size_t i = 0; i < count; ++i) sets->up[i] = i, sets->sign[i] = 1;
    return true;
}

void union_find_clear(union_find *sets)
{
    free(sets->up);
    free(sets->sign);
    *sets = (union_find){0};
}

size_t union_find_bytes(size_t count)
{
    const union_find *sets = NULL;
    return count * (sizeof *sets->up + sizeof *sets->sign);
}

size_t union_find_root(union_find *sets, size_t member, int *sign)
{
    size_t root = member;
    signed char whole = 1;
    for (; sets->up[root] != root; root = sets->up[root])
        whole = (signed char)(whole * sets->sign[root]);
    if (sign != NULL) *sign = whole;
    while (member != root) {
        const size_t next = sets->up[member];
        const signed char part = sets->sign[member];
        sets->up[member] = root;
        sets->sign[member] = whole;
        whole = (signed char)(whole * part);
        member = next;
    }
    return root;
}

bool union_find_join(union_find *sets, size_t a, size_t b, int sign)
{
    int of_a, of_b;
    const size_t x = union_find_root(sets, a, &of_a), y = union_find_root(sets, b, &of_b);
    if (x == y) return of_a * of_b == sign;
    sets->up[y] = x;
    sets->sign[y] = (signed char)(of_a * of_b * sign);
    return true;
}
