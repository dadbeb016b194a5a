/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <mpfi.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/support/made_texts.h"
#include "tests/support/suite.h"
#include "tools/kernel/kernel.h"
#include "tools/verify/elaborate.h"

/* impinge-verify-kernel on certificates that are made here, elaborated, and changed: whatever it
 * accepts must be true, as points of the formulas show. */

enum { CHECKSUM = 32, EFFORT = 3000 };

/* --- The kernel ------------------------------------------------------------------------------- */

typedef struct judged {
    bool holds;
    char fault[1000];
    claim c; /* to be freed */
} judged;

static void judge(const uint8_t *bytes_of, size_t size, judged *j)
{
    FILE *file = fmemopen((void *)(uintptr_t)bytes_of, size, "rb");
    ck_assert_ptr_nonnull(file);
    bytes in = {.file = file};
    trees w = {.in = &in, .of = &j->c};
    j->holds = claim_read(&j->c, &in) && trees_hold(&w);
    ck_assert(j->holds == bytes_are_good(&in));
    memcpy(j->fault, in.fault, sizeof in.fault);
    fclose(file);
}

/* Judges a certificate with any checksum, which the kernel does not compare. */
static bool accepts(const certificate *c)
{
    uint8_t all[BYTES_MAX + CHECKSUM] = {0};
    judged j;
    memcpy(all, c->bytes, c->size);
    judge(all, c->size + CHECKSUM, &j);
    claim_free(&j.c);
    return j.holds;
}

/* Elaborates a certificate; false: it cannot be, and found->why tells. */
static bool elaborated_of(const certificate *c, unsigned long effort, certificate *to,
                          elaborated *found)
{
    uint8_t all[BYTES_MAX + CHECKSUM] = {0};
    char *out = NULL;
    size_t size = 0;
    memcpy(all, c->bytes, c->size);
    FILE *from = fmemopen(all, c->size + CHECKSUM, "rb"), *file = open_memstream(&out, &size);
    ck_assert(from != NULL && file != NULL);
    const bool good = elaborate(from, file, effort, NULL, found);
    fclose(from);
    fclose(file);
    if (good) {
        ck_assert_uint_le(size, BYTES_MAX);
        to->size = size - CHECKSUM;
        memcpy(to->bytes, out, to->size);
    }
    free(out);
    return good;
}

static certificate made_for_kernel(certificate c)
{
    certificate made;
    elaborated found;
    ck_assert_msg(elaborated_of(&c, EFFORT, &made, &found), "%s", found.why);
    return made;
}

START_TEST(elaborated_certificates_hold)
{
    const certificate all[] = {bowl_made(), balls_made(), roofs_made(), arm_made()};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        const certificate made = made_for_kernel(all[k]);
        ck_assert_msg(accepts(&made), "certificate %zu", k);
    }
}
END_TEST

/* The kernel refuses axes of no length, none, and maps left out, which the verifier does not. */
START_TEST(what_is_not_elaborated_is_refused)
{
    static const uint8_t alone[] = {0, 1, 0, 7}, nothing[] = {0, 1, 0, 5, 0, 0, 0, 0, 0, 0};
    const certificate a = made(bowl, alone, sizeof alone), b = made(bowl, nothing, sizeof nothing);
    const certificate c = balls_made();
    ck_assert(!accepts(&a));
    ck_assert(!accepts(&b));
    ck_assert(!accepts(&c));
}
END_TEST

/* --- False claims ----------------------------------------------------------------------------- */

/* The claim is changed in what was elaborated, and before. */
static void require_claims(const char *what, certificate c, const claim_change *by, int count)
{
    const certificate long_one = made_for_kernel(c);
    for (int k = 0; k < count; ++k) {
        certificate before = c, after = long_one, made;
        elaborated found;
        replace(&before, by[k].from, by[k].to);
        replace(&after, by[k].from, by[k].to);
        const bool good = elaborated_of(&before, by[k].holds ? EFFORT : 150, &made, &found);
        ck_assert_msg(good == by[k].holds, "%s, %s: %s", what, by[k].to, found.why);
        ck_assert_msg(by[k].holds || !accepts(&after), "%s, %s: accepted", what, by[k].to);
        ck_assert_msg(!good || accepts(&made), "%s, %s: refused", what, by[k].to);
    }
}

START_TEST(false_claims_are_refused)
{
    require_claims("bowl", bowl_made(), bowl_claims, BOWL_CLAIMS);
    require_claims("arm", arm_made(), arm_claims, ARM_CLAIMS);
}
END_TEST

