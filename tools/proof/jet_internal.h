/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_JET_INTERNAL_H
#define TOOLS_PROOF_JET_INTERNAL_H

#include "tools/proof/jet.h"

/* The first variable after j that x may depend on, or n or more. */
static inline int jet_next(const jet *x, int j)
{
    do ++j;
    while (j < x->n && !jet_has(x, j));
    return j;
}

static inline int jet_first(const jet *x) { return jet_next(x, -1); }

/* A jet of two others, whose derivatives are 0 so far. */
static inline jet jet_joined(const jet *x, const jet *y, ld_interval value)
{
    return (jet){.n = x->n,
                 .bends = x->bends < y->bends ? x->bends : y->bends,
                 .on = x->on | y->on,
                 .is_undefined = x->is_undefined || y->is_undefined,
                 .v = value};
}

/* Returns g(x), by g and its first two derivatives: g(x)'' = g'' x' x' + g' x''. What x does not
 * depend on stays 0, however steep g is. */
jet jet_composed(const jet *x, const ld_interval g[3]);

#endif
