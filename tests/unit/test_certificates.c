/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <check.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <mpfi.h>

#include "tests/support/suite.h"
#include "tools/verify/walk.h"

/* impinge-verify on certificates that are made here, and on thousands of changes of them: whatever
 * is accepted must be true, as points of the formulas show. */

enum { BYTES_MAX = 8192, EFFORT = 200, EFFORT_OF_CHANGES = 24 };

typedef struct certificate {
    uint8_t bytes[BYTES_MAX];
    size_t size; /* without the checksum */
} certificate;

static const char bowl[] =
    "impinge certificate 1\nprogram impinge 0\nverdict contact\napart 0x1p-4\nfrom 0\nto 0.5\n"
    "within 0.6 at 0.5\npoint 0 0 0 0\npoint 1 0 0 0\n"
    "body bowl\nshape 1 formula\nu in [-1, 1]; v in [-1, 1]; u; v; 0.1*(u^2 + v^2)\nsurface 0 0\n"
    "body lid\nshape 1 formula\nh = 1; u in [-1, 1]; v in [-1, 1]; u; v; h - 0.05*u*v\n"
    "map 1 translate\nx; y; z - t\nsurface 1 1 2\ntrees\n";

static const uint8_t bowl_tree[] = {0, 1, 0, 4, 0x80, 0, 5, 0, 0, 0, 0, 0x7f, 0xff, 0, 6, 7};

