/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/made_certificate.h"

/* impinge-verify on true and false certificates that are made here. */

START_TEST(true_certificates_hold)
{
    const certificate a = bowl_made(), b = balls_made(), c = roofs_made();
    require(&a, NULL);
    require(&b, NULL);
    require(&c, NULL);
}
END_TEST

START_TEST(false_certificates_are_refused)
{
    static const struct {
        bool is_balls;
        const char *from, *to, *why;
    } changes[] = {
        {false, "verdict contact", "verdict safe", "verdict"},
        {false, "within 0.6 at 0.5\npoint 0 0 0 0\npoint 1 0 0 0\n", "", "no points"},
        {false, "verdict contact\n", "", "verdict"},
        {false, "apart 0x1p-4", "apart 0x1p-4\napart 0x1p-9", "second"},
        {false, "apart 0x1p-4\n", "", "nothing"},
        {false, "to 0.5", "to -0.5", "nothing"},
        {false, "to 0.5", "to inf", "finite"},
        {false, "body bowl", "body \x1b[2Kbowl", "byte 27"},
        {false, "point 1 0 0 0", "point 1 0 nan 0", "finite"},
        {false, "point 1 0 0 0", "point 1 7 0 0", "no piece"},
        {false, "point 1 0 0 0", "point 9 0 0 0", "no surface"},
        {false, "surface 0 0\nbody", "surface 1 0\nbody", "number"},
        {false, "surface 1 1 2\n", "surface 1 1 2\nbody c\nsurface 2 0\n", "not here"},
        {false, "surface 1 1 2\n", "surface 1 1 2\nsurface 0 0\n", "order"},
        {false, "surface 1 1 2\n", "surface 1 1 0\n", "no type and maps"},
        {false, "u; v; 0.1", "u; v; 9 | u in [-1, 1]; v in [-1, 1]; u; v; 0.1", "overlap"},
        {false, "shape 1 formula\nh", "shape 0 formula\nbody h", "no piece"},
        {false, "map 1 translate", "map 2 translate", "pieces"},
        {false, "x; y; z - t", "z in [0, 1]; x; y; z - t", "domain of z"},
        {true, "surface 1 2 1", "map 1 rotate\nx; y; z\nsurface 1 2 3", "do not share"},
        {true, "; z\nsurface 0", "; abs(z)\nsurface 0", "rigid"},
        {true, "x*cos(2*t) - y*sin(2*t); x*sin(2*t) + y*cos(2*t); z", "x/2; y/2; z/2", "rigid"},
        {true, "x*cos(2*t) - y*sin(2*t); x*sin(2*t) + y*cos(2*t); z", "x; y; z*(1 + t)", "rigid"},
        {false, "apart 0x1p-4", "apart 0.6", "apart"},
        {false, "to 0.5", "to 1.5", "apart"},
        {false, "0.1*(u^2", "0.6*(u^2", "apart"},
        {false, "h = 1", "h = 0", "apart"},
        {false, "z - t", "z - 2*t", "apart"},
        {false, "within 0.6", "within 0.4", "claimed within"},
        {false, "within 0.6 at 0.5", "within 0.9 at 0.75", "another time"},
        {false, "point 1 0 0 0", "point 0 0 0 0", "not tested"},
        {false, "point 1 0 0 0", "point 1 0 2 0", "outside"},
        {false, "u in [-1, 1]; v", "v", "no finite domain"},
        {false, "surface 1 1 2", "surface 1 1 7", "number"},
        {false, "apart 0x1p-4", "apart nan", "finite"},
        {false, "apart 0x1p-4", "apart -1", "nothing"},
        {false, "impinge certificate 1", "impinge certificate 3", "begins"},
        {false, "body lid", "body bowl", "named 'bowl'"},
        {false, "verdict contact", "verdict contact\nverdict clear", "begins with 'verdict'"},
        {false, "apart 0x1p-4", "apart 0x1p-4 0.7", "too long"},
        {false, "from 0\n", "from 0 to 1\n", "too long"},
        {false, "point 1 0 0 0", "point 1 0 0 0 1", "too long"},
        {false, "h = 1; u", "h = 1; t in [0.5, 1]; u", "leaves open"},
        {false, "h = 1; u", "h = 1; t in [0.5, 0.5]; u", "no size"},
        {false, "u; v; 0.1", "u; v; 9 | u in [1, 1]; v in [0, 1]; u; v; 0.1", "no size"},
        {true, "apart 0.25", "apart 2.25", "apart"},
        {true, "4 + cos", "1 + cos", "apart"},
        {true, "x*cos(2*t) - y", "x*cos(2*t) - 0.1*y", "rigid"},
        {true, "; z\nsurface", "; z*z\nsurface", "rigid"},
        {true, "; z\nsurface 0", "; t in [0, 0.5]; z\nsurface 0", "a formula"},
        {true, "rotate\nx", "rotate\nt in [0, 0.5]; x", "rigid"},
        {true, "surface 1 2 1", "surface 1 2", "left out"},
    };
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        certificate c = changes[k].is_balls ? balls_made() : bowl_made();
        replace(&c, changes[k].from, changes[k].to);
        require(&c, changes[k].why);
    }
}
END_TEST

