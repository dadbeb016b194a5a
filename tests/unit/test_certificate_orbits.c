/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tests/support/read_statement.h"
#include "tests/support/suite.h"
#include "tools/verify/motion_internal.h"

/* impinge-verify bounds each element of a quadratic form for all angles of a map that turns; and it
 * takes all angles only where each map of a chain is a single affine one that follows T, and all of
 * a circle where its shape is one part. */

/* --- Elements of forms ------------------------------------------------------------------------ */

/* No map is a rotation alone: of rotations, and forms that are round about their axis, some of what
 * the bounds are a sum of is 0. */
static const char maps[] =
    "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 1\nfrom -1\nto 3\nbody a\n"
    "shape 1 patch\nu in [-1, 2]; v in [-1, 1]; u; u*v; 3 + u - v^2\n"
    "map 1 wide\nA = 0.7 + 200*t; C = cos(A); S = sin(A); 1.5*x*C - y*S; x*S + 0.5*y*C; z\n"
    "map 1 skew\nA = 9*sin(9*t); C = cos(A); S = sin(A); x + 0.5*z*C; y + 2*S*z; 0.5*z + x*S + C\n"
    "map 1 orbit\nA = 50*t^2; x + cos(A); y + 2*sin(A); z\n"
    "map 1 rotate\nA = 90*t; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z\n"
    "map 1 drift\nx + 0.5*t; y - t^2; z + sin(4*t)\n"
    "map 1 tilt\n0.6*x + 0.8*(z - 1); y; 0.6*(z - 1) - 0.8*x\n"
    "map 1 grow\nx*(1 + 0.5*t); y - z*t; z + 1\n"
    "surface 0 0 1\nsurface 0 0 2\nsurface 0 0 3\nsurface 0 0 4\nsurface 0 0 1 5\n"
    "surface 0 0 5 2\nsurface 0 0 6 4\nsurface 0 0 3 6 5\nsurface 0 0 4 1\nsurface 0 0 4 "
    "7\nsurface 0 0 7 1\ntrees\n";

/* A form about a point or a line, and a direction: at random, or along the axes, so that elements
 * hold little but what an angle does to them. */
typedef struct drawn_form {
    double c[3], w[3];
    ld_interval e[3][3];
} drawn_form;

static void draw_form(uint64_t *seed, drawn_form *f)
{
    const bool is_off = random_bits(seed) % 2 == 0, is_aslant = random_bits(seed) % 2 == 0;
    const int kind = (int)(random_bits(seed) % 3), axis = (int)(random_bits(seed) % 3);
    double d[3];
    for (int i = 0; i < 3; ++i) {
        f->c[i] = is_off ? random_between(seed, -1, 1) : 0;
        d[i] = is_aslant ? random_between(seed, -1, 1) : i == axis;
        f->w[i] = d[i];
    }
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const double same = i == k, both = d[i] * d[k];
            f->e[i][k] = ld_interval_of(kind == 0 ? same : kind == 1 ? same - both : both);
        }
    for (int i = 0; i < 3; ++i) /* rounded alike on both sides of the diagonal */
        for (int k = 0; k < i; ++k) f->e[i][k] = f->e[k][i];
}

/* Writes (M, d - c) at a moment. */
static void take_moment(const place *of, double t, const double c[3], ld_interval n[3][4])
{
    layered all;
    bool all_affine;
    split unused;
    ck_assert_int_eq(motion_take_chain(of, t, t, &all, &all_affine, &unused), ENCLOSED);
    ck_assert(all_affine && all.count == 0);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) n[i][k] = all.base.wide[i][k].v;
        n[i][3] = ld_interval_sub(n[i][3], ld_interval_of(c[i]));
    }
    free(all.ways);
}

/* Element k of w^T N, if i is 4; else i, k of N^T E N. */
static ld_interval element(ld_interval n[3][4], drawn_form *f, int i, int k)
{
    ld_interval sum = ld_interval_of(0);
    for (int a = 0; a < 3; ++a) {
        const ld_interval lift = ld_interval_mul(ld_interval_of(f->w[a]), n[a][k]);
        if (i == 4) sum = ld_interval_add(sum, lift);
        for (int b = 0; b < 3 && i < 4; ++b) {
            const ld_interval both = ld_interval_mul(n[a][i], n[b][k]);
            sum = ld_interval_add(sum, ld_interval_mul(both, f->e[a][b]));
        }
    }
    return sum;
}

static void check_moment(ld_interval before[3][4], ld_interval now[3][4], drawn_form *f,
                         const form_changes *found, int index)
{
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 4; ++k) {
            const ld_interval by = ld_interval_sub(element(now, f, i, k), element(before, f, i, k));
            const double most = i < 4 ? found->most[index][i][k] : found->lift[index][k];
            ck_assert_msg(ld_interval_abs(by).lo <= most, "element %d %d, part %d: %a above %a", i,
                          k, index, ld_interval_abs(by).lo, most);
        }
}

START_TEST(elements_of_forms_change_by_no_more_than_bounds_of_all_angles)
{
    uint64_t seed = suite_seed();
    scene s = scene_made(maps);
    const values when = {.count = 1, .lo = {-1}, .hi = {3}};
    const int times = suite_times_from(200, 100);
    for (int k = 0; k < times; ++k) {
        const chain *c = &s.says.chains[random_bits(&seed) % s.says.chain_count];
        const place of = {&s.says, c, 0, c->count - 1, s.room, NULL, &when};
        const double width = exp2(random_between(&seed, -12, 2));
        const double lo = random_between(&seed, -1, 3 - width), hi = lo + width;
        drawn_form f;
        form_changes found;
        ld_interval before[3][4], now[3][4];
        draw_form(&seed, &f);
        motion_form_changes(&of, lo, hi, f.c, f.e, f.w, &found);
        ck_assert(found.are_known);
        take_moment(&of, middle(lo, hi), f.c, before);
        for (int n = 0; n < 8; ++n) {
            const int index = (int)(random_bits(&seed) % CHANGE_PARTS);
            const double share = (index + random_between(&seed, 0.001, 0.999)) / CHANGE_PARTS;
            take_moment(&of, lo + (hi - lo) * share, f.c, now);
            check_moment(before, now, &f, &found, index);
        }
    }
    scene_free(&s);
}
END_TEST

