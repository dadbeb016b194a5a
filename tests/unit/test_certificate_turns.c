/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/made_certificate.h"
#include "tests/support/read_statement.h"
#include "tools/verify/round.h"

/* impinge-verify on maps that turn, of which all angles are bounded at once, and on shapes whose
 * points are circles. */

/* --- Bounds ----------------------------------------------------------------------------------- */

static const char shapes[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 1\nfrom -1\nto 3\nbody a\n"
    "shape 1 torus\nu in [0, 2*pi]; v in [0, 2*pi]; r = 2 + cos(v)/2; r*cos(u); r*sin(u); "
    "sin(v)/2\n"
    "shape 1 oval\nu in [0, 1]; v in [-1, 2]; A = 2*pi*u; C = cos(A); S = sin(A); "
    "1 + (2 + v)*C + 0.3*S; v - 2*S*(1 + t); 70 + v^2*C\n"
    "shape 1 patch\nu in [-1, 2]; v in [-1, 1]; u; u*v; 3 + u - v^2\n"
    "shape 1 wave\nu in [-1, 1]; v in [-1, 1]; u; v; sin(3*u + t)*exp(v)\n"
    "map 1 rotate\nA = 0.7 + 200*t + t^3; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z\n"
    "map 1 swing\nA = sin(9*t); C = cos(A); S = sin(A); x; 5 + (y - 5)*C - (z + 2)*S; "
    "(y - 5)*S + (z + 2)*C - 2\n"
    "map 1 squeeze\nA = 40*t; C = cos(A); S = sin(A); x*(2 + C) + z*S; y + 7*C; z + 0.5*y*S - x*C\n"
    "map 1 drift\nx + 5*t; y - t^2; z + sin(4*t)\n"
    "map 1 tilt\n0.6*x + 0.8*(z - 10); y; 0.6*(z - 10) - 0.8*x\n"
    "surface 0 0\nsurface 0 1\nsurface 0 0 4\nsurface 0 1 4\nsurface 0 2 4\nsurface 0 3 4\n"
    "surface 0 0 5\nsurface 0 1 6\nsurface 0 2 6\nsurface 0 0 4 7\nsurface 0 1 8 4 7\n"
    "surface 0 2 4 8 7\nsurface 0 0 8 4 8 5\nsurface 0 1 5 4 7\nsurface 0 3 7 6 8\n"
    "surface 0 0 4 4\ntrees\n";

/* A box of any size down to a few ulps, or a point. */
static box3 draw_box(uint64_t *seed, const place *of)
{
    box3 whole = {{0, 0, -1}, {0, 0, 3}}, b;
    piece_box(of, &whole);
    whole.lo[T] = -1, whole.hi[T] = 3;
    for (int j = 0; j < VARIABLES; ++j) {
        const double width = (whole.hi[j] - whole.lo[j]) * exp2(-random_between(seed, -1, 40));
        const double at = random_between(seed, whole.lo[j], whole.hi[j]);
        b.lo[j] = fmax(at - width / 2, whole.lo[j]);
        b.hi[j] = random_bits(seed) % 16 == 0 ? b.lo[j] : fmin(at + width / 2, whole.hi[j]);
    }
    return b;
}

static void draw_point(uint64_t *seed, const box3 *b, box3 *at)
{
    for (int j = 0; j < VARIABLES; ++j) {
        const double s = 0.5 + 0.5 * suite_end_or_inside(seed);
        const double x = b->lo[j] + s * (b->hi[j] - b->lo[j]);
        at->lo[j] = at->hi[j] = s == 1 ? b->hi[j] : fmin(fmax(x, b->lo[j]), b->hi[j]);
    }
}

/* n.x, at least. */
static double along_lower(const double n[3], const jet x[3])
{
    ld_interval sum = ld_interval_of(0);
    for (int i = 0; i < 3; ++i)
        sum = ld_interval_add(sum, ld_interval_mul(ld_interval_of(n[i]), x[i].v));
    return sum.lo;
}

static void check_reach(const scene *s, uint64_t *seed, const place *of, bool circles, int *bounded)
{
    const box3 b = draw_box(seed, of);
    const values when = *of->when;
    areas all = {.at = NULL};
    aim a = {.is_round = true, .circles = circles};
    for (int i = 0; i < 3; ++i) a.n[i] = random_between(seed, -1, 1);
    areas_begin(&all, s->known);
    ck_assert_ptr_null(areas_add(&all, of, &b, &a));
    const limits r = areas_limits(&all);
    *bounded += r.upper[0] < INFINITY;
    for (int k = 0; k < 12; ++k) {
        box3 at;
        jet x[3], same[3];
        split unused;
        const place bare = {of->of, of->chain, 0, of->maps, s->room, NULL, &when};
        draw_point(seed, &b, &at);
        ck_assert_int_eq(enclose(&bare, &at, at.lo, x, same, &unused), ENCLOSED);
        ck_assert_msg(
            along_lower(a.n, x) <= r.upper[0],
            "surface %td, u [%a, %a], v [%a, %a], t [%a, %a], point %a %a %a: %a above %a",
            of->chain - s->says.chains, b.lo[0], b.hi[0], b.lo[1], b.hi[1], b.lo[2], b.hi[2],
            at.lo[0], at.lo[1], at.lo[2], along_lower(a.n, x), r.upper[0]);
    }
    free(all.at);
}

START_TEST(all_angles_reach_as_far_as_each_of_them)
{
    uint64_t seed = suite_seed();
    scene s = scene_made(shapes);
    int bounded = 0;
    const int times = suite_times(600);
    const values when = {.count = 1, .lo = {-1}, .hi = {3}};
    for (int k = 0; k < times; ++k) {
        const chain *c = &s.says.chains[random_bits(&seed) % s.says.chain_count];
        const place of = {&s.says, c, 0, c->count - 1, s.room, NULL, &when};
        check_reach(&s, &seed, &of, k % 2 == 0, &bounded);
    }
    ck_assert_int_gt(bounded, times * 9 / 10);
    scene_free(&s);
}
END_TEST

/* At moments of some times: |x - c|^2 or |(x - c) x d|^2, and (x - c).d, less what they are at the
 * middle; about centres on the line of a turn and off it. */
START_TEST(distances_change_by_no_more_than_turns_change_them)
{
    uint64_t seed = suite_seed();
    scene s = scene_made(shapes);
    const values when = {.count = 1, .lo = {-1}, .hi = {3}};
    const int times = suite_times(200);
    for (int k = 0; k < times; ++k) {
        const chain *of_chain = &s.says.chains[2 + random_bits(&seed) % (s.says.chain_count - 2)];
        const place of = {&s.says, of_chain, 0, of_chain->count - 1, s.room, NULL, &when};
        const bool is_line = random_bits(&seed) % 2 == 0, is_off = random_bits(&seed) % 2 == 0;
        centre about = {.is_line = is_line, .d = {0, 0, is_line}};
        for (int i = 0; i < 3 && is_off; ++i) about.c[i] = random_between(&seed, -3, 3);
        for (int i = 0; i < 3 && is_off && is_line; ++i) about.d[i] = random_between(&seed, -1, 1);
        box3 b = draw_box(&seed, &of);
        b.lo[U] = b.hi[U], b.lo[V] = b.hi[V];
        aim a = {.n = {1, is_line, 0}, .about = &about, .times = {b.lo[T], b.hi[T]}};
        a.at = middle(b.lo[T], b.hi[T]);
        box3 at = b;
        jet x[2][3], same[3], parts[2][CENTRE_PARTS];
        split unused;
        for (int end = 0; end < 2; ++end) {
            at.lo[T] = at.hi[T] = end == 0 ? a.at : random_between(&seed, b.lo[T], b.hi[T]);
            ck_assert_int_eq(enclose(&of, &at, at.lo, x[end], same, &unused), ENCLOSED);
            centre_parts(x[end], &about, parts[end]);
        }
        if (enclose_piece(&of, 0)->parts[0].is_moving) continue;
        const double change = centre_change_upper(s.known, &of, &b, &a, 0);
        const jet before = centre_distance(parts[0], &a), after = centre_distance(parts[1], &a);
        const ld_interval by = ld_interval_abs(ld_interval_sub(after.v, before.v));
        ck_assert_msg(by.lo <= change, "surface %td, t %a [%a, %a]: %a above %a",
                      of_chain - s.says.chains, at.lo[T], b.lo[T], b.hi[T], by.lo, change);
    }
    scene_free(&s);
}
END_TEST

START_TEST(turns_and_circles_are_known_as_such)
{
    static const struct {
        const char *shape, *map;
        bool is_circle, turns;
    } texts[] = {
        {"cos(u); sin(u); v", "A = t; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z", true, true},
        {"cos(u); 2*sin(u) - cos(u); v*cos(u)", "C = cos(t); C*x; y; z*(1 - sin(t)/2)", true, true},
        {"u*cos(u); sin(u); v", "C = cos(t); C*x; y + t; z", false, false},
        {"C = cos(u); C*C; sin(u); v", "C = cos(t); C*x; y*C*sin(t); z", false, false},
        {"cos(u); sin(2*u); v", "x*cos(t) - y*sin(2*t); y; z", false, false},
        {"abs(cos(u)); sin(u); v", "x*max(cos(t), 0); y; z", false, false},
        {"min(cos(u), 0.5); sin(u); v", "x*max(cos(t), 0.5); y; z", false, false},
        {"cos(u)*sin(u); sin(u); v", "x*cos(t) + y*cos(t)*sin(t); y; z", false, false},
        {"cos(u + v); sin(u + v); v", "A = t + x; cos(A); y; z", false, false},
        {"cos(u) + 0/cos(u); sin(u); v", "x*cos(t) + 0*sqrt(cos(t)); y; z", false, false},
        {"A = u + 0*log(u - 0.1); cos(A); sin(A); v", "A = log(t); x*cos(A); y; z", false, false},
        {"cos(u)/(2 + cos(u)); sin(u); v", "x*cos(t) + 0.001*x*y; y; z", false, false},
        {"v; v; v", "x*cos(2); y; z", false, false}};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        char text[600];
        snprintf(text, sizeof text,
                 "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 1\nfrom 0\nto 1\n"
                 "body a\nshape 1 s\nu in [0, 2*pi]; v in [-1, 1]; %s\nmap 1 m\n%s\n"
                 "surface 0 0 1\ntrees\n",
                 texts[k].shape, texts[k].map);
        scene s = scene_made(text);
        ck_assert_int_eq(s.says.stages[0].pieces[0].parts[0].circle != NULL, texts[k].is_circle);
        ck_assert_int_eq(s.says.stages[1].pieces[0].parts[0].turn != NULL, texts[k].turns);
        scene_free(&s);
    }
}
END_TEST

