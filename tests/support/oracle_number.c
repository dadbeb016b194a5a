/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/oracle_number.h"

#include <stdlib.h>

enum { BITS = 200, BLOCK = 4096, BLOCKS_MAX = 256 };

/* Blocks never move, so numbers keep their addresses while the pool grows. */
static mpfi_t *blocks[BLOCKS_MAX];
static size_t used;

void num_forget(void) { used = 0; }

mpfi_ptr num_fresh(void)
{
    size_t block = used / BLOCK, index = used % BLOCK;
    if (block >= BLOCKS_MAX) abort();
    if (blocks[block] == NULL) {
        blocks[block] = malloc(BLOCK * sizeof(mpfi_t));
        if (blocks[block] == NULL) abort();
        for (size_t i = 0; i < BLOCK; ++i) mpfi_init2(blocks[block][i], BITS);
    }
    ++used;
    return blocks[block][index];
}

number num(double x)
{
    mpfi_ptr r = num_fresh();
    mpfi_set_d(r, x);
    return r;
}

number num_pi(void)
{
    mpfi_ptr r = num_fresh();
    mpfi_const_pi(r);
    return r;
}

#define UNARY(NAME, MPFI)                                                                          \
    number NAME(number x)                                                                          \
    {                                                                                              \
        mpfi_ptr r = num_fresh();                                                                  \
        MPFI(r, x);                                                                                \
        return r;                                                                                  \
    }
#define BINARY(NAME, MPFI)                                                                         \
    number NAME(number x, number y)                                                                \
    {                                                                                              \
        mpfi_ptr r = num_fresh();                                                                  \
        MPFI(r, x, y);                                                                             \
        return r;                                                                                  \
    }

UNARY(num_neg, mpfi_neg)
UNARY(num_abs, mpfi_abs)
UNARY(num_sqr, mpfi_sqr)
UNARY(num_sqrt, mpfi_sqrt)
UNARY(num_exp, mpfi_exp)
UNARY(num_log, mpfi_log)
UNARY(num_sin, mpfi_sin)
UNARY(num_cos, mpfi_cos)
UNARY(num_tan, mpfi_tan)
UNARY(num_asin, mpfi_asin)
UNARY(num_acos, mpfi_acos)
UNARY(num_atan, mpfi_atan)
UNARY(num_sinh, mpfi_sinh)
UNARY(num_cosh, mpfi_cosh)
UNARY(num_tanh, mpfi_tanh)
UNARY(num_cbrt, mpfi_cbrt)
BINARY(num_add, mpfi_add)
BINARY(num_sub, mpfi_sub)
BINARY(num_mul, mpfi_mul)
BINARY(num_div, mpfi_div)
BINARY(num_atan2, mpfi_atan2)
BINARY(num_hypot, mpfi_hypot)

number num_power(number x, unsigned n)
{
    number r = num(1);
    for (unsigned k = 0; k < n; ++k) r = num_mul(r, x);
    return r;
}

number num_poly(const double *coefficient, size_t count, size_t stride, number x)
{
    number r = num(0);
    for (size_t k = count; k-- > 0;) r = num_add(num_mul(r, x), num(coefficient[k * stride]));
    return r;
}

bool num_is_less(number x, number y) { return mpfr_less_p(&x->right, &y->left) != 0; }

bool num_is_bounded(number x) { return mpfi_bounded_p(x) != 0; }

double num_near(number x) { return mpfi_get_d(x); }
