/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/held_values.h"
#include "tests/support/survey_helpers.h"

/* Surfaces that parameters turn within themselves: points at some values have companions at any
 * others, and answers are true at random values. */

enum { SCENES = 60, ASKED = 24, POINTS = 4, VALUES = 8, TEXT = 4000 };

static const char *const rounds[] = {
    "'type':'cylinder','radius':0.4,'height':0.8,'ends':true",
    "'type':'cone'",
    "'type':'torus','major_radius':0.5,'minor_radius':0.2",
    "'type':'disc','radius':0.5",
    "'type':'capsule','radius':0.3,'from':[0,0,-0.4],'to':[0,0,0.4]",
    "'type':'revolution','profile':[[0.3,-0.5],[0.6,0],[0.2,0.5]]",
    "'type':'sphere','radius':0.5" /* the last one: about a point */
};
enum { ROUNDS = sizeof rounds / sizeof *rounds };

static const char *clock_of(uint64_t *random)
{
    static const char *const clocks[] = {"p0", "p1", "time"};
    return clocks[random_bits(random) % 3];
}

/* A turn about the line through `center` along z, beside it by `off`. */
static void add_spin(uint64_t *random, const double center[3], double off, char *text)
{
    text_add(text, TEXT,
             "{'type':'rotate','axis':[0,0,%g],'rate':%.17g,'center':[%.17g,%.17g,%.17g],",
             random_bits(random) % 2 ? 1.0 : -2.0, 3 * random_part(random),
             center[0] + off * random_part(random), center[1] + off * random_part(random),
             random_part(random));
    text_add(text, TEXT, "'clock':'%s'},", clock_of(random));
}

/* Spins that do not show, but for `off`, about the line that a map has put elsewhere, perhaps; then
 * what moves by p2, or by time. */
static void add_maps(uint64_t *random, double off, const char *last, char *text)
{
    const int spins = 1 + (int)(random_bits(random) % 3);
    double center[3] = {0, 0, 0};
    for (int k = 0; k < spins; ++k) {
        if (random_bits(random) % 3 == 0) {
            double by[3];
            for (int i = 0; i < 3; ++i) center[i] += by[i] = 0.3 * random_part(random);
            text_add(text, TEXT, "{'type':'translate','offset':[[%.17g,%.17g,%.17g]]},", by[0],
                     by[1], by[2]);
        }
        add_spin(random, center, off, text);
    }
    text_add(text, TEXT,
             "{'type':'translate','offset':[[0,0,0],[%.17g,%.17g,%.17g]],'clock':'%s'}]}",
             random_part(random), random_part(random), random_part(random), last);
}

static void begin(double wide, char *text)
{
    snprintf(text, TEXT,
             "{'parameters':{'p0':[%g,%g],'p1':[%g,%g],'p2':[-0.2,0.2]},'bodies':[{'surfaces':[{",
             -wide, wide, -wide, wide);
}

/* --- Companions ------------------------------------------------------------------------------- */

typedef struct circle {
    const imp_scene *scene;
    imp_place at;
    double p[3], to[3];
    int along;
} circle;

static double gap_at(const circle *c, double w)
{
    double p[3] = {c->p[0], c->p[1], c->p[2]}, x[3];
    p[c->along] = w;
    ck_assert_int_eq(imp_piece_eval(c->scene, c->at, 1, p, x, NULL, NULL), IMP_SUCCESS);
    return query_distance(x, c->to);
}

static double least_between(const circle *c, double from, double to)
{
    for (int k = 0; k < 60; ++k) {
        const double a = from + (to - from) * 0.4, b = from + (to - from) * 0.6;
        if (gap_at(c, a) < gap_at(c, b))
            to = b;
        else
            from = a;
    }
    return gap_at(c, 0.5 * from + 0.5 * to);
}

/* The least distance of the point from points of the same v, or u: beside the nearest of samples,
 * and beside both ends. */
static double least_gap(const circle *c)
{
    enum { SAMPLES = 48 };
    double lo[3], hi[3], least = INFINITY;
    int best = 0;
    imp_piece_domain(c->scene, c->at, lo, hi);
    const double first = lo[c->along], last = hi[c->along], width = (last - first) / SAMPLES;
    for (int k = 0; k <= SAMPLES; ++k) {
        const double gap = gap_at(c, fmin(first + width * k, last));
        if (gap < least) least = gap, best = k;
    }
    least = fmin(least, least_between(c, fmax(first + width * (best - 1), first),
                                      fmin(first + width * (best + 1), last)));
    least = fmin(least, least_between(c, first, first + width));
    return fmin(least, least_between(c, last - width, last));
}