/* --- Chains ----------------------------------------------------------------------------------- */

static const char chains[] =
    "impinge certificate 2\nprogram impinge 0\nverdict clear\napart 1\nfrom 0\nto 2\n"
    "parameter 0 1 p\nbody a\nshape 1 patch\nu in [0, 1]; v in [0, 1]; u; v; 0\n"
    "map 1 rotate\nA = 30*t; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z\n"
    "map 1 bend\nx; y; z + 0.1*x^2\n"
    "map 1 parts\nt in [-1, 1]; x*cos(9*t); y; z | t in [1, 3]; x*cos(9); y*cos(9*(t - 1)); z\n"
    "map 1 kink\nx*max(cos(9*t), 0.5); y; z\n"
    "map 1 rotate clock 1\nA = 30*t; C = cos(A); S = sin(A); x*C - y*S; x*S + y*C; z\n"
    "surface 0 0 1\nsurface 0 0 1 2\nsurface 0 0 2 1\nsurface 0 0 3\nsurface 0 0 4\n"
    "surface 0 0 5\nsurface 0 0 1 5\ntrees\n";

START_TEST(orbits_are_known_of_single_affine_maps_that_follow_time)
{
    static const struct {
        size_t chain, main;
        double lo, hi;
        bool is_known, turns;
    } all[] = {
        {0, 0, 0, 2, true, true},       {0, 1, 0, 1, false, false}, {1, 0, 0, 1, false, false},
        {2, 0, 0, 1, false, false},     {3, 0, 0, 0.5, true, true}, {3, 0, 0.5, 1, true, true},
        {3, 0, 0.5, 1.5, false, false}, {3, 0, 1, 1, false, false}, {3, 0, 1, 2, true, true},
        {4, 0, 0, 1, true, false},      {5, 0, 0, 1, false, false}, {5, 1, 0, 1, true, true},
        {6, 0, 0, 1, false, false},     {6, 1, 0, 1, false, false},
    };
    scene s = scene_made(chains);
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        const chain *c = &s.says.chains[all[k].chain];
        const values when = {.count = 2, .main = all[k].main, .lo = {0, 0}, .hi = {2, 1}};
        const place of = {&s.says, c, 0, c->count - 1, s.room, NULL, &when};
        orbit o;
        orbit_take(&of, all[k].lo, all[k].hi, &o);
        ck_assert_msg(o.is_known == all[k].is_known, "chain %zu", k);
        ck_assert_msg(!o.is_known || o.turns == all[k].turns, "chain %zu", k);
    }
    scene_free(&s);
}
END_TEST

/* --- Circles ---------------------------------------------------------------------------------- */

static const char circles[] =
    "impinge certificate 2\nprogram impinge 0\nverdict clear\napart 1\nfrom 0\nto 2\n"
    "parameter 0 1 p\nbody a\nshape 1 parts\n"
    "t in [0, 1]; u in [0, 7]; v in [0, 1]; cos(u); sin(u); v"
    " | t in [1, 2]; u in [0, 7]; v in [0, 1]; 2*cos(u); sin(u); v\n"
    "shape 1 moves\nu in [0, 7]; v in [0, 1]; (1 + t)*cos(u); sin(u); v\n"
    "shape 1 moves clock 1\nu in [0, 7]; v in [0, 1]; (1 + t)*cos(u); sin(u); v\n"
    "shape 1 rests clock 1\nu in [0, 7]; v in [0, 1]; 2*cos(u); sin(u); v\n"
    "surface 0 0\nsurface 0 1\nsurface 0 2\nsurface 0 3\ntrees\n";

START_TEST(circles_are_known_of_single_parts_that_follow_time_or_rest)
{
    static const struct {
        size_t chain, main;
        double lo, hi;
        bool is_known;
    } all[] = {
        {0, 0, 0, 1, true},  {0, 0, 1, 2, true}, {0, 0, 1, 1, false}, {0, 0, 0.5, 1.5, false},
        {0, 1, 0, 1, false}, {1, 0, 0, 2, true}, {1, 1, 0, 1, false}, {2, 0, 0, 1, false},
        {2, 1, 0, 1, true},  {3, 0, 0, 2, true}, {3, 1, 0, 1, true},
    };
    scene s = scene_made(circles);
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        const values when = {.count = 2, .main = all[k].main, .lo = {0, 0}, .hi = {2, 1}};
        const place of = {&s.says, &s.says.chains[all[k].chain], 0, 0, s.room, NULL, &when};
        const box3 b = {{0, 0, all[k].lo}, {7, 1, all[k].hi}};
        ck_assert_msg((look_circle(s.known, &of, &b) != NULL) == all[k].is_known, "line %zu", k);
    }
    scene_free(&s);
}
END_TEST

SUITE_MAIN("certificate orbits", elements_of_forms_change_by_no_more_than_bounds_of_all_angles,
           orbits_are_known_of_single_affine_maps_that_follow_time,
           circles_are_known_of_single_parts_that_follow_time_or_rest)
