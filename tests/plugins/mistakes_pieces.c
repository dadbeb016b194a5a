/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>
#include <string.h>

#include "stack.h"

/* The three slabs of stack.h, whose pieces are wrong only after many calls, or whose whole has no
 * shape. */

/* --- After 40 calls --------------------------------------------------------------------------- */

static const void *swapped_piece(const void *self, size_t k)
{
    static int calls;
    (void)self;
    return &stack_slabs[++calls > 40 && k < 2 ? 1 - k : k];
}

static size_t shrinking_count(const void *self)
{
    static int calls;
    (void)self;
    return ++calls > 40 ? 2 : 3;
}

/* --- After 1000 calls of eval ----------------------------------------------------------------- */

static int evaluated;

static imp_status counted_eval(const void *self, size_t n, const double *p, double *x,
                               double *error)
{
    ++evaluated;
    return slab_eval(self, n, p, x, error);
}

static const void *used_piece(const void *self, size_t k)
{
    (void)self;
    return &stack_slabs[evaluated > 1000 ? 0 : k];
}

/* --- A whole without a shape ------------------------------------------------------------------ */

typedef struct whole {
    uint32_t mark;
    slab piece[3];
} whole;

enum { MARK = 0x77686f6c };

static imp_status whole_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    whole *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    *made = (whole){.mark = MARK};
    for (int k = 0; k < 3; ++k) made->piece[k].height = values[0].number[0] + k;
    *self = made;
    return IMP_STATUS_OK;
}

static size_t whole_count(const void *self) { return ((const whole *)self)->mark == MARK ? 3 : 0; }

static const void *whole_piece(const void *self, size_t k)
{
    return &((const whole *)self)->piece[k];
}

/* The host asks pieces alone. */
static void expect_piece(const void *self)
{
    uint32_t mark;
    memcpy(&mark, self, sizeof mark);
    if (mark == MARK) abort();
}

static void piece_domain(const void *self, double lo[3], double hi[3])
{
    expect_piece(self);
    slab_domain(self, lo, hi);
}

static imp_status piece_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    expect_piece(self);
    return slab_eval(self, n, p, x, error);
}

static imp_status piece_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    expect_piece(self);
    return slab_rate(self, region, rates);
}

static imp_status piece_include(const void *self, const imp_region *region, imp_model model[3])
{
    expect_piece(self);
    return slab_include(self, region, model);
}

static const imp_surface_type swapped =
    STACK_TYPE("pieces_swapped_late", slab_domain, stack_count, swapped_piece);
static const imp_surface_type left_out =
    STACK_TYPE("pieces_left_out_late", slab_domain, shrinking_count, stack_piece);
static const imp_surface_type used = {
    .struct_size = sizeof(imp_surface_type),
    .parameter_count = 1,
    .parameter_size = sizeof(imp_parameter),
    .name = "pieces_change_with_use",
    .summary = "three squares",
    .equation = "(u, v, k + t)",
    .example = "pieces_change_with_use",
    .parameters = slab_table,
    .create = slab_create,
    .destroy = slab_destroy,
    .domain = slab_domain,
    .eval = counted_eval,
    .rate = slab_rate,
    .include = slab_include,
    .piece_count = stack_count,
    .piece = used_piece,
};
static const imp_surface_type shapeless = {
    .struct_size = sizeof(imp_surface_type),
    .parameter_count = 1,
    .parameter_size = sizeof(imp_parameter),
    .name = "pieces_of_shapeless",
    .summary = "three squares",
    .equation = "(u, v, height + k + t)",
    .example = "pieces_of_shapeless height=1",
    .parameters = slab_table,
    .create = whole_create,
    .destroy = free,
    .domain = piece_domain,
    .eval = piece_eval,
    .rate = piece_rate,
    .include = piece_include,
    .piece_count = whole_count,
    .piece = whole_piece,
};

static const imp_surface_type *const types[] = {&swapped, &left_out, &used, &shapeless};
static const imp_surface_factory factory = {sizeof factory, sizeof types / sizeof *types, types};

static const void *get_factory(const char *id)
{
    return strcmp(id, IMP_SURFACE_FACTORY) == 0 ? &factory : NULL;
}
IMPINGE_PLUGIN("mistakes_pieces", "1.0", "Apache-2.0", "tests", get_factory);
