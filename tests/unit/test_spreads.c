/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/survey_helpers.h"

/* How the values of a box move points (surface_spread.h), against points evaluated. */

/* --- What the way of a point does not tell ---------------------------------------------------- */

/* The spread of the first body, whose room is `maps`. False: nothing is known. */
static bool spread_of(const imp_scene *scene, const value_box *box, spread_map *maps,
                      surface_spread *spread)
{
    const surface *of = scene_surface(scene, 0, 0);
    surface_extent extent;
    surface_image image;
    map_reach reaches[SPREAD_MAPS_MAX];
    double shift[PARAMETERS];
    *spread = (surface_spread){.maps = maps};
    ck_assert_int_eq(surface_extent_find(of, box, &extent), IMP_STATUS_OK);
    ck_assert_int_eq(surface_shift_trace(of, &extent, 0, box, shift, &image, reaches),
                     IMP_STATUS_OK);
    return image.lo[0] > -INFINITY &&
           surface_spread_make(of, &extent, 0, box, SIZE_MAX, reaches, spread);
}

static void eval_at(const imp_scene *scene, const double *values, const double *p, double *x)
{
    imp_error error;
    imp_scene *at = imp_scene_at(scene, values, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    ck_assert_int_eq(imp_piece_eval(at, (imp_place){0, 0, 0}, 1, p, x, NULL, NULL), IMP_SUCCESS);
    imp_scene_free(at);
}

/* A point is where its way and the rest say, at any values and any time near the moment at which
 * the way of another point was asked for. */
static void check_way(uint64_t *r, const imp_scene *scene, const surface_spread *spread,
                      const value_box *box, const char *text)
{
    double lo[3], hi[3], values[PARAMETERS], part[PARAMETERS], way[PARAMETERS][4] = {{0}};
    double z[3], x[3], from[3], to[3], left[3], rest = 0;
    imp_piece_domain(scene, (imp_place){0, 0, 0}, lo, hi);
    spread_place place = {.t = random_between(r, 0, 1), .half = random_between(r, 0, 0.1)};
    const double near = random_fraction(r) < 0.5 ? 0 : 0.1;
    const double u = random_between(r, lo[0], hi[0]), v = random_between(r, lo[1], hi[1]);
    const double p[3] = {u, v, place.t},
                 q[3] = {u + near * random_fraction(r) * (hi[0] - u), v, place.t},
                 later[3] = {q[0], v, place.t + place.half * suite_end_or_inside(r)};
    for (int j = 0; j < PARAMETERS; ++j) {
        part[j] = suite_end_or_inside(r);
        values[j] = box->at[j] + part[j] * 0.5 * (box->hi[j] - box->lo[j]) * (1 - 1e-12);
    }
    eval_at(scene, box->at, p, z);
    eval_at(scene, box->at, q, x);
    eval_at(scene, box->at, later, from);
    eval_at(scene, values, later, to);
    memcpy(place.at, z, sizeof z);
    place.radius = query_distance(x, z) * (1 + 1e-12);
    if (!surface_spread_at(spread, scene_surface(scene, 0, 0), &place, 1, way, &rest)) return;
    for (int i = 0; i < 3; ++i) {
        left[i] = to[i] - from[i];
        for (int j = 0; j < PARAMETERS; ++j) left[i] -= part[j] * way[j][i];
    }
    const double off = query_distance(left, (const double[3]){0, 0, 0});
    ck_assert_msg(off <= rest + 1e-9, "off by %.17g, more than %.17g: %s", off, rest, text);
}

START_TEST(points_are_where_their_ways_say)
{
    uint64_t random = suite_seed() + 2000 + (uint64_t)_i;
    const int scenes = suite_times_at_least(60);
    int known = 0;
    for (int n = 0; n < scenes; ++n) {
        char text[4000];
        double lo[PARAMETERS], hi[PARAMETERS], at[PARAMETERS];
        spread_map maps[SPREAD_MAPS_MAX];
        surface_spread spread;
        imp_scene *scene =
            random_scene(&random, random_between(&random, 0.001, 0.6), text, sizeof text, lo, hi);
        for (int j = 0; j < PARAMETERS; ++j) at[j] = 0.5 * lo[j] + 0.5 * hi[j];
        const value_box box = {PARAMETERS, lo, hi, at, -0.1, 1.1};
        if (spread_of(scene, &box, maps, &spread)) {
            ++known;
            for (int k = 0; k < 8; ++k) check_way(&random, scene, &spread, &box, text);
        }
        imp_scene_free(scene);
    }
    ck_assert_int_gt(known, scenes / 3);
}
END_TEST

/* Scenes in which values bring the bodies nearer than the middle of the box tells to first order:
 * `nearest`, where they are so near, is at an end of p. Something follows time in nearly each, so
 * that no parameter takes its place. */
typedef struct bent_scene {
    const char *text;
    double nearest;
} bent_scene;

#define WALL(NORMAL)                                                                               \
    "{'surfaces':[{'type':'plane'," NORMAL "}],'maps':[{'type':'translate','velocity':[0,0,0.001]" \
    "}]}]}"
#define TURNED "{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'p'}"

static const bent_scene bent[] = {
    /* a ball moves across the wall's normal, on a circle: nearer by 1 - cos p */
    {"{'parameters':{'p':[-0.3,0.3]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1,"
     "'center':[1,0,0]}],'maps':[" TURNED
     "]}," WALL("'origin':[0.6,-2,-2],'edge_u':[0,4,0],'edge_v':[0,0,4]"),
     0.95533648912560598 - 0.7},
    /* a ball leaves the axis in time, so that it is moved farther later: by (1 + t) sin p */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1,"
     "'center':[1,0,0]}],'maps':[{'type':'translate','velocity':[1,0,0]}," TURNED
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4 - 2 * 0.099833416646828155},
    /* the far end of a plate is moved farther than its middle: a ball above x = 2 */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'plane','origin':[0,0,-1],"
     "'edge_u':[3,0,0],'edge_v':[0,0,2]}],'maps':[" TURNED
     "]},{'surfaces':[{'type':'sphere','radius':0.1,'center':[2,0.5,0]}],'maps':[{'type':"
     "'translate','velocity':[0,0,0.001]}]}]}",
     0.5 * 0.99500416527802576 - 2 * 0.099833416646828155 - 0.1},
    /* a ball turns in time, too, and its way with it: towards the wall at first, then along it */
    {"{'parameters':{'p':[-0.05,0.05]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1,"
     "'center':[1,0,0]}],'maps':[" TURNED ",{'type':'rotate','axis':[0,0,1],'rate':-2}"
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4 - 0.049979169270678331},
    /* a ball moves straight towards the wall: all of it is of first order */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1}],'maps':"
     "["
     "{'type':'translate','velocity':[0,1,0],'clock':'p'}"
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.3},
    /* a ball turns within itself in the middle only: elsewhere it goes round */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1}],'maps':"
     "["
     "{'type':'translate','velocity':[1,0,0],'clock':'p'},{'type':'rotate','axis':[0,0,1],'rate':2}"
     "]},{'surfaces':[{'type':'plane','origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]}]}]}",
     0.3},
    /* a sheet rises with the parameter by itself, not by a map */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'formula','y':'t','z':'v - "
     "0.5',"
     "'clock':'p'}],'maps':[{'type':'translate','velocity':[0.001,0,0]}"
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4},
    /* a sheet leaves the axis in time by itself, so that it is moved farther later */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'formula','x':'1 + t',"
     "'y':'0.1*u','z':'0.1*v'}],'maps':[" TURNED
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.5 - 2 * 0.099833416646828155 - 0.1 * 0.99500416527802576},
    /* a ball leaves the axis with a parameter that takes the place of time */
    {"{'parameters':{'p':[-0.1,0.1],'q':[0,1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0."
     "1,"
     "'center':[1,0,0]}],'maps':[{'type':'translate','velocity':[1,0,0],'clock':'q'}," TURNED
     "]},{'surfaces':[{'type':'plane','origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]}]}]}",
     0.4 - 2 * 0.099833416646828155},
    /* what one parameter moves off the axis the other one turns */
    {"{'parameters':{'q':[-1,1],'p':[-0.3,0.3]},'bodies':[{'surfaces':[{'type':'sphere','radius':"
     "0.1}],'maps':[{'type':'translate','velocity':[1,0,0],'clock':'q'}," TURNED
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4 - 0.29552020666133957},
    /* three parameters turn a ball about one axis */
    {"{'parameters':{'q':[-0.2,0.2],'r':[-0.2,0.2],'p':[-0.2,0.2]},'bodies':[{'surfaces':[{'type':"
     "'sphere','radius':0.01,'center':[1,0,0]}],'maps':[{'type':'rotate','axis':[0,0,1],'rate':1,"
     "'clock':'q'},{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'r'}," TURNED
     "]}," WALL("'origin':[0.6,-2,-2],'edge_u':[0,4,0],'edge_v':[0,0,4]"),
     0.82533561490967833 - 0.61},
};

