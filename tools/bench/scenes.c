/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/scenes.h"

#include <math.h>
#include <stdio.h>

/* A vector as pipelines take it. */
typedef struct vector_text {
    char text[80];
} vector_text;

static vector_text vector(const double x[3], double scale)
{
    vector_text v;
    snprintf(v.text, sizeof v.text, "%.17g,%.17g,%.17g", scale * x[0], scale * x[1], scale * x[2]);
    return v;
}

void bench_add_gap(bench_cases *list, double gap, const double n[3])
{
    bench_add_pair(list, bench_text("sphere"),
                   bench_text("sphere center=%s", vector(n, 2 + gap).text));
}

/* Directions of longitude and latitude, (cos v cos u, cos v sin u, sin v). */
static const double at_0_7_and_0_4[3] = {0.7044663052755917, 0.5933637833613874,
                                         0.3894183423086505};
static const double at_0_and_0_3[3] = {0.955336489125606, 0, 0.29552020666133955};
static const double at_2_and_minus_0_5[3] = {-0.36520320693961544, 0.7979835653540055,
                                             -0.479425538604203};

void bench_add_head_on(bench_cases *list, double width)
{
    const double *n = at_0_7_and_0_4;
    bench_scene *scene = bench_add_pair(
        list, bench_text("spike width=%g spikes=[[0.7,0.4],[2.5,-0.6]]", width),
        bench_text("spike width=%g spikes=[[3.8415926535897932,-0.4],[5.5,0.7]] ! translate "
                   "offset=[[%s],[%s]]",
                   width, vector(n, 5).text, vector(n, -2).text));
    if (scene == NULL) return;
    scene->has_reference = scene->meets = true;
    scene->t = 0.5;
}

void bench_add_swing(bench_cases *list, double width)
{
    double centre[3];
    for (int i = 0; i < 3; ++i) centre[i] = 1.5 * (at_0_and_0_3[i] - at_2_and_minus_0_5[i]);
    bench_add_pair(list,
                   bench_text("spike radius=0.5 height=1.5 width=%g spikes=[[0,0.3],[2,-1]] ! "
                              "rotate angle=-0.5,1",
                              width),
                   bench_text("spike radius=0.5 height=1.5 width=%g spikes=[[2,-0.5],[4,1]] ! "
                              "translate offset=[[%s]]",
                              width, vector(centre, 1).text));
}

static const struct {
    const char *name, *a, *b;
} two_tori[] = {
    {"flight", "torus ! rotate axis=1,2,3 rate=2",
     "torus minor_radius=0.3 ! rotate axis=1,0.3,-0.5 rate=-3 ! translate "
     "offset=[[3,1,0.5],[-3,-1,-0.4]]"},
    {"tumble", "torus ! rotate axis=2,-1,0.5 rate=9",
     "torus ! rotate axis=0.3,1,0.2 rate=-11 ! translate offset=[[0.4,3,0.2],[0,-1.5,0]]"},
    {"chain", "torus minor_radius=0.2",
     "torus minor_radius=0.2 ! rotate axis=1,0,0 angle=1.3,0.7 ! translate "
     "offset=[[1,0,0],[0.3,0.2,0.9]]"},
};
_Static_assert(sizeof two_tori / sizeof *two_tori == BENCH_TORI, "a row for each");

const char *bench_tori_name(int k) { return two_tori[k].name; }

void bench_add_tori(bench_cases *list, int k)
{
    bench_add_pair(list, bench_text("%s", two_tori[k].a), bench_text("%s", two_tori[k].b));
}

/* First t with |c + v t| = reach; |c| > reach, and the flight passes nearer. */
static double flight_time(const double c[3], const double v[3], double reach)
{
    const double vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const double cv = c[0] * v[0] + c[1] * v[1] + c[2] * v[2];
    const double cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    return (-cv - sqrt(cv * cv - vv * (cc - reach * reach))) / vv;
}

/* Radii 1 and 0.5, in a random direction and not quite head-on. */
static void add_flight(bench_cases *list, uint64_t *state)
{
    double n[3], aside[3], v[3];
    bench_direction(state, n);
    bench_direction(state, aside);
    for (int i = 0; i < 3; ++i) v[i] = -4 * n[i] + 0.5 * aside[i];
    bench_scene *scene = bench_add_pair(list, bench_text("sphere"),
                                        bench_text("sphere radius=0.5 center=%s ! translate "
                                                   "velocity=%s",
                                                   vector(n, 3).text, vector(v, 1).text));
    if (scene == NULL) return;
    const double c[3] = {3 * n[0], 3 * n[1], 3 * n[2]};
    scene->has_reference = scene->meets = true;
    scene->t = flight_time(c, v, 1.5);
}

void bench_add_flights(bench_cases *list)
{
    uint64_t state = 2024;
    for (int k = 0; k < BENCH_DIRECTIONS; ++k) add_flight(list, &state);
}

void bench_add_arm(bench_cases *list, uint64_t *state)
{
    double rate[3], place[3];
    for (int k = 0; k < 3; ++k) rate[k] = random_between(state, -1.5, 1.5);
    bench_direction(state, place);
    char *arm = bench_text(
        "{\"bodies\": [{\"name\": \"fixture\", \"surfaces\": [{\"type\": \"sphere\", \"radius\": "
        "0.3, \"center\": [%.17g,%.17g,%.17g]}]}, {\"name\": \"1\", \"surfaces\": [{\"type\": "
        "\"ellipsoid\", \"center\": [0.5,0,0], \"radii\": [0.5,0.1,0.1]}], \"maps\": [{\"type\": "
        "\"rotate\", \"axis\": [0,0,1], \"rate\": %.17g}]}, {\"name\": \"2\", \"parent\": \"1\", "
        "\"surfaces\": [{\"type\": \"ellipsoid\", \"center\": [1.5,0,0], \"radii\": "
        "[0.5,0.1,0.1]}], \"maps\": [{\"type\": \"rotate\", \"center\": [1,0,0], \"axis\": "
        "[0,1,0], "
        "\"rate\": %.17g}]}, {\"name\": \"3\", \"parent\": \"2\", \"surfaces\": [{\"type\": "
        "\"ellipsoid\", \"center\": [2.5,0,0], \"radii\": [0.5,0.1,0.1]}], \"maps\": [{\"type\": "
        "\"rotate\", \"center\": [2,0,0], \"axis\": [0,1,0], \"rate\": %.17g}]}], \"ignore\": "
        "[[\"1\",\"2\"], [\"2\",\"3\"], [\"1\",\"3\"]]}",
        3.6 * place[0], 3.6 * place[1], 3.6 * place[2], rate[0], rate[1], rate[2]);
    bench_add_text(list, arm);
}
