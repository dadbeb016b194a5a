/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/scene_variants.h"

/* --- Space ------------------------------------------------------------------------------------ */

static void swap(imp_registry *registry, const ladder *l)
{
    telling told = tell(l->about, &plain);
    const telling swapped = {told.b, told.a};
    check_told(registry, l, &plain, &swapped, "swapped");
    untell(&told);
}

START_TEST(which_body_comes_first_does_not_matter) { for_each_setting(swap); }
END_TEST

static void move_both(imp_registry *registry, const ladder *l)
{
    const char *const moves[] = {
        "translate offset=[[3,-2,5]]",
        "rotate axis=[3,1,-2] angle=[0.9] center=[0.3,-1,2]",
        "rotate axis=[1,-1,4] rate=0.7",
        "rotate axis=[-1,2,0.5] angle=[-2.3] ! translate velocity=[9,-4,3]",
    };
    telling told = tell(l->about, &plain);
    for (size_t k = 0; k < sizeof moves / sizeof *moves; ++k) {
        telling moved = carry(&told, moves[k]);
        check_told(registry, l, &plain, &moved, moves[k]);
        untell(&moved);
    }
    untell(&told);
}

START_TEST(moving_both_bodies_alike_does_not_matter) { for_each_setting(move_both); }
END_TEST

/* Only the rounding of evaluation is larger there: 1e8 2^-53 is 1e-8, a hundredth of the room
 * between gamma and gamma_clear on rung 1. */
static void move_far(imp_registry *registry, const ladder *l)
{
    telling told = tell(l->about, &plain);
    telling moved = carry(&told, "translate offset=[[1e8,-1e8,1e8]]");
    check_told(registry, l, &plain, &moved, "shifted by 1e8");
    untell(&moved);
    untell(&told);
}

START_TEST(a_hundred_million_lengths_away_the_same_happens) { for_each_setting(move_far); }
END_TEST

/* Multiplying all lengths by a power of two is exact, and nothing but lengths is compared with
 * lengths: so all times are the same bits. */
static void scale_space(imp_registry *registry, const ladder *l)
{
    for (int k = -20; k <= 20; ++k) {
        const frame f = {ldexp(1, k), 1, 0};
        telling told = tell(l->about, &f);
        char how[40];
        snprintf(how, sizeof how, "lengths times 2^%d", k);
        const imp_result r = check_told(registry, l, &f, &told, how);
        ck_assert_msg(r.t_lower == l->rung[1].t_lower && r.stats.pairs == l->rung[1].stats.pairs,
                      "%s, %s: t_lower %.17g after %llu pairs, not %.17g after %llu",
                      l->about->name, how, r.t_lower, (unsigned long long)r.stats.pairs,
                      l->rung[1].t_lower, (unsigned long long)l->rung[1].stats.pairs);
        untell(&told);
    }
}

START_TEST(scaling_space_and_gamma_by_powers_of_two_changes_no_bit)
{
    for_each_setting(scale_space);
}
END_TEST

static void scale_space_oddly(imp_registry *registry, const ladder *l)
{
    const double sizes[] = {1e-9, 1.0 / 3, 7.7, 1e9};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        const frame f = {sizes[k], 1, 0};
        telling told = tell(l->about, &f);
        check_told(registry, l, &f, &told, "lengths scaled");
        untell(&told);
    }
}

START_TEST(scaling_space_and_gamma_by_anything_does_not_matter)
{
    for_each_setting(scale_space_oddly);
}
END_TEST

/* --- Time ------------------------------------------------------------------------------------- */

static void tell_time_otherwise(imp_registry *registry, const ladder *l)
{
    const frame frames[] = {{1, 1024, 0}, {1, 0x1p-10, 0}, {1, 3, 0},     {1, 1e-6, 0},
                            {1, 1, -1},   {1, 1, 40.5},    {1, 1e3, -70}, {0.3, 0.07, 5}};
    for (size_t k = 0; k < sizeof frames / sizeof *frames; ++k) {
        telling told = tell(l->about, &frames[k]);
        char how[60];
        snprintf(how, sizeof how, "time %g t + %g", frames[k].rate, frames[k].clock);
        check_told(registry, l, &frames[k], &told, how);
        untell(&told);
    }
}

START_TEST(another_clock_tells_the_same_moment) { for_each_setting(tell_time_otherwise); }
END_TEST

/* Asks rung 1 over [start, end]. */
static imp_result ask_between(imp_registry *registry, const ladder *l, double start, double end)
{
    telling told = tell(l->about, &plain);
    question q = question_of(l->about, &plain, &told, 1);
    q.t_start = start;
    q.t_end = end;
    const imp_result r = ask_in(registry, &q);
    untell(&told);
    return r;
}

/* Before t_lower of rung 0 gaps are at least its gamma_clear, above rung 1's gamma; at the contact
 * of rung 2 they are below rung 1's gamma_clear. */