/* Two balls that turn together about z, from which that is left out. */
static const char balls[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.25\nfrom 0\nto 1\n"
    "body a\nshape 1 sphere\nu in [0, 2*pi]; v in [-pi/2, pi/2]; cos(v)*cos(u); cos(v)*sin(u); "
    "sin(v)\nmap 1 rotate\nx*cos(2*t) - y*sin(2*t); x*sin(2*t) + y*cos(2*t); z\nsurface 0 0 1\n"
    "body b\nshape 1 sphere\nu in [0, 2*pi]; v in [-pi/2, pi/2]; 4 + cos(v)*cos(u); cos(v)*sin(u); "
    "sin(v)\nsurface 1 2 1\ntrees\n";

static const uint8_t balls_tree[] = {0, 1, 1, 7};

static certificate made(const char *text, const uint8_t *tree, size_t size)
{
    certificate c = {.size = strlen(text) + size};
    memcpy(c.bytes, text, strlen(text));
    memcpy(c.bytes + strlen(text), tree, size);
    return c;
}

/* Two triangles over two others. */
static const char roofs[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.5\nfrom 0\nto 1\n"
    "body floor\nshape 2 mesh\nu in [0, 1]; v in [0, 1]; u; v*(1 - u); 0\n"
    "u in [0, 1]; v in [0, 1]; -u; v*(1 - u); 0\nsurface 0 0\n"
    "body roof\nshape 2 mesh\nu in [0, 1]; v in [0, 1]; u; v*(1 - u); 1 + u\n"
    "u in [0, 1]; v in [0, 1]; -u; v*(1 - u); 1 + u\nsurface 1 1\ntrees\n";

static const uint8_t roofs_tree[] = {0, 1, 0, 1, 0, 1, 1, 1, 0, 0, 7, 2, 7, 7};

static certificate roofs_made(void) { return made(roofs, roofs_tree, sizeof roofs_tree); }
static certificate bowl_made(void) { return made(bowl, bowl_tree, sizeof bowl_tree); }
static certificate balls_made(void) { return made(balls, balls_tree, sizeof balls_tree); }

/* Replaces the first `from` by `to`. */
static void replace(certificate *c, const char *from, const char *to)
{
    uint8_t *at = memmem(c->bytes, c->size, from, strlen(from));
    ck_assert_ptr_nonnull(at);
    const size_t behind = c->size - (size_t)(at - c->bytes) - strlen(from);
    memmove(at + strlen(to), at + strlen(from), behind);
    memcpy(at, to, strlen(to));
    c->size = c->size - strlen(from) + strlen(to);
}

/* --- Verifying -------------------------------------------------------------------------------- */

static bool verify_bytes(const uint8_t *bytes, size_t size, unsigned long effort, statement *s,
                         char fault[1400], bool *assumes)
{
    FILE *file = fmemopen((void *)(uintptr_t)bytes, size, "rb");
    ck_assert_ptr_nonnull(file);
    input in;
    input_begin(&in, file);
    walk w = {.in = &in, .says = s, .effort = effort, .shares = 1};
    bool good = statement_read(s, &in);
    w.assumed = calloc(s->stage_count + 1, sizeof *w.assumed);
    good = good && walk_points(&w) && walk_trees(&w);
    *assumes = false;
    for (size_t k = 0; k < s->stage_count; ++k) *assumes = *assumes || w.assumed[k];
    memcpy(fault, in.fault, sizeof in.fault);
    free(w.assumed);
    fclose(file);
    return good;
}

/* Verifies with the checksum that belongs to the bytes. */
static bool verify(const certificate *c, unsigned long effort, statement *s, char fault[1400],
                   bool *assumes)
{
    uint8_t all[BYTES_MAX + SHA256_BYTES];
    sha256 h;
    memcpy(all, c->bytes, c->size);
    sha256_begin(&h);
    sha256_add(&h, all, c->size);
    sha256_end(&h, all + c->size);
    return verify_bytes(all, c->size + SHA256_BYTES, effort, s, fault, assumes);
}

static void require_within(const certificate *c, unsigned long effort, const char *why)
{
    statement s;
    char fault[1400];
    bool assumes;
    const bool good = verify(c, effort, &s, fault, &assumes);
    if (why == NULL) {
        ck_assert_msg(good && !assumes, "%s", fault);
    } else {
        ck_assert_msg(!good, "accepted: %s: %.*s", why, (int)c->size, (const char *)c->bytes);
        ck_assert_msg(strstr(fault, why) != NULL, "%s", fault);
    }
    statement_free(&s);
}

static void require(const certificate *c, const char *why) { require_within(c, EFFORT, why); }

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
        {false, "impinge certificate 1", "impinge certificate 2", "begins"},
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

/* A shaft that turns in its bore: no axis parts more than a strip of them. */
static certificate shaft_made(void)
{
    static const char shaft[] =
        "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.005\nfrom 0\nto 1\n"
        "body shaft\nshape 1 cylinder\nu in [0, 2*pi]; v in [-1, 1]; 0.99*cos(u) + 0; "
        "0.99*sin(u); v\nmap 1 rotate\nx*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z\n"
        "map 1 tilt\nx; 0.6*y - 0.8*z + 2; 0.8*y + 0.6*z\nsurface 0 0 1 2\n"
        "body bore\nshape 1 cylinder\nu in [0, 2*pi]; v in [-1, 1]; cos(u); sin(u); v\n"
        "map 1 tilt\nx; 0.6*y - 0.8*z + 2; 0.8*y + 0.6*z\nsurface 1 3 4\ntrees\n";
    static const uint8_t tree[] = {0, 1, 0, 7};
    return made(shaft, tree, sizeof tree);
}

START_TEST(round_surfaces_are_parted_about_their_centre)
{
    static const char ball[] = "u in [0, 2*pi]; v in [-1, 1]; 0.9*cos(v)*cos(u) + 0; "
                               "0.9*cos(v)*sin(u); 0.9*sin(v)";
    static const char *const offsets[][2] = {
        {"+ 0;", "+ 0.003;"}, {"+ 0;", "+ 0.006;"}, {"+ 0;", "+ 0.02;"}, {"0.005", "0.0101"}};
    for (size_t k = 0; k <= sizeof offsets / sizeof *offsets; ++k) {
        certificate c = shaft_made();
        if (k > 0) replace(&c, offsets[k - 1][0], offsets[k - 1][1]);
        require_within(&c, k < 2 ? EFFORT : EFFORT_OF_CHANGES, k < 2 ? NULL : "");
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

START_TEST(trees_that_leave_out_cells_are_refused)
{
    certificate c = bowl_made();
    c.size -= 1; /* a leaf */
    require(&c, "");
    c = bowl_made();
    c.bytes[c.size++] = 7; /* one too many */
    require(&c, "checksum");
    c = bowl_made();
    c.bytes[c.size - 1] = 9;
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

/* --- Changes at random ------------------------------------------------------------------------ */

static size_t draw_piece(const statement *s, size_t chain_index, uint64_t *seed)
{
    const size_t count = s->stages[s->chains[chain_index].stages[0]].count;
    return (size_t)(random_between(seed, 0, 1) * (double)count);
}

static bool point_of(const place *of, const double p[3], double x[3])
{
    const box3 where = {{p[0], p[1], p[2]}, {p[0], p[1], p[2]}};
    jet out[3], same[3];
    split unused;
    if (enclose(of, &where, p, out, same, &unused) != ENCLOSED) return false;
    for (int i = 0; i < 3; ++i) {
        if (!(out[i].v.hi - out[i].v.lo < 1e-9)) return false;
        x[i] = out[i].v.lo;
    }
    return true;
}

/* Whether points are found that are clearly nearer than is stated. Each draw that is nearer draws
 * the next ones to it. */
static bool is_false(const statement *s, uint64_t *seed)
{
    jet *room = malloc((2 * (size_t)s->steps + 1) * sizeof *room);
    double best = INFINITY, at[5] = {0, 0, 0, 0, s->from}, size = 1;
    place best_place[2] = {{.of = NULL}, {.of = NULL}};
    for (int draw = 0; draw < 200; ++draw) {
        double p[5], x[2][3];
        box3 all[2];
        place on[2];
        for (size_t k = 0; k < 2; ++k) {
            on[k] = (place){s,    &s->chains[k], draw_piece(s, k, seed), s->chains[k].count - 1,
                            room, NULL};
            if (draw >= 60 && best < INFINITY) on[k] = best_place[k];
            piece_box(&on[k], &all[k]);
        }
        for (int j = 0; j < 5; ++j) {
            const double lo = j < 4 ? all[j / 2].lo[j % 2] : s->from;
            const double hi = j < 4 ? all[j / 2].hi[j % 2] : s->to;
            const double r = lo + (hi - lo) * random_between(seed, 0, 1);
            p[j] = draw < 60 ? r : at[j] + size * (r - at[j]);
        }
        const double a[3] = {p[0], p[1], p[4]}, b[3] = {p[2], p[3], p[4]};
        if (draw > 60) size *= 0.93;
        if (!point_of(&on[0], a, x[0]) || !point_of(&on[1], b, x[1])) continue;
        const double gap = hypot(hypot(x[0][0] - x[1][0], x[0][1] - x[1][1]), x[0][2] - x[1][2]);
        if (gap < best) best = gap, memcpy(at, p, sizeof at), memcpy(best_place, on, sizeof on);
    }
    free(room);
    return best < s->apart * (1 - 1e-9);
}

static void change(certificate *c, uint64_t *seed)
{
    static const char marks[] = "0123456789+-*/().;,uvtxyz ";
    const size_t at = (size_t)(random_between(seed, 0, 1) * (double)c->size);
    const double kind = random_between(seed, 0, 1);
    const char mark = marks[(size_t)(random_between(seed, 0, 1) * (double)(sizeof marks - 1))];
    if (kind < 0.5)
        c->bytes[at] = (uint8_t)mark;
    else if (kind < 0.7)
        c->bytes[at] ^= (uint8_t)(1u << (unsigned)(random_between(seed, 0, 1) * 8));
    else if (kind < 0.85) {
        memmove(c->bytes + at, c->bytes + at + 1, c->size - at - 1);
        c->size -= 1;
    } else {
        memmove(c->bytes + at + 1, c->bytes + at, c->size - at);
        c->bytes[at] = (uint8_t)mark;
        c->size += 1;
    }
}

START_TEST(no_change_makes_a_false_statement_hold)
{
    uint64_t seed = suite_seed();
    const int count = suite_times(2400);
    int accepted = 0;
    for (int k = 0; k < count; ++k) {
        certificate c = k % 40 == 39 ? shaft_made()
                        : k % 3 == 0 ? bowl_made()
                        : k % 3 == 1 ? balls_made()
                                     : roofs_made();
        for (int n = 1 + k % 3; n > 0; --n) change(&c, &seed);
        statement s;
        char fault[1400];
        bool assumes;
        const bool good = verify(&c, EFFORT_OF_CHANGES, &s, fault, &assumes);
        accepted += good;
        if (good && !assumes && s.chain_count >= 2 && !statement_ignores(&s, 0, 1))
            ck_assert_msg(!is_false(&s, &seed), "change %d: false, and accepted: %.*s", k,
                          (int)c.size, (const char *)c.bytes);
        statement_free(&s);
    }
    ck_assert_int_gt(accepted, 0); /* names and hints may change */
    ck_assert_int_lt(accepted, count);
}
END_TEST

/* --- Intervals -------------------------------------------------------------------------------- */

/* An end, of any size, often one where rounding or overflow begins. */
static double draw_end(uint64_t *seed)
{
    static const double hard[] = {0,        1,        -1, 0x1p-1074, 0x1p-1022, -0x1p-540,
                                  0x1p1023, -DBL_MAX, 3,  INFINITY,  -INFINITY};
    const double k = random_between(seed, 0, 1);
    if (k < 0.4) return hard[(size_t)(k / 0.4 * (double)(sizeof hard / sizeof *hard))];
    return ldexp(random_between(seed, -1, 1),
                 (int)random_between(seed, k < 0.8 ? -4 : -1000, k < 0.8 ? 4 : 1000));
}

static ld_interval draw_interval(uint64_t *seed)
{
    const double a = draw_end(seed), b = random_between(seed, 0, 1) < 0.3 ? a : draw_end(seed);
    return ld_interval_make(a < b ? a : b, a < b ? b : a);
}

static void set_interval(mpfi_ptr to, ld_interval x)
{
    mpfr_set_d(&to->left, x.lo, MPFR_RNDD);
    mpfr_set_d(&to->right, x.hi, MPFR_RNDU);
}

START_TEST(operations_in_doubles_contain_those_of_mpfi)
{
    uint64_t seed = suite_seed();
    mpfi_t x, y, z;
    mpfi_init2(x, 200), mpfi_init2(y, 200), mpfi_init2(z, 200);
    for (int k = suite_times(20000); k > 0; --k) {
        const ld_interval a = draw_interval(&seed), b = draw_interval(&seed);
        const ld_interval made[] = {ld_interval_add(a, b), ld_interval_sub(a, b),
                                    ld_interval_mul(a, b), ld_interval_div(a, b),
                                    ld_interval_sqr(a),    ld_interval_sqrt(a)};
        set_interval(x, a), set_interval(y, b);
        for (int n = 0; n < 6; ++n) {
            if (n == 3 && b.lo <= 0 && b.hi >= 0) continue;
            if (n == 0) mpfi_add(z, x, y);
            if (n == 1) mpfi_sub(z, x, y);
            if (n == 2) mpfi_mul(z, x, y);
            if (n == 3) mpfi_div(z, x, y);
            if (n == 4) mpfi_sqr(z, x);
            if (n == 5) mpfi_sqrt(z, x);
            ck_assert_msg(mpfi_nan_p(z) || (mpfr_cmp_d(&z->left, made[n].lo) >= 0 &&
                                            mpfr_cmp_d(&z->right, made[n].hi) <= 0),
                          "operation %d of [%a, %a] and [%a, %a]: [%a, %a]", n, a.lo, a.hi, b.lo,
                          b.hi, made[n].lo, made[n].hi);
        }
    }
    mpfi_clear(x), mpfi_clear(y), mpfi_clear(z);
}
END_TEST

SUITE_MAIN("certificates", true_certificates_hold, false_certificates_are_refused,
           trees_that_leave_out_cells_are_refused, trees_that_make_no_sense_are_refused,
           maps_left_out_shrink_the_claim, operations_in_doubles_contain_those_of_mpfi,
           bad_axes_cost_time_and_no_verdict, what_cannot_be_said_is_assumed,
           points_of_what_is_assumed_are_checked, formulas_without_a_value_are_refused,
           undefined_maps_ends_and_points_are_refused, parts_that_meet_are_all_proved,
           round_surfaces_are_parted_about_their_centre, no_change_makes_a_false_statement_hold)
