/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/made_certificate.h"

/* impinge-verify on thousands of changes of certificates: whatever is accepted must be true, as
 * points of the formulas show; and its arithmetic of doubles against MPFI. */

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
    enum { NUMBERS = 4 + CLOCKS_MAX };
    jet *room = malloc((2 * (size_t)s->steps + 1) * sizeof *room);
    double best = INFINITY, at[NUMBERS] = {0}, size = 1;
    place best_place[2] = {{.of = NULL}, {.of = NULL}};
    values when = {.count = s->clock_count};
    for (int draw = 0; draw < 200; ++draw) {
        double p[NUMBERS], x[2][3];
        box3 all[2];
        place on[2];
        for (size_t k = 0; k < 2; ++k) {
            on[k] =
                (place){s,    &s->chains[k], draw_piece(s, k, seed), s->chains[k].count - 1, room,
                        NULL, &when};
            if (draw >= 60 && best < INFINITY) on[k] = best_place[k];
            piece_box(&on[k], &all[k]);
        }
        for (size_t j = 0; j < 4 + s->clock_count; ++j) {
            const double lo = j < 4 ? all[j / 2].lo[j % 2] : s->clocks[j - 4].lo;
            const double hi = j < 4 ? all[j / 2].hi[j % 2] : s->clocks[j - 4].hi;
            const double r = lo + (hi - lo) * random_between(seed, 0, 1);
            p[j] = draw < 60 ? r : at[j] + size * (r - at[j]);
            if (j >= 4) when.lo[j - 4] = when.hi[j - 4] = p[j];
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

/* A strip of a ball that turns fast in a bore: parted about its own centre alone. */
static certificate ball_made(void)
{
    certificate c = shaft_made();
    replace(&c, "0.005", "0.001");
    replace(&c, "u in [0, 2*pi]; v in [-1, 1]; 0.99*cos(u) + 0; 0.99*sin(u); v",
            "u in [0, 2*pi]; v in [-0.4, 0.4]; 0.99*cos(v)*cos(u); 0.99*cos(v)*sin(u); "
            "0.99*sin(v)");
    replace(&c, "x*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z",
            "x*cos(7*t) - y*sin(7*t); x*sin(7*t) + y*cos(7*t); z");
    return c;
}

START_TEST(no_change_makes_a_false_statement_hold)
{
    uint64_t seed = suite_seed();
    const int count = suite_times(20000);
    int accepted = 0;
    for (int k = 0; k < count; ++k) {
        certificate c = k % 40 == 39   ? shaft_made()
                        : k % 40 == 19 ? ball_made()
                        : k % 4 == 0   ? bowl_made()
                        : k % 4 == 1   ? balls_made()
                        : k % 4 == 2   ? arm_made()
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

/* --- Changes on purpose ----------------------------------------------------------------------- */

enum { TREE_MAX = 24 };

/* Trees of the bowl with leaves of each kind, behind splits of each kind. Its lid comes as near as
 * 0.2, at the end. */
START_TEST(every_kind_of_leaf_proves_what_is_true_and_refuses_what_is_false)
{
    static const struct {
        const char *what;
        size_t size;
        uint8_t tree[TREE_MAX];
    } kinds[] = {
        {"no axis", 1, {7}},
        {"an axis", 7, {5, 0, 0, 0, 0, 0x7f, 0xff}},
        {"an axis, and sides that are divided", 13, {9, 0, 0, 0, 0, 0x7f, 0xff, 0, 2, 1, 2, 2, 2}},
        {"an axis that points back", 7, {5, 0, 0, 0, 0, 0x80, 1}},
        {"an axis across", 7, {5, 0x7f, 0xff, 0, 0, 0, 0}},
        {"an axis of no length", 7, {5, 0, 0, 0, 0, 0, 0}},
        {"the axis before", 9, {0, 5, 0, 0, 0, 0, 0x7f, 0xff, 6}},
        {"halves of A's v", 3, {1, 7, 7}},
        {"halves of B's u", 3, {2, 7, 7}},
        {"halves of B's v", 3, {3, 7, 7}},
        {"halves of time", 5, {4, 0x80, 0, 7, 7}},
        {"a time at the beginning", 5, {4, 0, 0, 7, 7}},
    };
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k)
        for (size_t i = 0; i < BOWL_CLAIMS; ++i) {
            uint8_t tree[TREE_MAX] = {0, 1, 0};
            memcpy(tree + 3, kinds[k].tree, kinds[k].size);
            certificate c = made(bowl, tree, kinds[k].size + 3);
            replace(&c, bowl_claims[i].from, bowl_claims[i].to);
            statement s;
            char fault[1400];
            bool assumes;
            const bool good = verify(&c, EFFORT, &s, fault, &assumes);
            ck_assert_msg(good == bowl_claims[i].holds, "%s, %s: %s", kinds[k].what,
                          bowl_claims[i].to, good ? "accepted" : fault);
            statement_free(&s);
        }
}
END_TEST

static void check_claim(const char *what, const uint8_t *tree, size_t size, const claim_change *by)
{
    certificate c = made(arm, tree, size);
    statement s;
    char fault[1400];
    bool assumes;
    replace(&c, by->from, by->to);
    const bool good = verify(&c, 2000, &s, fault, &assumes);
    ck_assert_msg(good == by->holds, "%s, %s: %s", what, by->to, good ? "accepted" : fault);
    statement_free(&s);
}

/* Trees over values of two parameters, of which either or time is T. */
START_TEST(claims_about_all_values_of_parameters_hold_only_if_they_are_true)
{
    static const struct {
        const char *what;
        size_t size;
        uint8_t tree[TREE_MAX];
    } kinds[] = {
        {"one leaf", 2, {0, 7}},
        {"halves of q", 7, {0, 8, 1, 0x80, 0, 7, 7}},
        {"nothing and all of q", 7, {0, 8, 1, 0, 0, 7, 7}},
        {"parts of w", 7, {0, 8, 2, 0xff, 0xff, 7, 7}},
        {"parts of time, q and w", 16, {0, 4, 1, 0, 7, 8, 1, 9, 0, 7, 8, 2, 9, 0, 7, 7}},
        {"q is T", 2, {1, 7}},
        {"q is T, a part left out", 10, {1, 4, 0x80, 0, 8, 0, 0x80, 0, 7, 7}},
        {"w is T", 7, {2, 8, 1, 0x80, 0, 7, 7}},
    };
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k)
        for (size_t i = 0; i < ARM_CLAIMS; ++i) {
            uint8_t tree[3 + TREE_MAX] = {0, 1, 0};
            memcpy(tree + 3, kinds[k].tree, kinds[k].size);
            const bool is_whole = strcmp(kinds[k].what, "q is T, a part left out") != 0;
            const claim_change by = {arm_claims[i].from, arm_claims[i].to,
                                     arm_claims[i].holds && is_whole};
            check_claim(kinds[k].what, tree, 3 + kinds[k].size, &by);
        }
}
END_TEST

START_TEST(what_is_said_otherwise_is_refused)
{
    for (int k = 0; k < PLATES_CLAIMS; ++k) {
        certificate c = plates_made();
        statement s;
        char fault[1400];
        bool assumes;
        replace(&c, plates_claims[k].from, plates_claims[k].to);
        const bool good = verify(&c, EFFORT, &s, fault, &assumes);
        ck_assert_msg(good == plates_claims[k].holds, "%d, %s: %s", k, plates_claims[k].to, fault);
        statement_free(&s);
    }
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

SUITE_MAIN("certificate_changes", claims_about_all_values_of_parameters_hold_only_if_they_are_true,
           every_kind_of_leaf_proves_what_is_true_and_refuses_what_is_false,
           operations_in_doubles_contain_those_of_mpfi, no_change_makes_a_false_statement_hold,
           what_is_said_otherwise_is_refused)