/* --- Certificates ----------------------------------------------------------------------------- */

/* A roller of radius 1 that turns by 1000 rad, 0.01 from a plate. */
static const char roller[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.0099\nfrom 0\nto 1\n"
    "body a\nshape 1 cylinder\nr = 1; u in [0, 2*pi]; v in [-1, 1]; r*cos(u); r*sin(u); v\n"
    "map 1 rotate\nA = 1000*t; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z\nsurface 0 0 1\n"
    "body b\nshape 1 plane\nu in [-2, 2]; v in [-2, 2]; 1.01; u; v\nsurface 1 2\ntrees\n";

/* A square bar that turns by 1000 rad in a bore, 0.01 from it. */
static const char bar[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.009\nfrom 0\nto 1\n"
    "body a\nshape 1 cylinder\nu in [0, 2*pi]; v in [-1, 1]; cos(u); sin(u); v\nsurface 0 0\n"
    "body b\nshape 1 side\nr = 0.99; u in [0, 1]; v in [-0.5, 0.5]; r*(1 - u); r*u; v\n"
    "map 1 rotate\nA = 1000*t; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z\nsurface 1 1 2\n"
    "trees\n";

/* A ring that turns by 1000 rad beside a ball: 0.01 from it where it is widest. */
static const char ring[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.0099\nfrom 0\nto 1\n"
    "body a\nshape 1 torus\nr = 0.25; u in [0, 2*pi]; v in [0, 2*pi]; b = 1 + r*cos(v); "
    "b*cos(u); b*sin(u); r*sin(v)\n"
    "map 1 rotate\nA = 1000*t; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z\n"
    "map 1 move\nx; y + 0*t; z\nsurface 0 0 1 2\n"
    "body b\nshape 1 sphere\nu in [0, 2*pi]; v in [-pi/2, pi/2]; 1.76 + 0.5*cos(v)*cos(u); "
    "0.5*cos(v)*sin(u); 0.5*sin(v)\nsurface 1 3\ntrees\n";

static const uint8_t leaf_tree[] = {0, 1, 0, 7};

typedef struct change {
    const char *from, *to;
    bool holds;
} change;

static void check_changes(const char *text, const change *all, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        certificate c = made(text, leaf_tree, sizeof leaf_tree);
        replace(&c, all[k].from, all[k].to);
        require_within(&c, all[k].holds ? EFFORT : EFFORT_OF_CHANGES, all[k].holds ? NULL : "");
    }
}

START_TEST(rollers_are_parted_from_plates_for_all_angles)
{
    static const change all[] = {
        {"r = 1;", "r = 1;", true},
        {"1.01;", "1.0098;", false},
        {"apart 0.0099", "apart 0.0101", false},
        {"r = 1;", "r = 1.0002;", false},
        {"A = 1000*t", "A = 1000*t + 3*sin(50*t)", true},
        {"A = 1000*t", "A = 900*atan(9*t)", true},
        {"A = 1000*t", "A = log(t - 0.001)*900", false},
        /* beside its axis, at all times, in the end, and for a moment */
        {"r*cos(u);", "0.0002 + r*cos(u);", false},
        {"x*C - y*S;", "x*C - y*S + 0.0002*t;", false},
        {"x*C - y*S;", "x*C - y*S + 0.001*t*(1 - t);", false},
        {"x*C - y*S;", "x*C - y*S + 0.0002*S;", false},
        /* no rotation: the ellipse of a point is wider */
        {"x*C - y*S;", "1.0002*x*C - y*S;", false},
        {"x*C - y*S;", "x*C - 1.0002*y*S;", false},
        {"x*C - y*S;", "x*C - 0.9*y*S;", true},
        {"x*C - y*S;", "x*C - y*S + 0.0002*z*C;", false},
        {"x*C - y*S;", "x*C - y*cos(A + 1.56);", false},
        /* tilted, and no circle */
        {"r*sin(u); v", "r*sin(u) + 0.03*v; v", false},
        {"r*cos(u);", "r*cos(u)*(1 + 0.0002*sin(9*u));", false},
        {"r*cos(u);", "r*(cos(u) + 0.0002*v);", false},
    };
    check_changes(roller, all, sizeof all / sizeof *all);
    certificate c = made(roller, leaf_tree, sizeof leaf_tree);
    replace(&c, "z\nsurface 0 0 1\n",
            "z\nmap 1 move\nx + 0.0002*sin(90*t); y; z\nsurface 0 0 1 2\n");
    replace(&c, "surface 1 2\n", "surface 1 3\n");
    require_within(&c, EFFORT_OF_CHANGES, "");
    replace(&c, "0.0002*sin", "0.00005*sin");
    require(&c, NULL);
}
END_TEST

START_TEST(bars_are_parted_from_bores_for_all_angles)
{
    static const change all[] = {
        {"r = 0.99;", "r = 0.99;", true},
        {"r = 0.99;", "r = 0.9912;", false},
        {"apart 0.009", "apart 0.0101", false},
        {"apart 0.009", "apart 0.0099", true},
        {"A = 1000*t", "A = 1000*t^2", true},
        {"x*C - y*S;", "x*C - y*S + 0.0012*t;", false},
        {"x*C - y*S;", "x*C - y*S + 0.005*t*(1 - t);", false},
        {"x*C - y*S;", "x*C - y*S + 0.0012*C;", false},
        {"x*C - y*S;", "1.0012*x*C - y*S;", false},
        {"x*C - y*S;", "x*C - y*S + 0.003*z*S;", false},
        {"r*(1 - u); r*u;", "r*(1 - u) + 0.0012; r*u;", false},
        {"cos(u); sin(u); v\n", "0.9988*cos(u); sin(u); v\n", false},
        {"cos(u); sin(u); v\n", "cos(u) + 0.0012; sin(u); v\n", false},
    };
    check_changes(bar, all, sizeof all / sizeof *all);
}
END_TEST

START_TEST(rings_are_parted_from_balls_for_all_angles)
{
    static const change all[] = {
        {"r = 0.25;", "r = 0.25;", true},
        {"r = 0.25;", "r = 0.2502;", false},
        {"apart 0.0099", "apart 0.0101", false},
        {"y + 0*t", "y + 0.03*t", true},
        {"x; y + 0*t", "x + 0.0002*t; y", false},
        {"x; y + 0*t", "x + 0.0002*sin(30*t); y", false},
        {"1 + r*cos(v)", "1 + r*cos(v) + 0.0002*sin(u)", false},
        {"1.76 +", "1.7598 +", false},
        {"x*C - y*S;", "x*C - y*S + 0.0002*C;", false},
    };
    check_changes(ring, all, sizeof all / sizeof *all);
}
END_TEST

SUITE_MAIN("certificate turns", all_angles_reach_as_far_as_each_of_them,
           distances_change_by_no_more_than_turns_change_them, turns_and_circles_are_known_as_such,
           rollers_are_parted_from_plates_for_all_angles, bars_are_parted_from_bores_for_all_angles,
           rings_are_parted_from_balls_for_all_angles)
