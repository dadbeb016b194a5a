/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_READ_STATEMENT_H
#define TESTS_SUPPORT_READ_STATEMENT_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/suite.h"
#include "tools/verify/look.h"

/* The statement of a certificate as impinge-verify reads it, with what it keeps of its surfaces. */

typedef struct scene {
    statement says;
    memory *known;
    jet *room;
    memo *memos;
} scene;

static inline scene scene_made(const char *text)
{
    scene s;
    input in;
    FILE *file = fmemopen((void *)(uintptr_t)text, strlen(text), "rb");
    ck_assert_ptr_nonnull(file);
    input_begin(&in, file);
    ck_assert_msg(statement_read(&s.says, &in), "%s", in.fault);
    fclose(file);
    s.known = calloc(1, sizeof *s.known);
    s.room = malloc((2 * (size_t)s.says.steps + 1) * sizeof *s.room);
    s.memos = calloc(s.says.stage_count + 1, sizeof *s.memos);
    return s;
}

static inline void scene_free(scene *s)
{
    for (size_t k = 0; k < s->says.stage_count; ++k) free(s->memos[k].value);
    free(s->memos);
    free(s->room);
    look_free(s->known);
    statement_free(&s->says);
}

#endif
