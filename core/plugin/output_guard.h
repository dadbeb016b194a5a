/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_OUTPUT_GUARD_H
#define CORE_PLUGIN_OUTPUT_GUARD_H

#include <stdbool.h>
#include <stddef.h>

/* What a callback fills, between guards
 * =====================================
 * The memory that is lent ends at a page that cannot be accessed, so that a write past its end
 * crashes there and then. The bytes before it hold a pattern; a write into them is seen when the
 * memory is taken back. For sizes that are multiples of the alignment, up to OUTPUT_GUARD_MOST
 * bytes. */

enum {
    OUTPUT_GUARD_MOST = 8192,
    OUTPUT_GUARD_BEFORE = 1024 /* bytes that hold the pattern; more would take longer than a call */
};

typedef struct output_guard {
    unsigned char *end; /* NULL: no memory was to be had, and nothing is guarded */
    void *of;           /* what is lent a copy of; NULL: nothing is lent */
    size_t size;
} output_guard;

/* For as long as the process lasts. */
output_guard output_guard_make(void);

/* Memory for a callback to fill, which begins as a copy of the `size` bytes at `of`. */
void *output_guard_lend(output_guard *g, void *of, size_t size);

/* Copies what was filled back. False: something before it was written, too. */
bool output_guard_take_back(output_guard *g);

#endif
