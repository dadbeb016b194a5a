/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/made_certificate.h"

/* impinge-verify on surfaces that are round about one line or point. */

START_TEST(round_surfaces_are_parted_about_their_centre)
{
    static const char ball[] = "u in [0, 2*pi]; v in [-1, 1]; 0.9*cos(v)*cos(u) + 0; "
                               "0.9*cos(v)*sin(u); 0.9*sin(v)";
    static const char *const offsets[][2] = {
        {"+ 0;", "+ 0.003;"}, {"+ 0;", "+ 0.006;"}, {"+ 0;", "+ 0.02;"}, {"0.005", "0.0101"}};
    for (size_t k = 0; k <= sizeof offsets / sizeof *offsets; ++k) {
        certificate c = shaft_made();
        if (k > 0) replace(&c, offsets[k - 1][0], offsets[k - 1][1]);
        require_within(&c,
                       k == 0   ? EFFORT
                       : k == 1 ? 2 * EFFORT
                                : EFFORT_OF_CHANGES,
                       k < 2 ? NULL : "");
    }
    for (int k = 0; k < 3; ++k) {
        certificate c = shaft_made();
        replace(&c, "0.005", k == 1 ? "0.1001" : "0.04");
        replace(&c, "u in [0, 2*pi]; v in [-1, 1]; 0.99*cos(u) + 0; 0.99*sin(u); v", ball);
        replace(&c, "; cos(u); sin(u); v\n", "; cos(v)*cos(u); cos(v)*sin(u); sin(v)\n");
        if (k == 2) replace(&c, "+ 0;", "+ 0.07;");
        require_within(&c, k == 0 ? EFFORT : EFFORT_OF_CHANGES, k == 0 ? NULL : "");
    }
}
END_TEST

/* A shaft that is in the middle of its bore at the middle of the time alone. */
START_TEST(shafts_that_leave_their_centre_are_not_parted_about_it)
{
    static const char turns[] = "x*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z";
    static const struct {
        const char *moves;
        bool holds;
    } ways[] = {{"x + 0.08*(t - 0.5)^2; y; z", false},
                {"x + 0.008*(t - 0.5)^2; y; z", true},
                {"x; y + 0.02*t; z", false},
                {"x*(1 + 0.02*(t - 0.5)); y; z", false},
                {"x*(1 + 0.002*(t - 0.5)); y; z", true}};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; ++k) {
        certificate c = shaft_made();
        replace(&c, turns, ways[k].moves);
        require_within(&c, ways[k].holds ? 4 * EFFORT : EFFORT, ways[k].holds ? NULL : "");
    }
}
END_TEST

/* Many leaves share the boxes of one side, which are divided once: only where they are the same. */
START_TEST(leaves_that_share_a_side_prove_their_own_cells)
{
    static const struct {
        const char *what;
        size_t size;
        uint8_t tree[16];
    } trees[] = {
        {"quarters of A's u", 7, {0, 0, 7, 7, 0, 7, 7}},
        {"halves of A's v", 3, {1, 7, 7}},
        {"halves of B's u", 3, {2, 7, 7}},
        {"halves of B's v", 3, {3, 7, 7}},
        {"halves of time", 5, {4, 0x80, 0, 7, 7}},
        {"halves of time and of A's u", 9, {4, 0x80, 0, 0, 7, 7, 0, 7, 7}},
    };
    static const struct {
        const char *from, *to;
        bool holds;
    } ways[] = {
        {"cos(u) + 0", "cos(u) + 0", true},
        {"; cos(u); sin(u); v\n", "; (1 - 0.001*(v + 1))*cos(u); (1 - 0.001*(v + 1))*sin(u); v\n",
         true},
        /* the bore narrows to 0.002 beside the shaft, where v is more than 0.25 */
        {"; cos(u); sin(u); v\n", "; (1 - 0.004*(v + 1))*cos(u); (1 - 0.004*(v + 1))*sin(u); v\n",
         false},
        /* the shaft grows after t = 0.7 */
        {"0.99*cos(u) + 0; 0.99*sin(u); v", "(0.99 + 0.01*t^2)*cos(u); (0.99 + 0.01*t^2)*sin(u); v",
         false},
        /* the shaft is wider from v = 0.25 */
        {"0.99*cos(u) + 0; 0.99*sin(u); v",
         "(0.99 + 0.004*(v + 1))*cos(u); (0.99 + 0.004*(v + 1))*sin(u); v", false},
        /* and leaves its centre */
        {"x*sin(t) + y*cos(t); z", "x*sin(t) + y*cos(t) + 0.01*t^3; z", false},
        {"x*sin(t) + y*cos(t); z", "x*sin(t) + y*cos(t) + 0.006*t^4; z", false},
    };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; ++i)
        for (size_t k = 0; k < sizeof trees / sizeof *trees; ++k) {
            certificate c = shaft_made();
            c.size -= 1;
            memcpy(c.bytes + c.size, trees[k].tree, trees[k].size);
            c.size += trees[k].size;
            replace(&c, ways[i].from, ways[i].to);
            require_within(&c, ways[i].holds ? EFFORT : EFFORT_OF_CHANGES,
                           ways[i].holds ? NULL : "");
        }
}
END_TEST

/* Cones of slope 1, 0.1 apart along their axis: 0.0707 from each other, but beside their apexes. */
static certificate cones_made(double apart)
{
    certificate c = shaft_made();
    char text[32];
    snprintf(text, sizeof text, "%g", apart);
    replace(&c, "0.005", text);
    replace(&c, "u in [0, 2*pi]; v in [-1, 1]; 0.99*cos(u) + 0; 0.99*sin(u); v",
            "u in [0, 2*pi]; v in [0, 0.9]; (0.9 - v)*cos(u) + 0; (0.9 - v)*sin(u); v");
    replace(&c, "u in [0, 2*pi]; v in [-1, 1]; cos(u); sin(u); v\n",
            "u in [0, 2*pi]; v in [0, 1]; (1 - v)*cos(u); (1 - v)*sin(u); v\n");
    return c;
}