START_TEST(what_bends_the_ways_of_points_is_counted)
{
    const double nearest = bent[_i].nearest;
    imp_scene *scene = scene_of(bent[_i].text);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.decide = true;
    asked.required = nearest * 1.001;
    answer found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_int_eq(found.near.verdict, IMP_REQUIREMENT_VIOLATED);
    asked.required = nearest * 0.99;
    found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_int_eq(found.near.verdict, IMP_REQUIREMENT_HOLDS);
    imp_scene_free(scene);
}
END_TEST

/* Whether something is known of a ball under maps that p moves. */
static bool knows_ways(const char *maps)
{
    char text[1000];
    const double lo = -0.1, hi = 0.1, at = 0;
    spread_map room[SPREAD_MAPS_MAX];
    surface_spread spread;
    snprintf(text, sizeof text,
             "{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere'}],"
             "'maps':[%s]}]}",
             maps);
    imp_scene *scene = scene_of(text);
    const bool known = spread_of(scene, &(value_box){1, &lo, &hi, &at, 0, 1}, room, &spread);
    imp_scene_free(scene);
    return known;
}

/* A trajectory is rigid, but does not say that it turns exactly. */
START_TEST(no_ways_are_known_of_maps_that_do_not_turn_exactly)
{
    static const char path[] =
        "{'type':'trajectory','times':[-2,2],'positions':[[0,0,0],[1,0,0]]%s}";
    char still[300], moving[300];
    snprintf(moving, sizeof moving, path, ",'clock':'p'");
    snprintf(still, sizeof still, "%s,", TURNED);
    snprintf(still + strlen(still), sizeof still - strlen(still), path, "");
    ck_assert(knows_ways(TURNED));
    ck_assert(!knows_ways(moving));
    ck_assert(!knows_ways(still));
    ck_assert(!knows_ways(TURNED ",{'type':'scale','factor':2}"));
    ck_assert(knows_ways("{'type':'scale','factor':2}," TURNED));
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {
        {points_are_where_their_ways_say, 2},
        {what_bends_the_ways_of_points_is_counted, (int)(sizeof bent / sizeof *bent)},
        {no_ways_are_known_of_maps_that_do_not_turn_exactly, 1},
    };
    return suite_main_loops("spreads", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
