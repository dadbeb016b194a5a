/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/made_certificate.h"

/* impinge-verify on formulas of several parts, one of which holds a box while others are only
 * partly in it: each of them counts. */

static const uint8_t leaf_tree[] = {0, 1, 0, 7};

/* A plate at z = 0 or as its map says, and a surface whose parts are 20 above it; but one is where
 * NEAR says. */
typedef struct parted {
    const char *from, *to, *map, *shape, *near, *far;
} parted;

static const char narrower[] = "t in [-1, 0.5]; u in [-1, 1]; v in [-2, 2]; u; v; 20 | "
                               "t in [0.5, 2]; u in [-1, 1]; v in [-1, 1]; u; v; NEAR";

static certificate made_of(const parted *p, const char *near)
{
    char text[1200];
    snprintf(text, sizeof text,
             "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 4\nfrom %s\nto %s\n"
             "body a\nshape 1 plate\nu in [0, 1]; v in [0, 1]; u; v; 0\nmap 1 moves\n%s\n"
             "surface 0 0 1\nbody b\nshape 1 parts\n%s\nsurface 1 2\ntrees\n",
             p->from, p->to, p->map, p->shape);
    certificate c = made(text, leaf_tree, sizeof leaf_tree);
    replace(&c, "NEAR", near);
    return c;
}

START_TEST(parts_that_are_partly_in_a_box_count)
{
    static const parted all[] = {
        /* curves, which may overlap */
        {"0", "1", "x; y; z",
         "u in [0, 0]; v in [-1, 1]; u; v; 20 | u in [0, 0]; v in [-0.5, 0.5]; u; v; NEAR", "0",
         "20"},
        /* at one moment, at the end of the claim, at its start */
        {"0.5", "0.5", "x; y; z", narrower, "0", "20"},
        {"0", "0.5", "x; y; z", narrower, "0", "20"},
        {"0.5", "1", "x; y; z",
         "t in [-1, 0.5]; u in [-1, 1]; v in [-0.5, 0.5]; u; v; NEAR | "
         "t in [0.5, 2]; u in [-1, 1]; v in [-1, 1]; u; v; 20",
         "0", "20"},
        /* where the other surface jumps away from where it begins */
        {"0", "1", "t in [-1, 0.5]; x; y; z + 5 | t in [0.5, 2]; x; y; z", narrower, "5", "20"},
        /* between the doubles beside an end that is none; 20 - 1e18*3.2e-16 is below 0 */
        {"0", "1", "x; y; z",
         "u in [0, pi]; v in [0, 1]; u; v; 20 | "
         "u in [pi, 7]; v in [0, 1]; u; v; 20 - NEAR*max(3.1415926535897936 - u, 0)",
         "1e18", "1"},
        {"0", "1", "x; y; z",
         "u in [0, pi]; v in [0, 1]; u; v; 20 - NEAR*max(u - 3.141592653589793116, 0) | "
         "u in [pi, 4]; v in [0, 1]; u; v; 20",
         "1e18", "1"},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        const certificate near = made_of(&all[k], all[k].near), far = made_of(&all[k], all[k].far);
        require_within(&near, EFFORT_OF_CHANGES, "claimed apart by 4");
        require(&far, NULL);
    }
}
END_TEST

SUITE_MAIN("certificate parts", parts_that_are_partly_in_a_box_count)