START_TEST(cones_are_parted_by_axes_that_turn_about_their_own)
{
    static const char turns[] = "x*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z";
    static const struct {
        double apart;
        const char *from, *to;
        bool holds;
    } ways[] = {
        {0.06, turns, turns, true},
        {0.0708, turns, turns, false},
        {0.005, turns, "x*cos(3*t) - y*sin(3*t); x*sin(3*t) + y*cos(3*t); z + 0.08*t", true},
        /* comes nearer than that along the axis, at the end alone, and in the middle alone */
        {0.005, turns, "x*cos(3*t) - y*sin(3*t); x*sin(3*t) + y*cos(3*t); z + 0.1*t^3", false},
        {0.005, turns, "x*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z + 0.4*t*(1 - t)", false},
        /* beside it; by a tilt; as it grows */
        {0.005, turns, "x*cos(t) - y*sin(t) + 0.12*t; x*sin(t) + y*cos(t); z", false},
        {0.005, turns, "x + 0.12*t*z; y; z - 0.12*t*x", false},
        {0.005, turns, "x*(1 + 0.12*t); y*(1 + 0.12*t); z", false},
        {0.005, turns, "x*(1 + 0.06*t); y*(1 + 0.06*t); z", true},
        /* of a surface that moves by itself */
        {0.005, "(0.9 - v)*cos(u) + 0; (0.9 - v)*sin(u); v",
         "(0.9 - v)*cos(u + t) + 0; (0.9 - v)*sin(u + t); v + 0.11*t^2", false},
    };
    for (size_t k = 0; k < sizeof ways / sizeof *ways; ++k) {
        certificate c = cones_made(ways[k].apart);
        replace(&c, ways[k].from, ways[k].to);
        require_within(&c, ways[k].holds ? EFFORT : 2 * EFFORT_OF_CHANGES,
                       ways[k].holds ? NULL : "");
    }
}
END_TEST

/* What turns within a bore, though its own side is not round about the bore's line, and what would
 * come too near if it were only a little larger, moved, or faster. Bounds of a turn by pi or more
 * are as wide as the bore for each axis. */
START_TEST(one_centre_parts_balls_discs_and_sides_of_boxes_from_a_bore)
{
    static const char ball[] = "u in [0, 2*pi]; v in [-0.4, 0.4]; 0.99*cos(v)*cos(u) + 0; "
                               "0.99*cos(v)*sin(u); 0.99*sin(v)",
                      disc[] = "u in [0, 2*pi]; v in [0, 0.99]; v*cos(u) + 0; v*sin(u); 0.3",
                      face[] = "u in [-0.7, 0.7]; v in [-0.5, 0.5]; u; 0.7 + 0; v";
    static const char about_z[] = "x*cos(10*t) - y*sin(10*t); x*sin(10*t) + y*cos(10*t); z",
                      about_x[] = "x; y*cos(10*t) - z*sin(10*t); y*sin(10*t) + z*cos(10*t)";
    static const struct {
        const char *what, *turn, *from, *to;
        bool holds;
    } ways[] = {
        {ball, about_z, "0.005", "0.001", true},
        {ball, about_x, "0.005", "0.001", true},
        {ball, about_x, "0.005", "0.0101", false},
        {ball, about_x, "x; y*cos", "x + 0.006*t; y*cos", false},
        {ball, about_x, "x; y*cos", "x + 0.03*t*(1 - t); y*cos", false},
        {ball, about_x, "x; y*cos", "x*(1 + 0.006*t); y*cos", false},
        {ball, about_x, "+ 0;", "+ 0.006;", false},
        {ball, about_x, "; cos(u); sin(u); v\n",
         "; (1 - 0.006*v^8)*cos(u); (1 - 0.006*v^8)*sin(u); v\n", true},
        {ball, about_x, "; cos(u); sin(u); v\n",
         "; (1 - 0.006*t)*cos(u); (1 - 0.006*t)*sin(u); v\n", false},
        {disc, about_z, "0.005", "0.001", true},
        {disc, about_z, "0.005", "0.0101", false},
        {disc, about_z, "+ 0;", "+ 0.006;", false},
        {disc, about_z, "y*cos(10*t); z", "y*cos(10*t) + 0.006*t; z", false},
        {face, about_z, "0.005", "0.001", true},
        {face, about_z, "0.005", "0.0102", false},
        {face, about_z, "0.7 + 0", "0.7 + 0.008", false},
        {face, about_z, "y*cos(10*t); z", "y*cos(10*t) + 0.03*t*(1 - t); z", false},
    };
    for (size_t k = 0; k < sizeof ways / sizeof *ways; ++k) {
        certificate c = shaft_made();
        replace(&c, "u in [0, 2*pi]; v in [-1, 1]; 0.99*cos(u) + 0; 0.99*sin(u); v", ways[k].what);
        replace(&c, "x*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z", ways[k].turn);
        replace(&c, ways[k].from, ways[k].to);
        require_within(&c, ways[k].holds ? EFFORT : EFFORT_OF_CHANGES, ways[k].holds ? NULL : "");
    }
}
END_TEST

SUITE_MAIN("certificate_round", cones_are_parted_by_axes_that_turn_about_their_own,
           one_centre_parts_balls_discs_and_sides_of_boxes_from_a_bore,
           round_surfaces_are_parted_about_their_centre,
           shafts_that_leave_their_centre_are_not_parted_about_it,
           leaves_that_share_a_side_prove_their_own_cells)