static void shrink_interval(imp_registry *registry, const ladder *l)
{
    if (!l->about->meets) {
        const double cuts[] = {0.3, 0.5, 0.501};
        for (int k = 0; k < 3; ++k) {
            ck_assert_int_eq(ask_between(registry, l, 0, cuts[k]).verdict, IMP_VERDICT_CLEAR);
            ck_assert_int_eq(ask_between(registry, l, cuts[k], 1).verdict, IMP_VERDICT_CLEAR);
        }
        return;
    }
    const double before = l->rung[0].t_lower, after = l->rung[2].t;
    ck_assert_int_eq(ask_between(registry, l, 0, nextafter(before, 0)).verdict, IMP_VERDICT_CLEAR);
    imp_result r = ask_between(registry, l, 0, after);
    check_answer(l, &plain, &r, "until just after");
    r = ask_between(registry, l, before, 1);
    check_answer(l, &plain, &r, "from just before");
    r = ask_between(registry, l, before, after);
    check_answer(l, &plain, &r, "around");
    r = ask_between(registry, l, after, 1);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.t == after);
    r = ask_between(registry, l, after, after);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.t == after);
}

START_TEST(a_shorter_interval_tells_the_part_of_the_story_it_holds)
{
    for_each_setting(shrink_interval);
}
END_TEST

/* --- Parameters ------------------------------------------------------------------------------- */

/* Where control point (i, j) of the variant comes from. */
typedef int permutation(int i, int j);

static int other_u(int i, int j) { return 4 * (3 - i) + j; }
static int other_v(int i, int j) { return 4 * i + 3 - j; }
static int exchanged(int i, int j) { return 4 * j + i; }
static int exchanged_and_turned(int i, int j) { return 4 * (3 - j) + i; }

static void permute(control patch[POINTS], permutation *from)
{
    control old[POINTS];
    memcpy(old, patch, sizeof old);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) patch[4 * i + j] = old[from(i, j)];
}

START_TEST(patches_with_other_parameters_meet_at_the_same_time)
{
    permutation *const all[] = {other_u, other_v, exchanged, exchanged_and_turned};
    imp_registry *registry = query_registry();
    const ladder l = ladder_of(registry, setting_of("patches"));
    for (int k = 0; k < 16; ++k) {
        control patch[2][POINTS];
        for (int side = 0; side < 2; ++side) draw_patch(side, patch[side]);
        permute(patch[0], all[k / 4]);
        permute(patch[1], all[k % 4]);
        telling told = {patch_pipeline(patch[0]), patch_pipeline(patch[1])};
        check_told(registry, &l, &plain, &told, "reparametrised");
        untell(&told);
    }
    imp_registry_free(registry);
}
END_TEST

/* The halves of a cubic along one parameter (de Casteljau), for all coordinates; p[stride * k]. */
static void halve_cubic(const double *p, size_t stride, double *low, double *high)
{
    double row[4];
    for (int k = 0; k < 4; ++k) row[k] = p[stride * (size_t)k];
    for (int k = 0; k < 4; ++k) {
        low[stride * (size_t)k] = row[0];
        high[stride * (size_t)(3 - k)] = row[3 - k];
        for (int n = 0; n < 3 - k; ++n) row[n] = 0.5 * (row[n] + row[n + 1]);
    }
}

/* The halves below and above u = 1/2: points i = 0..3 of each j, 4 controls of 6 numbers apart. */
static void halve_patch(const control patch[POINTS], control low[POINTS], control high[POINTS])
{
    const size_t numbers = sizeof(control) / sizeof(double);
    for (size_t k = 0; k < 4 * numbers; ++k)
        halve_cubic((const double *)patch + k, 4 * numbers, (double *)low + k, (double *)high + k);
}

/* {"surfaces": [two halves]}, as in a scene file. */
static void write_halved_body(FILE *out, int side)
{
    control patch[POINTS], half[2][POINTS];
    draw_patch(side, patch);
    halve_patch(patch, half[0], half[1]);
    fputs("{\"surfaces\":[", out);
    write_patch_json(out, half[0]);
    fputs(",", out);
    write_patch_json(out, half[1]);
    fputs("]}", out);
}

START_TEST(patches_cut_in_two_meet_like_whole_ones)
{
    imp_registry *registry = query_registry();
    const ladder l = ladder_of(registry, setting_of("patches"));
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fputs("{\"bodies\":[", out);
    write_halved_body(out, 0);
    fputs(",", out);
    write_halved_body(out, 1);
    fputs("]}", out);
    ck_assert(fclose(out) == 0);
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_json(registry, text, size, "halves", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = rung_gamma(l.about, &plain, 1);
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_SUCCESS);
    query_check(scene, &options, &r);
    check_answer(&l, &plain, &r, "cut in two");
    imp_scene_free(scene);
    free(text);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("metamorphic", which_body_comes_first_does_not_matter,
           moving_both_bodies_alike_does_not_matter,
           a_hundred_million_lengths_away_the_same_happens,
           scaling_space_and_gamma_by_powers_of_two_changes_no_bit,
           scaling_space_and_gamma_by_anything_does_not_matter, another_clock_tells_the_same_moment,
           a_shorter_interval_tells_the_part_of_the_story_it_holds,
           patches_with_other_parameters_meet_at_the_same_time,
           patches_cut_in_two_meet_like_whole_ones)
