/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SURVEY_SCENES_H
#define TESTS_SUPPORT_SURVEY_SCENES_H

#include <stdarg.h>

#include "tests/support/survey_helpers.h"

/* Random scenes of two or three bodies under 1 to 8 parameters: shapes of many types, a few of
 * which follow a clock themselves; rotations, translations, deformations and tolerances under
 * different clocks; frames, parents, solids. Written with single quotes. */

enum { NAMED_MAX = 4, SCENE_TEXT = 8000 };

typedef struct scene_writer {
    uint64_t *random;
    char text[SCENE_TEXT];
    size_t used;
    double wide;        /* how wide ranges are, about */
    bool is_rigid;      /* no deformations, nothing follows time */
    int named;          /* parameters with names */
    bool has_tolerance; /* one a scene: it adds 3 or 6 parameters */
} scene_writer;

__attribute__((format(printf, 2, 3))) static inline void write_text(scene_writer *w,
                                                                    const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(w->text + w->used, sizeof w->text - w->used, format, list);
    va_end(list);
    ck_assert(length >= 0 && w->used + (size_t)length < sizeof w->text);
    w->used += (size_t)length;
}

static inline int one_of(uint64_t *r, int count) { return (int)(random_fraction(r) * count); }

static inline double within(uint64_t *r, double most) { return random_between(r, -most, most); }

/* A parameter more often than time. */
static inline void write_clock(scene_writer *w)
{
    const int k = one_of(w->random, w->named + (w->is_rigid ? 0 : 1));
    if (k < w->named)
        write_text(w, ",'clock':'p%d'}", k);
    else
        write_text(w, "}");
}

static inline void write_patch(scene_writer *w)
{
    uint64_t *r = w->random;
    write_text(w, "{'type':'bezier','degree':[2,2],'points':[");
    for (int k = 0; k < 9; ++k)
        write_text(w, "%s[%g,%g,%g]", k > 0 ? "," : "", 0.4 * (k / 3 - 1), 0.4 * (k % 3 - 1),
                   within(r, 0.4));
    write_text(w, "],'velocities':[");
    for (int k = 0; k < 9; ++k)
        write_text(w, "%s[%g,%g,%g]", k > 0 ? "," : "", within(r, 0.2), within(r, 0.2),
                   within(r, 0.2));
    write_text(w, "]");
    write_clock(w);
}

/* Returns whether the shape is closed. */
static inline bool write_shape(scene_writer *w)
{
    static const char *const closed[] = {
        "{'type':'sphere','radius':0.5}",
        "{'type':'torus','major_radius':0.5,'minor_radius':0.2}",
        "{'type':'capsule','radius':0.2,'from':[0,0,-0.5],'to':[0,0.1,0.5]}",
        "{'type':'box','size':[0.5,0.4,0.8]}",
        "{'type':'cylinder','radius':0.3,'height':0.7,'ends':true}",
        "{'type':'cone','radius':0.4,'height':0.8,'ends':true}",
        "{'type':'ellipsoid','radii':[0.3,0.5,0.6]}",
        "{'type':'superellipsoid','radii':[0.4,0.4,0.5],'exponents':[0.5,0.8]}",
    };
    enum { CLOSED = sizeof closed / sizeof *closed };
    const int kind = one_of(w->random, w->is_rigid ? CLOSED : CLOSED + 3);
    if (kind < CLOSED) return write_text(w, "%s", closed[kind]), true;
    if (kind == CLOSED) return write_patch(w), false;
    if (kind == CLOSED + 1)
        write_text(w, "{'type':'ripple','size':[0.8,0.6],'amplitude':0.1,'speed':%g",
                   within(w->random, 1));
    else
        write_text(w,
                   "{'type':'formula','x':'0.4*cos(2*pi*u)*(1+%g*t)','y':'0.4*sin(2*pi*u)',"
                   "'z':'v-0.5+%g*t^2'",
                   within(w->random, 0.3), within(w->random, 0.5));
    write_clock(w);
    return false;
}

static inline void write_tolerance(scene_writer *w)
{
    uint64_t *r = w->random;
    const int kind = one_of(r, w->named > 2 ? 2 : 3);
    w->has_tolerance = true;
    write_text(w, "{'type':'tolerance','offset':%g,'angle':%g,'center':[%g,%g,%g]}",
               kind == 0 ? 0 : w->wide * random_between(r, 0.02, 0.3),
               kind == 1 ? 0 : w->wide * random_between(r, 0.02, 0.3), within(r, 0.5),
               within(r, 0.5), within(r, 0.5));
}

