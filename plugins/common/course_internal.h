/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_COURSE_INTERNAL_H
#define PLUGINS_COMMON_COURSE_INTERNAL_H

#include "plugins/common/course.h"

/* The input of course_read. */
typedef struct course_question {
    const imp_value *v; /* those of the course */
    int first;          /* row of the type's table that v begins with */
    unit_kind kind;
    imp_create_error *why;
    const imp_parameter *rows;
} course_question;

/* Returns how many numbers the course has at a time. */
static inline size_t course_width(const course_question *q)
{
    return q->kind == UNIT_ANGLE ? 1 : 3;
}

/* Reads a table, of times and values or of a file, whose rows course_read has checked to be given
 * together. On failure c is to be cleared. */
imp_status course_read_table(course *c, const course_question *q);

#endif
