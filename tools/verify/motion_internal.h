/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_MOTION_INTERNAL_H
#define TOOLS_VERIFY_MOTION_INTERNAL_H

#include "tools/verify/motion.h"

/* What the files of motions share: motion_affine.c has single maps, motion.c chains of them,
 * motion_form.c what they do to distances, motion_rigid.c maps that keep distances. */

/* M and d as jets of t over some times, and at their middle. */
typedef struct affine {
    jet wide[3][4], centre[3][4];
    ld_interval offset[BOX_DIMS];
} affine;

/* Computes where an affine map takes 0, and where it takes the unit vectors, minus that. */
void affine_take(const part *p, double lo, double hi, jet room[], affine *a);

/* Applies `then` after `first`; without its shift, if `first` is a way. */
void affine_compose(const affine *then, affine *first, bool shifts);

/* Sets x, but for its offset, to the map that leaves all as it is, or takes all to 0. */
void affine_set(affine *x, bool is_one);

/* The affine map of a chain: base + the sum of s_k ways[k].of, |s_k| <= 1, but for `rest`, at each
 * time. Each s_k belongs to one clock. */
typedef struct layered {
    affine base;
    struct {
        size_t clock;
        affine of;
    } * ways; /* to be freed */
    size_t count;
    double rest[3][4];
} layered;

/* The affine map of a whole chain, whose ways the caller frees. */
enclosed motion_take_chain(const place *p, double lo, double hi, layered *all, bool *all_affine,
                           split *divide);

#endif
