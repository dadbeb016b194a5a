/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/scene_variants.h"

/* --- Scenes, told in other units -------------------------------------------------------------- */

static void write_vector(FILE *out, const double x[3], double by)
{
    fprintf(out, "[%.17g,%.17g,%.17g]", by * x[0], by * x[1], by * x[2]);
}

/* A map that moves by c + v t in the scene's own time. */
static void write_motion(FILE *out, const frame *f, const double c[3], const double v[3])
{
    double start[3];
    for (int i = 0; i < 3; ++i) start[i] = c[i] + v[i] * f->clock;
    fputs(" ! translate offset=[", out);
    write_vector(out, start, f->size);
    fputs(",", out);
    write_vector(out, v, f->size * f->rate);
    fputs("]", out);
}

static void write_turning(FILE *out, const frame *f, const char *axis, double rate)
{
    fprintf(out, " ! rotate axis=%s angle=[%.17g,%.17g]", axis, rate * f->clock, rate * f->rate);
}

static void write_spheres(const frame *f, FILE *a, FILE *b)
{
    fprintf(a, "sphere radius=%.17g", 0.9 * f->size);
    fprintf(b, "sphere radius=%.17g", 0.6 * f->size);
    write_motion(b, f, (double[3]){2.1, -1.3, 1.7}, (double[3]){-3, 2.2, -1.9});
}

/* Two spheres that pass at a distance of `pass` from centre to centre. */
static void write_pass(const frame *f, FILE *a, FILE *b, double pass)
{
    fprintf(a, "sphere radius=%.17g", 0.9 * f->size);
    fprintf(b, "sphere radius=%.17g", 0.6 * f->size);
    const double across[3] = {0.48 * pass + 0.8 * 3, 0.6 * pass, 0.64 * pass - 0.6 * 3};
    write_motion(b, f, across, (double[3]){-0.8 * 6, 0, 0.6 * 6});
}

static void write_graze(const frame *f, FILE *a, FILE *b) { write_pass(f, a, b, 1.4999); }

static void write_miss(const frame *f, FILE *a, FILE *b) { write_pass(f, a, b, 1.51); }

static void write_tori(const frame *f, FILE *a, FILE *b)
{
    for (int k = 0; k < 2; ++k)
        fprintf(k == 0 ? a : b, "torus major_radius=%.17g minor_radius=%.17g", 1.1 * f->size,
                f->size * (k == 0 ? 0.27 : 0.3));
    write_turning(a, f, "1,2,3", 2);
    write_turning(b, f, "1,0.3,-0.5", -3);
    write_motion(b, f, (double[3]){3, 1.1, 0.7}, (double[3]){-3, -1.1, -0.4});
}

static void write_spikes(const frame *f, FILE *a, FILE *b)
{
    const char *const tops[2] = {"[[0.7,0.4],[2.5,-0.6]]", "[[3.84159265358979,-0.4],[5.5,0.7]]"};
    for (int k = 0; k < 2; ++k)
        fprintf(k == 0 ? a : b, "spike radius=%.17g height=%.17g width=0.05 spikes=%s",
                1.1 * f->size, 0.9 * f->size, tops[k]);
    write_motion(b, f, (double[3]){3.522, 2.967, 1.95}, (double[3]){-1.41, -1.19, -0.78});
}

/* Points around -n and n, drifting towards each other. */
void draw_patch(int side, control patch[POINTS])
{
    const double n[3] = {0.48, -0.6, 0.64}, to = side == 0 ? 1 : -1;
    uint64_t state = 77 + (uint64_t)side;
    for (int k = 0; k < POINTS; ++k)
        for (int i = 0; i < 3; ++i) {
            patch[k].point[i] = random_between(&state, -1, 1) - 1.6 * to * n[i];
            patch[k].velocity[i] = random_between(&state, -1, 1) + 1.6 * to * n[i];
        }
}

/* The control points and velocities in the frame, each list behind its own words. */
static void write_controls(FILE *out, const frame *f, const control patch[POINTS],
                           const char *points, const char *velocities)
{
    fputs(points, out);
    for (int k = 0; k < POINTS; ++k) {
        double start[3];
        for (int i = 0; i < 3; ++i) start[i] = patch[k].point[i] + patch[k].velocity[i] * f->clock;
        if (k > 0) fputs(",", out);
        write_vector(out, start, f->size);
    }
    fputs(velocities, out);
    for (int k = 0; k < POINTS; ++k) {
        if (k > 0) fputs(",", out);
        write_vector(out, patch[k].velocity, f->size * f->rate);
    }
}

static void write_patch(FILE *out, const frame *f, const control patch[POINTS])
{
    write_controls(out, f, patch, "bezier degree=3,3 points=[", "] velocities=[");
    fputs("]", out);
}

