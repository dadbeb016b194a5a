/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MADE_TEXTS_H
#define TESTS_SUPPORT_MADE_TEXTS_H

#include <check.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Certificates that are made here, without their checksum. */

enum { BYTES_MAX = 8192 };

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

static inline certificate made(const char *text, const uint8_t *tree, size_t size)
{
    certificate c = {.size = strlen(text) + size};
    memcpy(c.bytes, text, strlen(text));
    memcpy(c.bytes + strlen(text), tree, size);
    return c;
}

/* Replaces the first `from` by `to`. */
static inline void replace(certificate *c, const char *from, const char *to)
{
    uint8_t *at = memmem(c->bytes, c->size, from, strlen(from));
    ck_assert_ptr_nonnull(at);
    const size_t behind = c->size - (size_t)(at - c->bytes) - strlen(from);
    memmove(at + strlen(to), at + strlen(from), behind);
    memcpy(at, to, strlen(to));
    c->size = c->size - strlen(from) + strlen(to);
}

/* Two triangles over two others. */
static const char roofs[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.5\nfrom 0\nto 1\n"
    "body floor\nshape 2 mesh\nu in [0, 1]; v in [0, 1]; u; v*(1 - u); 0\n"
    "u in [0, 1]; v in [0, 1]; -u; v*(1 - u); 0\nsurface 0 0\n"
    "body roof\nshape 2 mesh\nu in [0, 1]; v in [0, 1]; u; v*(1 - u); 1 + u\n"
    "u in [0, 1]; v in [0, 1]; -u; v*(1 - u); 1 + u\nsurface 1 1\ntrees\n";

static const uint8_t roofs_tree[] = {0, 1, 0, 1, 0, 1, 1, 1, 0, 0, 7, 2, 7, 7};

/* A ball on an arm that turns by q, and one that slides away by w: 2.17 apart at q = 0.9, w = 0. */
static const char arm[] =
    "impinge certificate 2\nprogram impinge 0\nverdict distance\napart 2\nfrom 0\nto 1\n"
    "parameter 0.9 1.5 q\nparameter 0 0.5 w\nwithin 3 at 0.5 0.9 0\npoint 0 0 0 0\n"
    "point 1 0 0 0\nbody arm\nshape 1 sphere\nu in [0, 2*pi]; v in [-pi/2, pi/2]; "
    "2 + 0.5*cos(v)*cos(u); 0.5*cos(v)*sin(u); 0.5*sin(v)\n"
    "map 1 rotate clock 1\nx*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z\nsurface 0 0 1\n"
    "body other\nshape 1 sphere\nu in [0, 2*pi]; v in [-pi/2, pi/2]; "
    "4 - 0.5*cos(v)*cos(u); 0.5*cos(v)*sin(u); 0.5*sin(v)\n"
    "map 1 slide clock 2\nx + t; y; z\nsurface 1 2 3\ntrees\n";

static const uint8_t arm_tree[] = {0, 1,    0, 0, 8, 1,    0x40, 0, 7, 8,
                                   2, 0x80, 0, 7, 4, 0x20, 0,    7, 7};

static inline certificate arm_made(void) { return made(arm, arm_tree, sizeof arm_tree); }

static inline certificate roofs_made(void) { return made(roofs, roofs_tree, sizeof roofs_tree); }

static inline certificate bowl_made(void) { return made(bowl, bowl_tree, sizeof bowl_tree); }

static inline certificate balls_made(void) { return made(balls, balls_tree, sizeof balls_tree); }

/* A shaft that turns in its bore: no axis parts more than a strip of them. */
static inline certificate shaft_made(void)
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

/* Changes of a claim, and whether what it states then is true. The bowl's lid comes as near as 0.2,
 * at the end. */
typedef struct claim_change {
    const char *from, *to;
    bool holds;
} claim_change;

static const claim_change bowl_claims[] = {
    {"apart 0x1p-4", "apart 0x1p-4", true},    {"apart 0x1p-4", "apart 0.19", true},
    {"apart 0x1p-4", "apart 0.251", false},    {"to 0.5\n", "to 0.75\n", false},
    {"x; y; z - t", "x; y; z - 2*t", false},   {"h = 1;", "h = 0.8;", false},
    {"u; v; h", "u; v; 0.5*h", false},         {"0.1*(u^2", "0.4*(u^2", false},
    {"within 0.6 at", "within 0.4 at", false}, {"within 0.6", "within 0.4999", false}};
enum { BOWL_CLAIMS = sizeof bowl_claims / sizeof *bowl_claims };

static const claim_change arm_claims[] = {
    {"apart 2", "apart 2", true},
    {"apart 2", "apart 2.2", false},
    {"parameter 0.9", "parameter 0.95", false}, /* the points are of 0.9 */
    {"parameter 0.9", "parameter 0.1", false},
    {"1.5 q", "6.2 q", false},
    {"parameter 0 ", "parameter -0.5 ", false},
    {"0.5 w", "1.5 w", true},
    {"rotate clock 1", "rotate clock 2", false},
    {"rotate clock 1", "rotate clock 0", false},
    {"rotate clock 1", "rotate", false},
    {"rotate clock 1", "rotate clock 3", false},
    {"rotate clock 1", "rotate clock", false},
    {"slide clock 2", "slide clock 1", false}, /* the points are farther apart */
    {"x + t", "x - t", false},
    {"within 3", "within 2", false},
    {"at 0.5 0.9 0", "at 0.5 0.9", false},
    {"at 0.5 0.9 0", "at 0.5 0.9 0 0", false},
    {"at 0.5 0.9 0", "at 0.5 0.8 0", false},
    {"certificate 2", "certificate 1", false},
    {" w\n", " q\n", false},
    {"parameter 0 0.5 w\n", "", false}};
enum { ARM_CLAIMS = sizeof arm_claims / sizeof *arm_claims };

/* Two plates, 2 apart. Its tree says the axis, so that the kernel proves it as it is. */
static inline certificate plates_made(void)
{
    static const char plates[] =
        "impinge certificate 2\nprogram impinge 0\nverdict clear\napart 1\nfrom 0\nto 1\n"
        "parameter 0 1 w\nwithin 3 at 0 0\npoint 0 0 0 0\npoint 1 0 0 0\n"
        "body a\nshape 1 plate\nu in [-9, 0]; v in [0, 1]; u; v; 1\nsurface 0 0\n"
        "body b\nshape 1 plate\nu in [-9, 9]; v in [-9, 9]; u; v; -1\nsurface 1 1\ntrees\n";
    static const uint8_t tree[] = {0, 1, 0, 0, 5, 0, 0, 0, 0, 0x80, 1};
    return made(plates, tree, sizeof tree);
}

/* Most of these are refused for how they are written, whatever they claim. The points of the
 * plates, and what follows: */
#define PLATES                                                                                     \
    "u; v; 1\nsurface 0 0\nbody b\nshape 1 plate\nu in [-9, 9]; v in [-9, 9]; u; v; -1\nsurface "  \
    "1 1"
#define A_UP                                                                                       \
    "t in [0, 0.5]; u; v; 1 | u in [-9, 0]; v in [0, 1]; t in [0.5, 1]; u; v; 3\nsurface 0 0\n"    \
    "body b\nshape 1 plate\nu in [-9, 9]; v in [-9, 9]; "
#define B_AFTER(Z)                                                                                 \
    "t in [0, 0.5]; u; v; -1 | u in [-9, 9]; v in [-9, 9]; t in [0.5, 1]; u; v; " Z "\nsurface 1 " \
    "1"
#define MAPPED(A, B, BEFORE, AFTER)                                                                \
    A "u; v; -1\nmap 1 step\nt in [-inf, " B "]; x; y; z " BEFORE " | t in [" B                    \
      ", inf]; x; y; z " AFTER "\nsurface 1 1 2"
#define A_FLAT "u; v; 1\nsurface 0 0\nbody b\nshape 1 plate\nu in [-9, 9]; v in [-9, 9]; "
#define A_BESIDE(OWN, OTHER, Z)                                                                    \
    "t in [" OWN "]; u; v; 1 | u in [-9, 0]; v in [0, 1]; t in [" OTHER "]; u; v; " Z              \
    "\nsurface 0 0\nbody b\nshape 1 plate\nu in [-9, 9]; v in [-9, 9]; u; v; -1\nsurface 1 1"
#define FROM_W                                                                                     \
    "parameter 0 1 w\nwithin 3 at 0 0\npoint 0 0 0 0\npoint 1 0 0 0\nbody a\nshape 1 plate\n"      \
    "u in [-9, 0]; v in [0, 1]; "
#define AT_0_OF_W(Z)                                                                               \
    "parameter -1 1 w\nwithin 3 at 0 -1\npoint 0 0 0 0\npoint 1 0 0 0\nbody a\nshape 1 plate "     \
    "clock 1\nu in [-9, 0]; v in [0, 1]; t in [-1, 0]; u; v; 1 | u in [-9, 0]; v in [0, 1]; "      \
    "t in [0, 1]; u; v; 3\nsurface 0 0\nbody b\nshape 1 plate clock 1\nu in [-9, 9]; v in [-9, "   \
    "9]; t in [-1, 0]; u; v; -1 | u in [-9, 9]; v in [-9, 9]; t in [0, 1]; u; v; " Z               \
    "\nsurface 1 1"
#define POINTS "within 3 at 0 0\npoint 0 0 0 0\npoint 1 0 0 0\nbody a\nshape 1 plate\nu in"
static const claim_change plates_claims[] = {
    {"apart 1\n", "apart 1\n", true},
    {"apart 1\n", "apart 1\napart 1\n", false},
    {"from 0\n", "from 0\nfrom 0\n", false},
    {"to 1\n", "to 1\nto 1\n", false},
    {"clear\n", "clear\nverdict clear\n", false},
    {"trees\n", "trees 1\n", false},
    {"plate\n", "plate clock 1\n", true},
    {"plate\n", "plate clokc\n", false},
    {"plate\n", "plate clokc 1\n", false},
    {"plate\n", "plate clock 1 1\n", false},
    {"0 0 0 0\n", "0 0 0 0 0\n", false},
    /* surfaces that jump at one value of a clock, at which each of their parts counts */
    {PLATES, A_UP "u; v; -1\nsurface 1 1", true},
    {PLATES, A_UP B_AFTER("-3"), true},
    {PLATES, A_UP B_AFTER("0.9"), false},
    {PLATES, MAPPED(A_UP, "0.5", "", "- 2"), true},
    {PLATES, MAPPED(A_UP, "0.5", "", "+ 1.9"), false},
    {PLATES, MAPPED(A_FLAT, "1", "", "- 2"), true},
    {PLATES, MAPPED(A_FLAT, "1", "", "+ 1.9"), false},
    {PLATES, MAPPED(A_FLAT, "0", "- 0.5", ""), true},
    {PLATES, MAPPED(A_FLAT, "0", "+ 1.9", ""), false},
    {PLATES, A_BESIDE("0, 1", "1, 2", "3"), true},
    {PLATES, A_BESIDE("0, 1", "1, 2", "-1"), false},
    {PLATES, A_BESIDE("0, 1", "-1, 0", "1.5"), true},
    {PLATES, A_BESIDE("0, 1", "-1, 0", "-1"), false},
    {FROM_W PLATES, AT_0_OF_W("-0.1"), true},
    {FROM_W PLATES, AT_0_OF_W("0.9"), false},
    /* nothing is nearer than 0 */
    {"apart 1\n", "apart 0\n", false},
    {"apart 1\n", "apart 1e-400\n", false},
    {"clear\napart 1\n", "holds\napart 0\n", false},
    {"clear\napart 1\n", "contact\napart 0\n", true},
    {"clear\napart 1\n", "undecided\napart 0\n", true},
    /* names */
    {" w\n", " t\n", true},
    {" w\n", " it's\\ %c3%9f\n", true},
    {" w\n", " \xc3\x9f\n", false},
    {" w\n", " \x85\n", false},
    {" w\n", " \x7f\n", false},
    {"body a\n", "body \xc2\x9bK\n", false},
    {"body a\n",
     "body \xe2\x80\xae"
     "a\n",
     false}, /* U+202E: from right to left */
    {"body a\n",
     "body \xe2\x81\xa6"
     "a\n",
     false},
    {"body a\n", "body a\t\n", false},
    {"u in [-9", "pi = 3; u in [-9", false},
    {"u in [-9", "t = 3; u in [-9", false},
    {"u in [-9", "inf = 3; u in [-9", false},
    {"u in [-9", "sin = 3; u in [-9", false},
    {"u in [-9", "_a = 3; u in [-9", false},
    {"u in [-9", "a_ = 3; u in [-a_*a_", true},
    /* ranges */
    {"u in", "t in [-inf, inf]; u in", true},
    {"u in", "t in [-2*pi, inf ]; u in", true},
    {"u in", "t in [-inf, inf]; t in [0, 1]; u in", false},
    {POINTS, "body a\nshape 1 plate\nt in [inf, inf]; u in", false},
    {POINTS, "body a\nshape 1 plate\nt in [-inf, -inf]; u in", false},
    {"u in", "t in [-inf, inf + 0]; u in", false},
    {"u in", "t in [-1/inf, 1]; u in", false},
    {"u in", "t in [-inf, 1e308*10 - 1e308*10]; u in", false},
    {"u in", "t in [-inf, 1e30 + 2 - 1e30]; u in", false},
    {"[-9, 0]", "[-9, 1e30 + 0.1 - 1e30]", false},
    {"[-9, 0]", "[-9, 1e-320]", true},
    {"[-9, 0]", "[-9, pi/2 - 1]", true},
    /* powers of numbers below 0, whose exponent is whole and not seen to be, or is not */
    {"v; 1\n", "v; 1e13*(1e-13*u)^(1/3*3)\n", false},
    {"v; 1\n", "v; 1e13*(1e-13*u)^(pi/pi)\n", false},
    {"-9, 0]; v in [0, 1]; u; v; 1",
     "-0x1p-41, 0]; v in [0, 1]; u; v; u^65*0x1p1000*0x1p1000*0x1p700", false},
    {"v; 1\n", "v; (1 - u)^(1/3*3)\n", true}};
#undef POINTS
enum { PLATES_CLAIMS = sizeof plates_claims / sizeof *plates_claims };

#endif
