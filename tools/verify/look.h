/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_LOOK_H
#define TOOLS_VERIFY_LOOK_H

#include "tools/verify/orbit.h"

/* Enclosures, and those that were computed before */

enum {
    KEPT = 1024,
    KEPT_NETS = 1024,
    KEPT_MOTIONS = 256,
    KEPT_CHANGES = 16,
    KEPT_ORBITS = 64,
    KEPT_CIRCLES = 128
}; /* powers of 2 */

typedef struct kept {
    const chain *chain; /* NULL: none */
    size_t piece, maps;
    uint64_t stamp; /* of the values of clocks, here and below */
    box3 where;
    enclosed result;
    split divide;
    double c[3];
    jet box[3], centre[3]; /* about the point c */
} kept;

/* A net of a part, before the maps that are left to do. */
typedef struct kept_net {
    const part *part;   /* NULL: none */
    const chain *chain; /* NULL: before all maps */
    size_t maps;
    uint64_t stamp; /* 0, where it depends on none but T */
    box3 where;     /* of t [0, 0], where the part does not move by itself */
    enclosed result;
    split divide;
    net net;
} kept_net;

typedef struct kept_motion {
    const chain *chain; /* NULL: none */
    size_t maps;
    uint64_t stamp;
    double lo, hi;
    enclosed result;
    split divide;
    bool is_affine;
    motion motion; /* its ways to be freed */
} kept_motion;

typedef struct kept_changes {
    const chain *chain; /* NULL: none */
    size_t maps;
    uint64_t stamp;
    double lo, hi, c[3];
    ld_interval e[3][3];
    double w[3];
    form_changes found;
} kept_changes;

typedef struct kept_orbit {
    const chain *chain; /* NULL: none */
    size_t maps;
    uint64_t stamp;
    double lo, hi;
    orbit orbit;
    bool has_rows;
    orbit_rows rows; /* along one direction */
} kept_orbit;

/* A shape's box of v and t, all u of it. */
typedef struct kept_circle {
    const part *part; /* NULL: none */
    double lo[2], hi[2], c[VARIABLES];
    jet wide[CIRCLE_PARTS][3], centre[CIRCLE_PARTS][3]; /* about the point c */
} kept_circle;

typedef struct memory {
    kept jets[KEPT];
    kept_net nets[KEPT_NETS];
    kept_motion motions[KEPT_MOTIONS];
    kept_changes changes[KEPT_CHANGES];
    kept_orbit orbits[KEPT_ORBITS];
    kept_circle circles[KEPT_CIRCLES];
} memory;

void look_free(memory *all); /* may be NULL */

/* What is found may be overwritten by another call. */

/* Encloses a box of a piece in jets. */
const kept *look_jets(memory *all, const place *of, const box3 *where);

/* Bounds how much a quadratic form about c, and w.x, change over some times. */
const form_changes *look_changes(memory *all, const place *of, double lo, double hi,
                                 const double c[3], ld_interval e[3][3], const double w[3]);

/* Takes all circles of a shape, before its maps, over the v and t of a box. NULL: it is none in the
 * box, or follows another clock. */
const kept_circle *look_circle(memory *all, const place *of, const box3 *where);

/* Takes a chain by the map that turns most in some times. */
const orbit *look_orbit(memory *all, const place *of, double lo, double hi);

/* Its rows along a direction. Precondition: it is known. */
const orbit_rows *look_rows(memory *all, const place *of, double lo, double hi, const double n[3]);

/* Encloses a box of a piece in control points. ENCLOSED, with a net NULL: it has no bounds. */
enclosed look_net(memory *all, const place *of, const box3 *where, form *found, split *divide);

#endif
