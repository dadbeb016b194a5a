/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tools/cli/explain_internal.h"
#include "tools/cli/message.h"

/* The sentence about what would help. */

/* An obstacle that took this part of the split pairs is to be removed first. */
static const double STANDS_OUT = 0.3;

/* What helps if no surface can be improved. */
static const struct resort {
    const char *resolution, *size;
} resorts[] = {
    [EXPLAIN_CONTACT] = {"raise --gamma, or lower --gamma-clear: the room between the two is near "
                         "the rounding errors",
                         "a larger --gamma takes fewer pairs"},
    [EXPLAIN_DISTANCE] = {"raise --tolerance: the bracket is near the rounding errors",
                          "a larger --tolerance takes fewer pairs, and so does --require D"},
    [EXPLAIN_REQUIREMENT] = {"require a little more or less: the distance is within rounding "
                             "errors of what is required",
                             "a smaller --require takes fewer pairs"},
};

/* What else takes fewer pairs, whatever holds them together. */
typedef struct lighter {
    char text[128];
} lighter;

static lighter lighter_of(const explain_asked *asked)
{
    lighter by;
    if (asked->reached < 1)
        snprintf(by.text, sizeof by.text,
                 "a larger --tolerance takes fewer pairs (%.3g is reached so far), and "
                 "so does --require D",
                 1.0051 * asked->reached); /* %.3g rounds down by less than that */
    else
        snprintf(by.text, sizeof by.text, "%s", resorts[asked->goal].size);
    return by;
}

static void advise_on_remainder(const imp_explanation *row, int side, int part,
                                const explain_asked *asked, explanation *e)
{
    const char *lacks = row->without_order_2[side], *type = row->type[side];
    if (lacks != NULL)
        snprintf(e->advice, sizeof e->advice,
                 "'%s' has no inclusions, and bounds by rates alone take far more pairs: give it "
                 "include (a map: apply), as <impinge/formula.h> does by itself",
                 lacks);
    else
        snprintf(e->advice, sizeof e->advice,
                 "the bounds of '%s' and its maps hold %d %% of these pairs together: %s; `impinge "
                 "check %s` tells authors of the type how much wider than necessary they are",
                 type, part, lighter_of(asked).text, type);
}

/* Whether the maps of a surface are known to be rigid, and it does not move beside them. */
static bool is_rigid(const imp_scene *scene, const imp_explanation *row, int side)
{
    const imp_place at = {row->body[side], row->surface[side], 0};
    double lo[3], hi[3];
    imp_rigid_motion motion = {.is_known = false};
    imp_piece_domain(scene, at, lo, hi);
    const double t = lo[2] > 0 ? lo[2] : hi[2] < 0 ? hi[2] : 0;
    return imp_piece_motion(scene, at, t, t, &motion, NULL) == IMP_SUCCESS && motion.is_known;
}

static void advise_on_time(const imp_explanation *row, int side, int part,
                           const explain_asked *asked, explanation *e)
{
    const message_text body = message_shown(imp_scene_body_name(asked->scene, row->body[side]));
    if (is_rigid(asked->scene, row, side))
        snprintf(e->advice, sizeof e->advice,
                 "the motion of \"%.80s\" is bounded by parabolas in time, which are too wide in "
                 "%d %% of these pairs: %s",
                 body.text, part, lighter_of(asked).text);
    else
        snprintf(e->advice, sizeof e->advice,
                 "\"%.80s\" is not known to be rigid, and the parabolas that bound its path in "
                 "time are too wide in %d %% of these pairs: if it does not deform, move it by "
                 "maps that are rigid (impinge info); else %s",
                 body.text, part, lighter_of(asked).text);
}

/* Both types, as "'box' or 'mesh'"; one that both surfaces have once. */
typedef struct types_text {
    char text[140];
} types_text;
static types_text types_of(const imp_explanation *row)
{
    types_text types;
    const bool is_one = strcmp(row->type[0], row->type[1]) == 0;
    const char *between = is_one ? "" : "' or '", *second = is_one ? "" : row->type[1];
    snprintf(types.text, sizeof types.text, "'%.63s%s%.63s'", row->type[0], between, second);
    return types;
}

static void advise_on(const imp_explanation *row, imp_obstacle worst, const explain_asked *asked,
                      explanation *e)
{
    const int side = explain_kinds[worst].side;
    const types_text types = types_of(row);
    const int part = (int)(100 * (double)row->by[worst] / (double)row->divided);
    switch (explain_kinds[worst].cause) {
    case CAUSE_REMAINDER:
        advise_on_remainder(row, side, part, asked, e);
        break;
    case CAUSE_TIME:
        advise_on_time(row, side, part, asked, e);
        break;
    case CAUSE_BOUNDS:
        snprintf(e->advice, sizeof e->advice,
                 "'%s' has no bounds over the regions of %d %% of these pairs "
                 "(IMP_STATUS_UNBOUNDED): shrink its domain, or bound it there",
                 row->type[side], part);
        break;
    case CAUSE_DISTANCE:
        snprintf(e->advice, sizeof e->advice,
                 "the surfaces lie along each other: if %s bounds the distance of points "
                 "(callback distance), one test parts what now takes many",
                 types.text);
        break;
    case CAUSE_RESOLUTION:
        snprintf(e->advice, sizeof e->advice, "%s", resorts[asked->goal].resolution);
        break;
    case CAUSE_SIZE:
        snprintf(e->advice, sizeof e->advice,
                 "no bound of %s is to blame: the surfaces come near each other in many "
                 "places; %s",
                 types.text, lighter_of(asked).text);
        break;
    }
}

static imp_obstacle worst_of(const imp_explanation *row)
{
    imp_obstacle worst = IMP_OBSTACLE_SIZE;
    const double least = STANDS_OUT * (double)row->divided;
    for (int k = 0; k < IMP_OBSTACLE_SIZE; ++k) {
        const bool first = worst == IMP_OBSTACLE_SIZE && (double)row->by[k] >= least;
        if (first || (worst != IMP_OBSTACLE_SIZE && row->by[k] > row->by[worst]))
            worst = (imp_obstacle)k;
    }
    return worst;
}

/* Fewer pairs than these are no cost, or too few to judge by. */
enum { TESTED_FEW = 200, WAITING_FEW = 16 };

void explain_advise(const explain_asked *asked, explanation *e)
{
    const imp_explanation *row = &e->row[0];
    const bool is_resolution = asked->why == IMP_REASON_RESOLUTION;
    if (is_resolution && asked->goal != EXPLAIN_CONTACT) { /* whose pairs are not kept */
        snprintf(e->advice, sizeof e->advice, "%s", resorts[asked->goal].resolution);
        return;
    }
    if (e->count == 0 || (!is_resolution && !e->is_counted && row->divided < WAITING_FEW)) return;
    if (!is_resolution && e->is_counted && row->tested < TESTED_FEW)
        snprintf(e->advice, sizeof e->advice, "these are few pairs: there is nothing to mend");
    else
        advise_on(row, is_resolution ? IMP_OBSTACLE_RESOLUTION : worst_of(row), asked, e);
}