/* Looks at points at random values and a random time, from other values and another time. */
static void check_companions(uint64_t *r, const imp_scene *scene, double wide, double slip,
                             const char *text)
{
    for (int n = 0; n < POINTS; ++n) {
        double p[3], lo[3], hi[3], values[2][PARAMETERS];
        for (int j = 0; j < PARAMETERS; ++j)
            for (int k = 0; k < 2; ++k) values[k][j] = wide * suite_end_or_inside(r);
        values[0][2] = values[1][2] = 0.2 * random_part(r);
        imp_scene *at[2] = {at_values(scene, values[0]), at_values(scene, values[1])};
        circle c = {.scene = at[1],
                    .at = {0, 0, random_bits(r) % imp_scene_piece_count(at[0], 0, 0)}};
        imp_piece_domain(at[0], c.at, lo, hi);
        for (int j = 0; j < 2; ++j) p[j] = c.p[j] = random_between(r, lo[j], hi[j]);
        p[2] = random_fraction(r), c.p[2] = random_fraction(r);
        ck_assert_int_eq(imp_piece_eval(at[0], c.at, 1, p, c.to, NULL, NULL), IMP_SUCCESS);
        double least = least_gap(&c);
        c.along = 1;
        least = fmin(least, least_gap(&c));
        ck_assert_msg(least <= slip + 1e-7, "%g from its companion, the slip is %g: %s", least,
                      slip, text);
        for (int k = 0; k < 2; ++k) imp_scene_free(at[k]);
    }
}

static held_maps held_of(const imp_scene *scene, const value_box *box, double enough)
{
    surface_extent extent;
    held_maps held;
    const surface *s = scene_surface(scene, 0, 0);
    ck_assert_int_eq(surface_extent_find(s, box, &extent), IMP_STATUS_OK);
    ck_assert_int_eq(surface_held_values(s, &extent, box, enough, &held), IMP_STATUS_OK);
    return held;
}

/* The last map, which moves all by p2, is the same at both values. */
START_TEST(points_have_companions_within_the_slip_at_other_values)
{
    uint64_t random = suite_seed();
    int exact = 0, slipping = 0;
    for (int n = 0; n < suite_times_at_least(SCENES); ++n) {
        char text[TEXT];
        const double off = n % 3 == 0 ? 0 : random_power(&random, -26, -14);
        const double wide = n % 2 ? 0.02 : 3;
        begin(wide, text);
        text_add(text, TEXT, "%s}],'maps':[", rounds[random_bits(&random) % (ROUNDS - 1)]);
        add_maps(&random, off, "p2", text);
        text_add(text, TEXT, ",{'surfaces':[{'type':'sphere'}]}]}");
        imp_scene *scene = scene_of(text);
        const double lo[3] = {-wide, -wide, -0.2}, hi[3] = {wide, wide, 0.2}, at[3] = {0, 0, 0};
        const value_box box = {PARAMETERS, lo, hi, at, 0, 1};
        const held_maps held = held_of(scene, &box, 0.3);
        if (held.count + 1 == surface_map_count(scene_surface(scene, 0, 0))) {
            check_companions(&random, scene, wide, held.slip, text);
            exact += held.slip < 1e-12;
            slipping += held.slip > 1e-6;
        }
        imp_scene_free(scene);
    }
    ck_assert_msg(exact > SCENES / 16 && slipping > 0, "%d exact, %d slip", exact, slipping);
}
END_TEST

/* --- Which are held --------------------------------------------------------------------------- */

#define PLACED                                                                                     \
    "{'type':'rotate','axis':[1,0,0],'angle':[0.7]},{'type':'translate','offset':[[1,2,3]]}"
#define BY(CLOCK) "{'type':'rotate','axis':[0,0,1],'rate':2,'clock':'" CLOCK "'}"

