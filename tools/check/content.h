/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_CONTENT_H
#define TOOLS_CHECK_CONTENT_H

#include <impinge/impinge.h>

#include "tools/check/list.h"

/* The content of a plugin's file
 * ==============================
 * Its name and types, and for each type the texts of stages that its create accepts. */

enum { CONTENT_TYPES = 64 };

typedef struct content_type {
    imp_type_kind kind;
    char name[80];
    char stage[CHECK_STAGES][800]; /* those that work; empty: none */
    char example_fault[1000];      /* why the example does not; empty: it does */
} content_type;

typedef struct content {
    bool is_taken;     /* the host accepts the file */
    char reason[1000]; /* why not */
    char plugin[200];  /* name, version, licence */
    char name[80], version[80];
    size_t count;
    content_type type[CONTENT_TYPES];
} content;

/* Lists, in a child, what the host finds in the file. *shared is from child_memory. */
child_fate content_list(const char *file, double seconds, content *shared);

#endif
