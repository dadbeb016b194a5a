/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_NEAR_H
#define PLUGINS_COMMON_NEAR_H

#include <impinge/model.h>

/* Constants that no double holds
 * ==============================
 * A quotient or a root of parameters is known as a double and a bound of its error. An imp_model
 * of a constant says the same, and multiplies everything correctly; near_scale does it at the cost
 * of a product with an exact number. Make one from such a model, in create. */
typedef struct near_constant {
    double value, error; /* |exact - value| <= error */
} near_constant;

static inline near_constant near_of(imp_model constant)
{
    return (near_constant){constant.a, constant.e};
}

static inline near_constant near_exact(double value) { return (near_constant){value, 0}; }

/* x k. Lemma: |x k - x value| <= |x| error, and the rate of the difference is rate error. */
static inline imp_model near_scale(imp_model x, near_constant k)
{
    imp_model product = imp_scale(x, k.value);
    if (k.error == 0) return product;
    product.depends = x.depends; /* also if the value is 0, and the number only nearly */
    double slip =
        imp_round_up(imp_round_up(imp_interval_mag(imp_interval_make(x.lo, x.hi))) * k.error);
    /* A product of models may have a range with one infinite end. */
    if (!(slip < INFINITY)) return imp_mul(x, imp_known(k.value, k.error));
    product.e = imp_sum_up(product.e + slip);
    product.lo = imp_sum_down(product.lo - slip);
    product.hi = imp_sum_up(product.hi + slip);
    for (int j = 0; j < 3; ++j) {
        double more = imp_round_up(x.rate[j] * k.error);
        if (x.rate[j] > 0) product.rate[j] = imp_sum_up(product.rate[j] + more);
    }
    return imp_model_finish(product);
}

/* x + k. The exact k is within error of value: the middle moves by no more, the rates by
 * nothing. */
static inline imp_model near_shift(imp_model x, near_constant k)
{
    imp_model sum = imp_shift(x, k.value);
    if (k.error == 0) return sum;
    sum.e = imp_sum_up(sum.e + k.error);
    sum.lo = imp_sum_down(sum.lo - k.error);
    sum.hi = imp_sum_up(sum.hi + k.error);
    return imp_model_finish(sum);
}

#endif