START_TEST(only_maps_that_turn_a_surface_within_itself_are_held)
{
    static const struct {
        const char *surface, *maps;
        size_t held;
    } row[] = {
        {"'type':'cylinder'", BY("p0"), 1},
        {"'type':'cylinder'", BY("time") "," BY("p0") "," BY("p1"), 3},
        {"'type':'cylinder'", BY("p0") ",{'type':'scale','factor':[1,2,3]}," BY("p1"), 1},
        {"'type':'cylinder'", BY("p0") "," PLACED "," BY("p1"), 1},
        {"'type':'sphere'",
         PLACED ",{'type':'rotate','axis':[2,1,3],'rate':2,'center':[1,2,3],'clock':'p0'}", 3},
        {"'type':'sphere'",
         PLACED ",{'type':'rotate','axis':[2,1,3],'rate':2,'center':[1,2,3.0001],'clock':'p0'}", 0},
        {"'type':'cylinder'", BY("time"), 0},
        {"'type':'cylinder'", "{'type':'translate','velocity':[0,0,1],'clock':'p0'}", 0},
        {"'type':'cylinder'", "{'type':'rotate','axis':[0,0.001,1],'rate':2,'clock':'p0'}", 0},
        {"'type':'box'", BY("p0"), 0},
        {"'type':'sphere','center':[1,0,0]", BY("p0"), 0},
        {"'type':'cylinder'", "{'type':'scale','factor':[1,1,1]}," BY("p0"), 0},
        {"'type':'cylinder','clock':'p1'", BY("p0"), 0}};
    const double lo[3] = {-3, -3, -3}, hi[3] = {3, 3, 3}, at[3] = {0, 0, 0};
    const value_box box = {PARAMETERS, lo, hi, at, 0, 1};
    for (size_t n = 0; n < sizeof row / sizeof *row; ++n) {
        char text[TEXT];
        snprintf(text, sizeof text,
                 "{'parameters':{'p0':[-3,3],'p1':[-3,3],'p2':[-3,3]},'bodies':[{'surfaces':[{%s}],"
                 "'maps':[%s]},{'surfaces':[{'type':'sphere'}]}]}",
                 row[n].surface, row[n].maps);
        imp_scene *scene = scene_of(text);
        const held_maps held = held_of(scene, &box, 1e-9);
        ck_assert_msg(held.count == row[n].held && held.slip <= 1e-9, "%zu maps, %g: %s",
                      held.count, held.slip, text);
        imp_scene_free(scene);
    }
}
END_TEST

/* --- Answers ---------------------------------------------------------------------------------- */

static imp_scene *scene_to_ask(uint64_t *random, char *text)
{
    static const char *const others[] = {"'type':'box','size':[1,0.8,0.6]",
                                         "'type':'sphere','radius':0.4",
                                         "'type':'torus','major_radius':0.6,'minor_radius':0.2"};
    const double off = random_bits(random) % 3 == 0 ? random_power(random, -8, -1) : 0;
    begin(random_bits(random) % 2 ? 3 : 0.2, text);
    text_add(text, TEXT, "%s}],'maps':[", rounds[random_bits(random) % ROUNDS]);
    add_maps(random, off, random_bits(random) % 2 ? "p2" : "time", text);
    text_add(text, TEXT,
             ",{'surfaces':[{%s}],'maps':[{'type':'translate','offset':[[%.17g,%.17g,%.17g]]}]}]}",
             others[random_bits(random) % 3], 1.3 + 0.5 * random_part(random),
             0.3 * random_part(random), 0.3 * random_part(random));
    return scene_of(text);
}

static void draw_values(uint64_t *r, const imp_scene *scene, double *values)
{
    const scene_parameters *all = scene_parameters_read(scene);
    for (size_t j = 0; j < PARAMETERS; ++j)
        values[j] = 0.5 * (all->at[j].lo + all->at[j].hi) +
                    0.5 * (all->at[j].hi - all->at[j].lo) * suite_end_or_inside(r);
}

/* The earliest contact, at fixed values. */
static imp_result solved(const imp_scene *scene, const double *values, double gamma)
{
    imp_error error;
    imp_scene *at = at_values(scene, values);
    imp_options options = imp_options_default(at);
    imp_result found = {.struct_size = sizeof found};
    options.gamma = gamma;
    options.max_pairs = 3000;
    ck_assert_msg(imp_scene_solve(at, &options, &found, &error) == IMP_SUCCESS, "%s", error.text);
    imp_scene_free(at);
    return found;
}

static double distance_at(const imp_scene *scene, const double *values)
{
    imp_scene *at = at_values(scene, values);
    imp_options options = imp_options_default(at);
    options.max_pairs = 2000;
    const double upper = query_clearance(at, &options, NULL).upper;
    imp_scene_free(at);
    return upper;
}

#define GAMMA 0.01