/* What has no value has none after a product with 0, a choice or a wave either. */
START_TEST(formulas_without_a_value_are_refused)
{
    static const char *const terms[] = {"0/0",
                                        "0*(1/0)",
                                        "0*log(-1)",
                                        "min(0, 0/0)",
                                        "max(5, 1/0)*0",
                                        "copysign(0, 1/0)",
                                        "0^(1/0)",
                                        "(0/0)^0",
                                        "hypot(0, 0/0)",
                                        "0*atan2(1, log(-1))",
                                        "0*sqrt(-1)",
                                        "0*sqrt(-0x1p-50)",
                                        "0*sqrt(u)",
                                        "0*(u - 2)^0.5",
                                        "0*u^-1",
                                        "0*u^u",
                                        "(1/u)^0",
                                        "0*log(v)",
                                        "0*log(1 + u)",
                                        "0*asin(2*u)",
                                        "0*acos(u - 3)",
                                        "0*tan(2*u)",
                                        "sin(1/u)*0",
                                        "min(0, max(0, 1/u))",
                                        "0*atan(1/(u - 0.3))",
                                        "0*cbrt(log(u))",
                                        "copysign(0, log(u))",
                                        "exp(-1/u^2)*0",
                                        "0*(t - 0.3)^-1",
                                        "abs(0*sqrt(0.2 - t))"};
    static const char *const good[] = {
        "0*sqrt(1 + u)",    "0*sqrt(1 - u^2)", "0*sqrt(0.3 - 3*u/10)", "0*asin(u)",
        "0*acos(sin(9*v))", "0*(1 - u^2)^1.5", "0*log(2 + u)",         "0*tan(u)",
        "u^0 - 1",          "0*(u + 2)^v",     "0*(u + 2)^-2",         "0*u/(2 + v)",
        "0*abs(u)^(2/0.3)"};
    char text[200];
    for (size_t k = 0; k < sizeof terms / sizeof *terms; ++k) {
        certificate c = bowl_made();
        snprintf(text, sizeof text, "h - 0.05*u*v + %s", terms[k]);
        replace(&c, "h - 0.05*u*v", text);
        require(&c, "");
    }
    for (size_t k = 0; k < sizeof good / sizeof *good; ++k) {
        certificate c = bowl_made();
        snprintf(text, sizeof text, "h - 0.05*u*v + %s", good[k]);
        replace(&c, "h - 0.05*u*v", text);
        require(&c, NULL);
    }
}
END_TEST

START_TEST(undefined_maps_ends_and_points_are_refused)
{
    static const struct {
        bool is_balls;
        const char *from, *to, *why;
    } changes[] = {
        {false, "z - t", "z - t + 0*log(x)", "value"},
        {false, "x; y; z - t", "0*log(x); y; z - t", "value"},
        {false, "u; v; 0.1", "u + 1/u; v; 0.1", ""},
        {false, "u in [-1, 1]; v", "u in [0/0, 1]; v", "no value"},
        {false, "u in [-1, 1]; v", "u in [-1, 1]; t in [0*log(-1), 9]; v", "no value"},
        {true, "; z\nsurface 0", "; z + 0*sqrt(x)\nsurface 0", "rigid"},
    };
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        certificate c = changes[k].is_balls ? balls_made() : bowl_made();
        replace(&c, changes[k].from, changes[k].to);
        require(&c, changes[k].why);
    }
}
END_TEST

/* At the one time, or along the one line, that two parts share, both count. */
START_TEST(parts_that_meet_are_all_proved)
{
    static const char *const far = "u in [-1, 1]; v in [-1, 1]; t in [0.5, 1]; u; v; -9 | ";
    char text[300];
    snprintf(text, sizeof text, "%su in [-1, 1]; v in [-1, 1]; t in [0, 0.5]; u; v; 0.1", far);
    certificate d = bowl_made();
    replace(&d, "u in [-1, 1]; v in [-1, 1]; u; v; 0.1", text);
    replace(&d, "from 0\n", "from 0.5\n");
    replace(&d, "z - t", "z - 2*t");
    require(&d, "apart");
    d = bowl_made();
    replace(&d, "x; y; z - t", "t in [0.5, 1]; x; y; z + 9 | t in [0, 0.5]; x; y; z - 2*t");
    replace(&d, "from 0\n", "from 0.5\n");
    require(&d, "");
}
END_TEST