START_TEST(what_is_said_otherwise_is_refused)
{
    for (int k = 0; k < PLATES_CLAIMS; ++k) {
        certificate c = plates_made();
        replace(&c, plates_claims[k].from, plates_claims[k].to);
        ck_assert_msg(accepts(&c) == plates_claims[k].holds, "%d: %s", k, plates_claims[k].to);
    }
    certificate round = plates_made(); /* of what rounding takes below 0 the root is 0 */
    replace(&round, "v; 1\n", "v; (1 - u^2/81)^0.5\n");
    ck_assert(accepts(&round));
}
END_TEST

/* --- Changes at random ------------------------------------------------------------------------ */

typedef struct found_point {
    double x[3];
    bool some;
} found_point;

static void take_point(void *context, const slope x[3], const range shift[CLAIM_CLOCKS])
{
    found_point *f = context;
    (void)shift;
    for (int i = 0; i < 3; ++i) f->x[i] = x[i].v.lo;
    f->some = x[0].v.hi - x[0].v.lo < 1e-9 && x[1].v.hi - x[1].v.lo < 1e-9 &&
              x[2].v.hi - x[2].v.lo < 1e-9;
}

/* Draws a number near `at`, or anywhere. */
static double draw(range all, double at, double size, uint64_t *seed)
{
    const double r = all.lo + (all.hi - all.lo) * random_between(seed, 0, 1);
    return size < 1 ? at + size * (r - at) : r;
}

/* Whether points of the first two surfaces are found that are clearly nearer than is stated. Each
 * draw that is nearer draws the next ones to it. */
static bool is_false(claim *c, uint64_t *seed)
{
    double best = INFINITY, size = 1;
    pair p = {.of = c, .side = {&c->surfaces[0], &c->surfaces[1]}};
    cell at = {.count = {1, 1}};
    for (int k = 0; k<200; ++k, size *= k> 60 ? 0.93 : 1) {
        cell here = at;
        found_point x[2] = {{.some = false}, {.some = false}};
        for (int side = 0; side < 2; ++side) {
            range uv[2];
            const stage *g = &c->stages[p.side[side]->stages[0]];
            if (size == 1)
                here.first[side] = (size_t)(random_between(seed, 0, 1) * (double)g->count);
            leaf_box(&p, side, here.first[side], uv);
            for (int j = 0; j < 2; ++j)
                here.uv[side][j] = range_of(draw(uv[j], at.uv[side][j].lo, size, seed));
        }
        for (size_t j = 0; j < c->clock_count; ++j)
            here.clocks[j] = range_of(draw(c->clocks[j].all, at.clocks[j].lo, size, seed));
        if (!leaf_visit(&p, &here, 0, take_point, &x[0]) ||
            !leaf_visit(&p, &here, 1, take_point, &x[1]) || !x[0].some || !x[1].some)
            continue;
        const double gap =
            hypot(hypot(x[0].x[0] - x[1].x[0], x[0].x[1] - x[1].x[1]), x[0].x[2] - x[1].x[2]);
        if (gap < best) best = gap, at = here;
    }
    return best < c->apart * (1 - 1e-9);
}

static void change(certificate *c, uint64_t *seed)
{
    static const char marks[] = "0123456789+-*/().;,uvtxyz ";
    const size_t at = (size_t)(random_between(seed, 0, 1) * (double)c->size);
    const double kind = random_between(seed, 0, 1);
    const char mark = marks[(size_t)(random_between(seed, 0, 1) * (double)(sizeof marks - 1))];
    if (kind < 0.6)
        c->bytes[at] = (uint8_t)mark;
    else if (kind < 0.8)
        c->bytes[at] ^= (uint8_t)(1u << (unsigned)(random_between(seed, 0, 1) * 8));
    else {
        memmove(c->bytes + at, c->bytes + at + 1, c->size - at - 1);
        c->size -= 1;
    }
}

