/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_SINC_H
#define PLUGINS_COMMON_SINC_H

#include <impinge/model.h>

/* sin x / x and (1 - cos x) / x
 * =============================
 * sinc and cosc, 1 and 0 at 0: the end of an arc of length 1 that turns by x. They are the means of
 * cos(x w) and sin(x w) over w in [0, 1], so their k-th derivatives are at most the mean of w^k,
 * 1 / (k+1); around m they follow their cubics within r^4 / (5 4!). If f is one of them, the k-th
 * derivative of x f is x f^(k) + k f^(k-1), and the k-th derivative of sin x, or of 1 - cos x. */

/* sin x / x. */
imp_model sinc_of(imp_model x);

/* (1 - cos x) / x. */
imp_model sinc_cosc(imp_model x);

#endif
