/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_GUARD_H
#define TOOLS_CHECK_GUARD_H

#include <stdbool.h>
#include <stddef.h>

/* Buffers that end at a guard page
 * ================================
 * The data ends directly before a page that cannot be read or written, so that an access one byte
 * past the end crashes, and the call that made it is known. For data whose size is a multiple of
 * its alignment. */

typedef struct guard {
    char *end; /* NULL: there is none */
    size_t size;
} guard;

/* Allocates this many bytes. False: no memory. */
bool guard_make(guard *g, size_t room);

/* Returns a copy of the bytes at the end; earlier content is overwritten. `data` may be NULL: then
 * the bytes are 0xff. NULL: not enough room. */
void *guard_place(guard *g, const void *data, size_t size);

/* From now on none of it can be read or written. */
void guard_hide(guard *g);

void guard_free(guard *g);

#endif