static inline void write_map(scene_writer *w)
{
    uint64_t *r = w->random;
    const int kind = one_of(r, 10);
    if (kind == 0 && !w->has_tolerance) {
        write_tolerance(w);
        return;
    }
    if (kind == 1) /* by a table: its rate jumps */
        write_text(w, "{'type':'rotate','axis':[%g,%g,1],'times':[-2,%g,2],'angles':[%g,0,%g]",
                   within(r, 1), within(r, 1), random_between(r, -0.5, 1), within(r, 3),
                   within(r, 3));
    else if (kind == 2)
        write_text(w, "{'type':'translate','offset':[[0,0,0],[%g,0,%g],[%g,%g,0]]", within(r, 1),
                   within(r, 1), within(r, 1), within(r, 1));
    else if (kind == 3)
        write_text(w, "{'type':'translate','velocity':[%g,%g,%g]", within(r, 1), within(r, 1),
                   within(r, 1));
    else if (kind == 4 && !w->is_rigid)
        write_text(w, "{'type':'twist','rate':[%g,%g]", within(r, 0.5), within(r, 0.5));
    else if (kind == 5 && !w->is_rigid)
        write_text(w, "{'type':'scale','factors':[[1,1,1],[%g,%g,%g]]", within(r, 0.3),
                   within(r, 0.3), within(r, 0.3));
    else
        write_text(w, "{'type':'rotate','axis':[%g,%g,%g],'rate':%g,'center':[%g,%g,%g]",
                   within(r, 1), within(r, 1), random_between(r, 0.1, 1), within(r, 1),
                   within(r, 1), within(r, 1), within(r, 1));
    write_clock(w);
}

/* `parent` NULL: none. */
static inline void write_body(scene_writer *w, const char *name, const char *parent, double x,
                              bool is_frame)
{
    uint64_t *r = w->random;
    write_text(w, "{'name':'%s',", name);
    if (parent != NULL) write_text(w, "'parent':'%s',", parent);
    if (!is_frame) {
        write_text(w, "'surfaces':[");
        const bool is_closed = write_shape(w);
        write_text(w, "],%s", is_closed && random_fraction(r) < 0.2 ? "'solid':true," : "");
    }
    write_text(w, "'maps':[");
    for (int k = one_of(r, 3); k >= 0; --k) {
        write_map(w);
        write_text(w, ",");
    }
    write_text(w, "{'type':'translate','offset':[[%g,%g,%g]]}]}", x, within(r, 0.5),
               within(r, 0.5));
}

/* `wide`: how wide the ranges are, about; `apart`: how far from each other bodies are placed. */
static inline imp_scene *write_scene(scene_writer *w, uint64_t *r, double wide, double apart,
                                     bool is_rigid)
{
    *w = (scene_writer){
        .random = r, .wide = wide, .is_rigid = is_rigid, .named = 1 + one_of(r, NAMED_MAX)};
    write_text(w, "{'time':[0,1],'parameters':{");
    for (int j = 0; j < w->named; ++j) {
        const double lo = random_between(r, -1, 0) * wide + (j == 1 ? 0.7 : 0);
        write_text(w, "%s'p%d':[%.17g,%.17g]", j > 0 ? "," : "", j, lo,
                   lo + wide * random_between(r, 0.2, 1));
    }
    write_text(w, "},'bodies':[");
    const bool has_frame = random_fraction(r) < 0.5, has_third = random_fraction(r) < 0.3;
    const bool is_child = random_fraction(r) < 0.5;
    if (has_frame) {
        write_body(w, "base", NULL, within(r, 0.5), true);
        write_text(w, ",");
    }
    write_body(w, "a", has_frame ? "base" : NULL, 0, false);
    write_text(w, ",");
    write_body(w, "b", is_child ? "a" : NULL, apart, false);
    if (has_third) {
        write_text(w, ",");
        write_body(w, "c", has_frame ? "base" : NULL, -apart, false);
    }
    write_text(w, "]}");
    return scene_of(w->text);
}

#endif