START_TEST(no_values_touch_before_what_is_proved)
{
    uint64_t random = suite_seed();
    imp_survey_options how = imp_survey_options_default();
    int touches = 0, clear = 0;
    how.max_boxes = 40;
    for (int n = 0; n < suite_times_at_least(ASKED); ++n) {
        char text[TEXT];
        imp_scene *scene = scene_to_ask(&random, text);
        const answer found = survey(scene, GAMMA, NULL, &how);
        const bool is_clear = found.contact.verdict == IMP_VERDICT_CLEAR;
        touches += found.contact.verdict == IMP_VERDICT_CONTACT;
        clear += is_clear;
        for (int k = 0; k < VALUES; ++k) {
            double values[PARAMETERS];
            draw_values(&random, scene, values);
            const imp_result one = solved(scene, values, 0.5 * GAMMA);
            if (one.verdict == IMP_VERDICT_CONTACT)
                ck_assert_msg(!is_clear && one.t >= found.contact.t_lower,
                              "%g at %g, %g, %g, but proved to %g: %s", one.t, values[0], values[1],
                              values[2], found.contact.t_lower, text);
        }
        imp_scene_free(scene);
    }
    ck_assert_msg(touches > 1 && clear > 5, "%d touch, %d are clear", touches, clear);
}
END_TEST

START_TEST(no_values_are_nearer_than_what_is_proved)
{
    uint64_t random = suite_seed() + 1;
    imp_survey_options how = imp_survey_options_default();
    int apart = 0;
    how.max_boxes = 30;
    for (int n = 0; n < suite_times_at_least(ASKED); ++n) {
        char text[TEXT];
        imp_scene *scene = scene_to_ask(&random, text);
        imp_clearance_options asked = imp_clearance_options_default();
        asked.tolerance = 0.1;
        const imp_clearance found = survey(scene, 1e-3, &asked, &how).near;
        apart += found.lower > 0;
        for (int k = 0; k < VALUES / 2; ++k) {
            double values[PARAMETERS];
            draw_values(&random, scene, values);
            const double d = distance_at(scene, values);
            ck_assert_msg(d >= found.lower, "%g at %g, %g, %g, but %g is proved: %s", d, values[0],
                          values[1], values[2], found.lower, text);
        }
        imp_scene_free(scene);
    }
    ck_assert_int_gt(apart, 1);
}
END_TEST

/* A spindle in its bore, which turns by a parameter and slides; one on a table that tilts. */
START_TEST(a_spindle_that_a_parameter_turns_takes_the_pairs_of_one_at_rest)
{
    static const char *const bodies[] = {
        "{'surfaces':[{'type':'cylinder','radius':0.2,'ends':true}],'maps':[" BY(
            "p0") ",{'type':'translate','velocity':[0,0,1]}]},"
                  "{'surfaces':[{'type':'cylinder','radius':0.21}]}",
        "{'surfaces':[{'type':'sphere','radius':0.2}],'maps':[" BY("p0") "," BY(
            "p1") ",{'type':'translate','velocity':[0,0,1]}]},"
                  "{'surfaces':[{'type':'sphere','radius':1.3}]}",
        "{'surfaces':[{'type':'cylinder','radius':0.2,'height':1,'center':[0,0,-0.7],'ends':true}],"
        "'maps':[" BY("p0") ",{'type':'rotate','axis':[0,1,0],'rate':0.5,'clock':'p1'}]},"
                            "{'surfaces':[{'type':'sphere','radius':1.99,'center':[0,2.2,-0.5]}]}"};
    for (size_t n = 0; n < sizeof bodies / sizeof *bodies; ++n) {
        char text[TEXT];
        imp_survey_options how = imp_survey_options_default();
        snprintf(text, sizeof text,
                 "{'parameters':{'p0':[-3,3],'p1':[-3,3],'p2':[-3,3]},'bodies':[%s]}", bodies[n]);
        imp_scene *scene = scene_of(text);
        const answer found = survey(scene, 1e-3, NULL, &how);
        ck_assert_int_eq(found.contact.verdict, IMP_VERDICT_CLEAR);
        ck_assert_msg(found.contact.stats.pairs <= 8, "%d pairs: %s",
                      (int)found.contact.stats.pairs, text);
        imp_scene_free(scene);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {points_have_companions_within_the_slip_at_other_values,
                                  only_maps_that_turn_a_surface_within_itself_are_held,
                                  no_values_touch_before_what_is_proved,
                                  no_values_are_nearer_than_what_is_proved,
                                  a_spindle_that_a_parameter_turns_takes_the_pairs_of_one_at_rest};
    return suite_main_with("held_values", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