START_TEST(no_change_makes_a_false_statement_hold)
{
    const certificate all[] = {made_for_kernel(bowl_made()), made_for_kernel(balls_made()),
                               made_for_kernel(roofs_made()), made_for_kernel(arm_made())};
    uint64_t seed = suite_seed();
    const int count = suite_times(4000);
    int accepted = 0;
    for (int k = 0; k < count; ++k) {
        uint8_t bytes_of[BYTES_MAX + CHECKSUM] = {0};
        certificate c = all[k % 40 == 39   ? 1
                            : k % 40 == 38 ? 3
                                           : 2 * (k % 2)]; /* few leaves, mostly */
        judged j;
        for (int n = 1 + k % 3; n > 0; --n) change(&c, &seed);
        memcpy(bytes_of, c.bytes, c.size);
        judge(bytes_of, c.size + CHECKSUM, &j);
        accepted += j.holds;
        if (j.holds && j.c.surface_count >= 2 && !claim_ignores(&j.c, 0, 1))
            ck_assert_msg(!is_false(&j.c, &seed), "change %d: false, and accepted: %.*s", k,
                          (int)c.size, (const char *)c.bytes);
        claim_free(&j.c);
    }
    ck_assert_int_gt(accepted, 0); /* names and hints may change */
    ck_assert_int_lt(accepted, count);
}
END_TEST

/* --- Slopes ----------------------------------------------------------------------------------- */

static bool meet(range x, range y) { return x.lo <= y.hi && y.lo <= x.hi; }

/* Values and slopes over a box against values at points of it. */
static void require_slopes(const char *text, uint64_t *seed)
{
    range said[EXPRESSION_VARIABLES], offset[SLOPE_VARIABLES];
    slope in[3], single[3], out[3], at[3];
    double middle[3], x[3];
    const char *why, *rest = text;
    memo wide = {.of = NULL}, narrow = {.of = NULL};
    expression *e = expression_read(&rest, "uvt", said, &why);
    ck_assert_msg(e != NULL, "%s: %s", text, why);
    for (int k = suite_times(100); k > 0; --k) {
        for (int j = 0; j < 3; ++j) {
            const double a = random_between(seed, -2, 2), b = a + random_between(seed, 0, 1.5);
            const bool again = wide.of != NULL && random_between(seed, 0, 1) < 0.4; /* as before */
            const range where = again ? in[j].v : (range){a, b};
            middle[j] = range_middle(where);
            offset[j] = range_sub(where, range_of(middle[j]));
            in[j] = slope_variable(j, where, offset);
            x[j] = random_between(seed, where.lo, where.hi);
            single[j] = slope_fixed(range_of(x[j]));
        }
        ck_assert(expression_compute(e, &wide, 0, in, out));
        ck_assert(expression_compute(e, &narrow, 0, single, at));
        for (int i = 0; i < 3; ++i) {
            if (out[i].is_undefined) continue;
            range sum = out[i].c;
            ck_assert_msg(!at[i].is_undefined, "%s: no value at %a, %a, %a", text, x[0], x[1],
                          x[2]);
            for (int j = 0; j < 3; ++j)
                if (slope_has(&out[i], j)) {
                    const range step = range_sub(range_of(x[j]), range_of(middle[j]));
                    sum = range_add(sum, range_mul(out[i].s[j], step));
                }
            ck_assert_msg(meet(at[i].v, out[i].v) && meet(at[i].v, sum),
                          "%s, coordinate %d at %a, %a, %a: [%a, %a] is not in [%a, %a], [%a, %a]",
                          text, i, x[0], x[1], x[2], at[i].v.lo, at[i].v.hi, out[i].v.lo,
                          out[i].v.hi, sum.lo, sum.hi);
        }
    }
    free(e);
    free(wide.value);
    free(narrow.value);
}

START_TEST(slopes_enclose_values)
{
    static const char *const texts[] = {"u*v - t; u/(v^2 + 1); u^3 - 2*u*v",
                                        "sin(u)*cos(3*v); cos(u*t); sin(u + v)^2",
                                        "hypot(u, v); sqrt(u^2 + v^2 + 1); hypot(u, v, t)",
                                        "abs(u)^1.5; abs(v)^0.4; clamp(u, -0.5, v)",
                                        "tan(0.3*u); u^-2; (u + 3)^2.5 + v^5",
                                        "max(u, max(v, t)); min(u, -v); abs(u*v)",
                                        "a = u - v; a*a; a^4 - a; 1/(2 + sin(a))"};
    uint64_t seed = suite_seed();
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) require_slopes(texts[k], &seed);
}
END_TEST

/* --- Arithmetic ------------------------------------------------------------------------------- */

static double drawn_number(uint64_t *seed)
{
    static const double special[] = {0,       -0.0,     1,          -1,       0.1,    3,
                                     0x1p-53, 0x1p-500, -0x1p-1074, 0x1p1000, -1e308, 0x1p400};
    const double kind = random_between(seed, 0, 1), x = random_between(seed, -2, 2);
    if (kind < 0.3) return special[(size_t)(random_between(seed, 0, 0.999999) * 12)];
    if (kind < 0.6) return ldexp(x, (int)random_between(seed, -60, 60));
    return kind < 0.8 ? (double)(float)x : x;
}

