/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SURVEY_HELPERS_H
#define TESTS_SUPPORT_SURVEY_HELPERS_H

#include <math.h>

#include "core/scene/scene.h"
#include "core/surface/surface_spread.h"
#include "tests/support/query_helpers.h"
#include "tests/support/suite.h"

/* Scenes with parameters, written with single quotes, and surveys of them. */

static imp_registry *registry;

static inline void open_registry(void) { registry = query_registry(); }

static inline void close_registry(void) { imp_registry_free(registry); }

/* Single quotes stand for double ones. */
static inline imp_scene *try_scene(const char *quoted, imp_error *error)
{
    const size_t length = strlen(quoted);
    char *text = malloc(length + 1);
    ck_assert_ptr_nonnull(text);
    for (size_t k = 0; k <= length; ++k) text[k] = quoted[k] == '\'' ? '"' : quoted[k];
    imp_scene *scene = imp_scene_from_json(registry, text, length, "s.json", error);
    free(text);
    return scene;
}

static inline imp_scene *scene_of(const char *quoted)
{
    imp_error error;
    imp_scene *scene = try_scene(quoted, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static inline imp_scene *at_values(const imp_scene *scene, const double *values)
{
    imp_error error;
    imp_scene *at = imp_scene_at(scene, values, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    return at;
}

typedef struct answer {
    imp_result contact;
    imp_clearance near;
    imp_survey_state state;
    double values[8], left[16];
    bool has_values;
} answer;

/* `asked` NULL: the earliest contact. */
static inline answer survey(imp_scene *scene, double gamma, const imp_clearance_options *asked,
                            const imp_survey_options *how)
{
    imp_error error;
    answer found = {.contact = {.struct_size = sizeof found.contact},
                    .near = {.struct_size = sizeof found.near},
                    .state = {.struct_size = sizeof found.state}};
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    options.max_pairs = 2000000;
    imp_survey *s = imp_survey_new(scene, &options, asked, how, &error);
    ck_assert_msg(s != NULL, "%s", error.text);
    ck_assert_msg(imp_survey_step(s, 0, &error) == IMP_SUCCESS, "%s", error.text);
    const imp_code code = asked == NULL ? imp_survey_get_result(s, &found.contact, &error)
                                        : imp_survey_get_clearance(s, &found.near, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    ck_assert_int_eq(imp_survey_get_state(s, &found.state, &error), IMP_SUCCESS);
    found.has_values = imp_survey_values(s, found.values);
    imp_survey_free(s);
    return found;
}

/* --- Closed forms ----------------------------------------------------------------------------- */

/* A ball on an arm of length 1 that turns by a, one on an arm of length 1 that turns by b about a
 * point 2.7 away: their centres are nearest at a = b = 0, and 0.7 apart. */
#define ARMS(RANGE_A, RANGE_B)                                                                     \
    "{'parameters':{'a':" RANGE_A ",'b':" RANGE_B "},'bodies':["                                   \
    "{'name':'one','surfaces':[{'type':'sphere','radius':0.3,'center':[1,0,0]}],"                  \
    "'maps':[{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'a'}]},"                             \
    "{'name':'two','surfaces':[{'type':'sphere','radius':0.3,'center':[-1,0,0]}],"                 \
    "'maps':[{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'b'},"                               \
    "{'type':'translate','offset':[[2.7,0,0]]}]}]}"

/* --- Going on --------------------------------------------------------------------------------- */

#define FROM_8_TO_9(SURFACE, MAP)                                                                  \
    "{'parameters':{'e':[0,1]},'bodies':[{'surfaces':[" SURFACE "],'maps':[" MAP                   \
    "{'type':'translate','velocity':[1,0,0],'clock':'e'}]},"                                       \
    "{'surfaces':[{'type':'point','position':[9,0.5,0]}]}]}"

/* Returns NULL if it is refused. */
static inline imp_survey *survey_from(imp_scene *scene, double t_start, double t_end,
                                      imp_error *error)
{
    imp_options options = imp_options_default(scene);
    options.t_start = t_start;
    options.t_end = t_end;
    return imp_survey_new(scene, &options, NULL, NULL, error);
}

/* --- Random scenes against samples ------------------------------------------------------------ */

enum { PARAMETERS = 3, GRID = 6 };

static inline void add_map(uint64_t *r, char *text, size_t size, bool last)
{
    static const char *const clocks[] = {"p0", "p1", "p2", "time"};
    const size_t used = strlen(text);
    const char *clock = clocks[(int)(3.999 * random_fraction(r))];
    const double kind = random_fraction(r);
    if (kind < 0.5)
        snprintf(text + used, size - used,
                 "{'type':'rotate','axis':[%g,%g,%g],'rate':%g,'center':[%g,%g,%g],'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, 0.1, 1),
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -1, 1),
                 random_between(r, -1, 1), clock, last ? "" : ",");
    else if (kind < 0.6) /* by a table: its rate jumps */
        snprintf(text + used, size - used,
                 "{'type':'rotate','axis':[%g,%g,1],'times':[-2,%g,2],'angles':[%g,0,%g],"
                 "'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -0.5, 1),
                 random_between(r, -3, 3), random_between(r, -3, 3), clock, last ? "" : ",");
    else if (kind < 0.7) /* along a parabola */
        snprintf(text + used, size - used,
                 "{'type':'translate','offset':[[0,0,0],[%g,0,%g],[%g,%g,0]],'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -1, 1),
                 random_between(r, -1, 1), clock, last ? "" : ",");
    else if (kind < 0.8)
        snprintf(text + used, size - used,
                 "{'type':'translate','velocity':[%g,%g,%g],'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -1, 1),
                 clock, last ? "" : ",");
    else
        snprintf(text + used, size - used, "{'type':'twist','rate':%g,'clock':'%s'}%s",
                 random_between(r, -0.5, 0.5), clock, last ? "" : ",");
}

static inline void add_body(uint64_t *r, char *text, size_t size, double x)
{
    static const char *const shapes[] = {
        "'type':'sphere','radius':0.5",
        "'type':'torus','major_radius':0.5,'minor_radius':0.2",
        "'type':'capsule','radius':0.2,'from':[0,0,-0.5],'to':[0,0,0.5]",
        "'type':'box','size':[0.5,0.4,0.8]",
    };
    snprintf(text + strlen(text), size - strlen(text), "{'surfaces':[{%s}],'maps':[",
             shapes[(int)(3.999 * random_fraction(r))]);
    const int maps = 1 + (int)(2.999 * random_fraction(r));
    for (int k = 0; k < maps; ++k) add_map(r, text, size, false);
    snprintf(text + strlen(text), size - strlen(text),
             "{'type':'translate','offset':[[%g,%g,%g]]}]}", x, random_between(r, -0.5, 0.5),
             random_between(r, -0.5, 0.5));
}

/* Two bodies at random; the ranges of their parameters are in lo and hi. */
static inline imp_scene *random_scene(uint64_t *r, double wide, char *text, size_t size, double *lo,
                                      double *hi)
{
    const double ends[PARAMETERS][2] = {
        {-wide, 0.5 * wide}, {0.7 - 0.5 * wide, 0.7 + 0.5 * wide}, {-0.4 * wide, 0.4 * wide}};
    snprintf(text, size, "{'parameters':{");
    for (int j = 0; j < PARAMETERS; ++j) {
        lo[j] = ends[j][0], hi[j] = ends[j][1];
        snprintf(text + strlen(text), size - strlen(text), "'p%d':[%.17g,%.17g]%s", j, lo[j], hi[j],
                 j < PARAMETERS - 1 ? "," : "},'bodies':[");
    }
    add_body(r, text, size, 0);
    strcat(text, ",");
    add_body(r, text, size, random_between(r, 1, 4));
    strcat(text, "]}");
    return scene_of(text);
}

#endif
