/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_TEXT_H
#define PLUGINS_MESH_MESH_TEXT_H

#include "plugins/mesh/triangles.h"

/* Lines of words: what the formats that are text have in common. A number has a point in every
 * locale. */

typedef struct mesh_text {
    const char *at, *end; /* what is left of the file */
    size_t line;          /* of the words, from 1 */
    char *words;          /* the line, cut into words */
    char *next;           /* the words that are left; NULL: none */
    size_t capacity;
    bool out_of_memory;
} mesh_text; /* begins with at and end set; mesh_text_clear frees */

/* The next line that has words, comments from '#' on left out. `continues`: a line that ends in a
 * backslash goes on in the next. False: there is none, or no memory. */
bool mesh_text_line(mesh_text *text, bool continues);

/* The next word of the line; NULL: no more. */
char *mesh_text_word(mesh_text *text);

/* What stands in a word, all of it. */
bool mesh_text_number(const char *word, double *x);
bool mesh_text_integer(const char *word, int64_t *k); /* below 2^53 in magnitude */

/* Three numbers that follow in the line. */
imp_status mesh_text_point(mesh_text *text, double x[3], triangles_fault *fault);

void mesh_text_clear(mesh_text *text);

/* The end of a reader of lines: IMP_STATUS_INTERNAL if a line was not read for lack of memory. */
imp_status mesh_text_status(const mesh_text *text);

/* The corners of one face, collected. */
typedef struct mesh_corners {
    int64_t *at;
    size_t count, capacity;
} mesh_corners; /* begins as {0}; the caller frees `at` */

bool mesh_corners_add(mesh_corners *corners, int64_t k); /* false: no memory */

#endif
