/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_PLACE_H
#define CORE_BASE_PLACE_H

#include "core/base/status.h"

/* Where something stands in what a person wrote
 * ==========================================
 * A chain from the inside out, on the stack of those who read: each level hands a place to
 * the next, and an error is reported with the whole chain in front.
 *
 *     scene.json: /bodies/0/surfaces/2/radius: found -1, allowed > 0      (JSON pointer)
 *     a: radius: found -1, allowed > 0                                    (command line) */

typedef struct place {
    const struct place *up; /* NULL: the outermost */
    const char *key;        /* NULL: `index` counts */
    size_t index;
    bool document;    /* a whole document: below it, JSON pointers */
    bool argument;    /* an argument, or a stage of it: below it, words */
    const char *noun; /* of an argument that is named or counted, "body" or "surface"; else NULL */
} place;

/* Makes the place of a document called `name`. */
place place_document(const char *name);

/* Makes the place of an argument called `name` or, with `up`, of a stage of that argument. */
place place_argument(const place *up, const char *name);

/* Make places of arguments that only an error writes: "body 'NAME'", of which 80 bytes, and
 * "surface 2". The name is not copied. */
place place_named(const place *up, const char *noun, const char *name);
place place_counted(const place *up, const char *noun, size_t index);

/* Makes the place of the member `key`, or element `index`, of what stands at `up`. */
place place_key(const place *up, const char *key);
place place_index(const place *up, size_t index);

/* Does what error_set does, with the place in front of the text. */
imp_code place_error(const place *at, imp_error *error, imp_code code, const char *format, ...)
    STATUS_PRINTF_(4, 5);

#endif