/* Two balls at one place, which are both there at 0.5 alone: no cell of the tree holds both. */
START_TEST(surfaces_are_there_at_one_moment)
{
    certificate d = balls_made();
    replace(&d, "; cos(v)*cos(u)", "; t in [0, 0.5]; cos(v)*cos(u)");
    replace(&d, "; 4 + cos(v)*cos(u)", "; t in [0.5, 1]; 4 + cos(v)*cos(u)");
    require(&d, "ends and another begins at 0.5");
    replace(&d, "; t in [0.5, 1]; 4", "; t in [0.25, 1]; 4");
    require(&d, NULL);
    replace(&d, "; t in [0.25, 1]; 4 + cos", "; t in [0.5, 1]; cos");
    require(&d, "ends and another begins at 0.5");
    replace(&d, "; t in [0, 0.5]; cos", "; t in [0, 0.25]; cos");
    require(&d, NULL);
}
END_TEST

START_TEST(trees_that_leave_out_cells_are_refused)
{
    certificate c = bowl_made();
    c.size -= 1; /* a leaf */
    require(&c, "");
    c = bowl_made();
    c.bytes[c.size++] = 7; /* one too many */
    require(&c, "checksum");
    c = bowl_made();
    c.bytes[c.size - 1] = 10;
    require(&c, "unknown");
    c = bowl_made();
    c.bytes[strlen(bowl) + 1] = 0; /* surfaces 0 and 0 */
    require(&c, "not here");
}
END_TEST

START_TEST(trees_that_make_no_sense_are_refused)
{
    static const struct {
        size_t at;
        uint8_t byte;
        const char *why;
    } changes[] = {{2, 9, "more maps"},     {3, 2, "above"},    {3, 255, "above"},
                   {5, 0, "names piece 0"}, {9, 1, "along v"},  {11, 3, "along v"},
                   {11, 8, "unknown"},      {11, 6, "no axis"}, {12, 2, ""},
                   {1, 0, "not here"}};
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        certificate c = roofs_made();
        c.bytes[strlen(roofs) + changes[k].at] = changes[k].byte;
        require(&c, changes[k].why);
    }
    certificate deep = bowl_made();
    memset(deep.bytes + strlen(bowl) + 3, 0, BYTES_MAX - strlen(bowl) - 3);
    deep.size = BYTES_MAX;
    require(&deep, "too deep");
}
END_TEST

/* A map that shrinks lengths a little leaves as much less between the bodies. */
START_TEST(maps_left_out_shrink_the_claim)
{
    certificate c = balls_made();
    replace(&c, "x*cos(2*t) - y*sin(2*t); x*sin(2*t) + y*cos(2*t); z", "0.9*x; 0.9*y; 0.9*z");
    replace(&c, "apart 0.25", "apart 1.7");
    require(&c, NULL);
    replace(&c, "apart 1.7", "apart 1.81");
    require(&c, "apart");
}
END_TEST

START_TEST(bad_axes_cost_time_and_no_verdict)
{
    certificate c = bowl_made();
    c.bytes[c.size - 5] = 0x80, c.bytes[c.size - 4] = 1; /* the axis points the other way */
    require(&c, NULL);
}
END_TEST

START_TEST(points_of_what_is_assumed_are_checked)
{
    static const char *const changes[][3] = {{"within 0.6 at 0.5", "within 0.6 at 0.75", "time"},
                                             {"point 1 0 0 0", "point 9 0 0 0", "no surface"},
                                             {"point 1 0 0 0", "point 1 3 0 0", "no piece"},
                                             {"point 1 0 0 0", "point 0 0 0 0", "not tested"}};
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        certificate c = bowl_made();
        replace(&c, "x; y; z - t\n", "\n");
        replace(&c, changes[k][0], changes[k][1]);
        require(&c, changes[k][2]);
    }
}
END_TEST

START_TEST(what_cannot_be_said_is_assumed)
{
    certificate c = bowl_made();
    replace(&c, "x; y; z - t\n", "\n");
    statement s;
    char fault[1400];
    bool assumes;
    ck_assert_msg(verify(&c, EFFORT, &s, fault, &assumes), "%s", fault);
    ck_assert(assumes);
    statement_free(&s);
}
END_TEST

SUITE_MAIN("certificates", true_certificates_hold, false_certificates_are_refused,
           trees_that_leave_out_cells_are_refused, trees_that_make_no_sense_are_refused,
           maps_left_out_shrink_the_claim, bad_axes_cost_time_and_no_verdict,
           what_cannot_be_said_is_assumed, points_of_what_is_assumed_are_checked,
           formulas_without_a_value_are_refused, undefined_maps_ends_and_points_are_refused,
           parts_that_meet_are_all_proved, surfaces_are_there_at_one_moment)