void write_patch_json(FILE *out, const control patch[POINTS])
{
    fputs("{\"type\":\"bezier\",\"degree\":[3,3],", out);
    write_controls(out, &plain, patch, "\"points\":[", "],\"velocities\":[");
    fputs("]}", out);
}

char *patch_pipeline(const control patch[POINTS])
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    write_patch(out, &plain, patch);
    ck_assert(fclose(out) == 0);
    return text;
}

static void write_patches(const frame *f, FILE *a, FILE *b)
{
    for (int side = 0; side < 2; ++side) {
        control patch[POINTS];
        draw_patch(side, patch);
        write_patch(side == 0 ? a : b, f, patch);
    }
}

/* No length is a power of two, which some size 2^k would make 1: a factor of 1 is known to be exact
 * and its rounding not counted, which is an ulp's difference to other sizes. */
static const setting settings[] = {
    {"spheres", write_spheres, 1e-4, true}, {"graze", write_graze, 1e-4, true},
    {"miss", write_miss, 1e-3, false},      {"tori", write_tori, 1e-4, true},
    {"spikes", write_spikes, 1e-4, true},   {"patches", write_patches, 1e-4, true},
};
enum { SETTINGS = sizeof settings / sizeof *settings };

const setting *setting_of(const char *name)
{
    for (int k = 0; k < SETTINGS; ++k)
        if (strcmp(settings[k].name, name) == 0) return &settings[k];
    ck_abort_msg("no setting %s", name);
    return NULL;
}

telling tell(const setting *s, const frame *f)
{
    telling told = {NULL, NULL};
    size_t size;
    FILE *a = open_memstream(&told.a, &size), *b = open_memstream(&told.b, &size);
    s->write(f, a, b);
    ck_assert(fclose(a) == 0 && fclose(b) == 0);
    return told;
}

void untell(telling *told)
{
    free(told->a);
    free(told->b);
}

telling carry(const telling *told, const char *maps)
{
    telling carried = {NULL, NULL};
    ck_assert(asprintf(&carried.a, "%s ! %s", told->a, maps) > 0);
    ck_assert(asprintf(&carried.b, "%s ! %s", told->b, maps) > 0);
    return carried;
}

imp_scene *scene_told(imp_registry *registry, const setting *s)
{
    telling told = tell(s, &plain);
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, told.a, told.b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    untell(&told);
    return scene;
}

/* --- Questions, and the ladder ---------------------------------------------------------------- */

double rung_gamma(const setting *s, const frame *f, int rung)
{
    return ldexp(s->gamma * f->size, -2 * rung);
}

question question_of(const setting *s, const frame *f, const telling *told, int rung)
{
    return (question){.a = told->a,
                      .b = told->b,
                      .t_start = (0 - f->clock) / f->rate,
                      .t_end = (1 - f->clock) / f->rate,
                      .gamma = rung_gamma(s, f, rung)};
}

ladder ladder_of(imp_registry *registry, const setting *s)
{
    ladder l = {.about = s};
    telling told = tell(s, &plain);
    for (int k = 0; k < 3; ++k) {
        const question q = question_of(s, &plain, &told, k);
        l.rung[k] = ask_in(registry, &q);
        ck_assert_msg(l.rung[k].verdict == (s->meets ? IMP_VERDICT_CONTACT : IMP_VERDICT_CLEAR),
                      "%s: rung %d: verdict %d", s->name, k, (int)l.rung[k].verdict);
        if (k > 0) ck_assert_double_le(l.rung[k - 1].t_lower, l.rung[k].t_lower);
    }
    untell(&told);
    return l;
}

void check_answer(const ladder *l, const frame *f, const imp_result *r, const char *how)
{
    const double t = f->rate * r->t_lower + f->clock;
    ck_assert_msg(r->verdict == l->rung[1].verdict, "%s, %s: verdict %d (reason %d), expected %d",
                  l->about->name, how, (int)r->verdict, (int)r->reason, (int)l->rung[1].verdict);
    if (r->verdict != IMP_VERDICT_CONTACT) return;
    ck_assert_msg(t >= l->rung[0].t_lower && t <= l->rung[2].t,
                  "%s, %s: contact at %.17g, expected in [%.17g, %.17g]", l->about->name, how, t,
                  l->rung[0].t_lower, l->rung[2].t);
}

imp_result check_told(imp_registry *registry, const ladder *l, const frame *f, const telling *told,
                      const char *how)
{
    const question q = question_of(l->about, f, told, 1);
    const imp_result r = ask_in(registry, &q);
    check_answer(l, f, &r, how);
    return r;
}

void for_each_setting(void (*judge)(imp_registry *registry, const ladder *l))
{
    imp_registry *registry = query_registry();
    for (int k = 0; k < SETTINGS; ++k) {
        const ladder l = ladder_of(registry, &settings[k]);
        judge(registry, &l);
    }
    imp_registry_free(registry);
}