static range drawn_range(uint64_t *seed)
{
    const double x = drawn_number(seed),
                 y = random_between(seed, 0, 1) < 0.4 ? x : drawn_number(seed);
    return (range){fmin(x, y), fmax(x, y)};
}

static bool is_plain(range x)
{
    const double size[2] = {fabs(x.lo), fabs(x.hi)};
    for (int k = 0; k < 2; ++k)
        if (size[k] != 0 && !(size[k] > 0x1p-400 && size[k] < 0x1p400)) return false;
    return true;
}

/* Sums, products and quotients are MPFI's where nothing over- or underflows, and contain them
 * elsewhere. */
START_TEST(arithmetic_rounds_like_mpfi)
{
    static range (*const own[])(range, range) = {range_add, range_sub, range_mul, range_div};
    static int (*const other[])(mpfi_ptr, mpfi_srcptr, mpfi_srcptr) = {mpfi_add, mpfi_sub, mpfi_mul,
                                                                       mpfi_div};
    uint64_t seed = suite_seed();
    mpfi_t a, b, c;
    mpfi_init2(a, 53), mpfi_init2(b, 53), mpfi_init2(c, 53);
    for (int k = suite_times(40000); k > 0; --k) {
        const range x = drawn_range(&seed), y = drawn_range(&seed);
        if (k % 4 == 3 && range_has_0(y)) continue;
        const range r = own[k % 4](x, y);
        mpfi_interv_d(a, x.lo, x.hi), mpfi_interv_d(b, y.lo, y.hi);
        other[k % 4](c, a, b);
        const double lo = mpfr_get_d(&c->left, MPFR_RNDD), hi = mpfr_get_d(&c->right, MPFR_RNDU);
        const bool good =
            is_plain(x) && is_plain(y) ? r.lo == lo && r.hi == hi : r.lo <= lo && r.hi >= hi;
        ck_assert_msg(good, "%d: [%a, %a] and [%a, %a]: [%a, %a], not [%a, %a]", k % 4, x.lo, x.hi,
                      y.lo, y.hi, r.lo, r.hi, lo, hi);
    }
    mpfi_clear(a), mpfi_clear(b), mpfi_clear(c);
}
END_TEST

/* --- Leaves whose sides are divided ----------------------------------------------------------- */

START_TEST(sides_of_a_leaf_are_divided_as_its_trees_say)
{
    static const struct {
        uint8_t trees[8];
        size_t size;
        bool holds;
    } all[] = {{{2, 2}, 2, true},    {{0, 2, 1, 2, 2, 2}, 6, true}, {{2, 1, 1, 2, 2, 2}, 6, true},
               {{2}, 1, false},      {{0, 2, 2, 1, 2}, 5, false},   {{3, 2, 2, 2}, 4, false},
               {{2, 2, 2}, 3, false}};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        certificate c = plates_made();
        const size_t leaf = c.size - 7; /* 5, and the axis; 9 begins a leaf with two trees */
        ck_assert_int_eq(c.bytes[leaf], 5);
        c.bytes[leaf] = 9;
        memcpy(c.bytes + c.size, all[k].trees, all[k].size);
        c.size += all[k].size;
        ck_assert_msg(accepts(&c) == all[k].holds, "trees %zu", k);
        c.bytes[c.size - all[k].size - 2] = 0x7f; /* another axis */
        ck_assert(!accepts(&c));
    }
}
END_TEST

/* A hill under a plane: no single enclosure of the hill parts them by one axis, its parts do; and
 * not if it is higher. */
START_TEST(parts_of_a_side_all_count)
{
    static const char hill[] =
        "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.5\nfrom 0\nto 1\n"
        "body hill\nshape 1 hill\nu in [-1, 1]; v in [-1, 1]; u; v; 1 - u^2 - v^2 + u*v\n"
        "surface 0 0\nbody lid\nshape 1 lid\nu in [-1, 1]; v in [-1, 1]; u; v; 1.6 + 0*t\n"
        "surface 1 1\ntrees\n";
    static const uint8_t entries[] = {0, 1, 0, 7};
    const certificate c = made(hill, entries, sizeof entries), long_one = made_for_kernel(c);
    const uint8_t *at = memmem(long_one.bytes, long_one.size, "trees\n", 6);
    ck_assert_ptr_nonnull(at);
    ck_assert_int_eq(at[6 + 3], 9);
    certificate higher = long_one;
    replace(&higher, "; 1 - u^2", "; 1.2 - u^2");
    ck_assert(!accepts(&higher));
}
END_TEST

/* --- Parts of motions ------------------------------------------------------------------------- */

/* A shape whose motion has parts, under a lid that is 0.5 away and no more. */
static const struct {
    const char *shape, *map, *lid, *lower; /* the lid that holds, and one that does not */
} lids[] = {
    /* Each end of a plank that turns is highest at one end of the time. */
    {"u in [0, 1]; v in [0, 1]; u; v; 2*u - 1", "t in [0, 1]; x; y; z*(2*t - 1)", "1.501", "1.499"},
    {"u in [0, 1]; v in [0, 1]; u; v; u^2", "t in [0, 1]; x; y; z*t + (1 - z)*(1 - t)", "1.501",
     "1.499"},
    /* The highest point is where two parts meet, within a cell. */
    {"u in [0, 1]; v in [0, 1]; u; v; 0",
     "t in [0, 0.3]; x; y; z + 3*t | t in [0.3, 1]; x; y; z + 1.2 - t", "1.401", "1.399"},
    /* Parts that jump: by little, which their hull stands for, and by much. */
    {"u in [0, 1]; v in [0, 1]; u; v; u", "t in [0, 0.3]; x; y; z | t in [0.3, 1]; x; y; z + 0.001",
     "1.502", "1.5005"},
    {"u in [0, 1]; v in [0, 1]; u; v; u", "t in [0, 0.3]; x; y; z + 1 | t in [0.3, 1]; x; y; z - t",
     "2.501", "2.499"},
    /* A part that exists at one time alone, and one with time before and behind it. */
    {"u in [0, 1]; v in [0, 1]; u; v; u", "t in [0, 1]; x; y; z | t in [0.3, 0.3]; x; y; z + 0.4",
     "1.901", "1.899"},
    {"u in [0, 1]; v in [0, 1]; u; v; u",
     "t in [0.2, 0.7]; x; y; z + t^2 | t in [0, 0.1]; x; y; z - t", "1.991", "1.989"},
    /* Parts that are there at the same times. */
    {"u in [0, 1]; v in [0, 1]; u; v; u", "t in [0, 1]; x; y; z | t in [0, 1]; x; y; z + 0.001",
     "1.502", "1.5005"},
    /* A part that is there for less than the cell, and falls, or rises, like the lid. */
    {"u in [0, 1]; v in [0, 1]; u; v; u", "t in [0.3, 1]; x; y; z - 10*t", "1.501 - 10*t",
     "1.499 - 10*t"},
    {"u in [0, 1]; v in [0, 1]; u; v; u", "t in [0, 0.3]; x; y; z + 10*t", "1.501 + 10*t",
     "1.499 + 10*t"},
};

static certificate under_lid(size_t k)
{
    static const uint8_t alone[] = {0, 1, 0, 7};
    char text[1000];
    snprintf(text, sizeof text,
             "impinge certificate 1\nprogram impinge 0\nverdict clear\napart 0.5\nfrom 0\nto 1\n"
             "body plank\nshape 1 plank\n%s\nmap 1 move\n%s\nsurface 0 0 1\nbody lid\nshape 1 lid\n"
             "u in [0, 1]; v in [0, 1]; u; v; %s + 0*t\nsurface 1 2\ntrees\n",
             lids[k].shape, lids[k].map, lids[k].lid);
    return made(text, alone, sizeof alone);
}

START_TEST(parts_of_a_motion_all_count)
{
    for (size_t k = 0; k < sizeof lids / sizeof *lids; ++k) {
        char lid[32], lower[32];
        certificate c = made_for_kernel(under_lid(k));
        ck_assert_msg(accepts(&c), "motion %zu", k);
        snprintf(lid, sizeof lid, "; %s + 0*t", lids[k].lid);
        snprintf(lower, sizeof lower, "; %s + 0*t", lids[k].lower);
        replace(&c, lid, lower);
        ck_assert_msg(!accepts(&c), "motion %zu, lower", k);
    }
}
END_TEST

SUITE_MAIN("kernel", elaborated_certificates_hold, what_is_not_elaborated_is_refused,
           false_claims_are_refused, what_is_said_otherwise_is_refused,
           no_change_makes_a_false_statement_hold, slopes_enclose_values,
           arithmetic_rounds_like_mpfi, sides_of_a_leaf_are_divided_as_its_trees_say,
           parts_of_a_side_all_count, parts_of_a_motion_all_count)
