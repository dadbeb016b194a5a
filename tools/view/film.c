/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/film.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tools/view/storyboard.h"

/* --- Which frames -------------------------------------------------------------------------- */

static size_t plan_frames(const subject *what, const view_request *request, double *times,
                          size_t *contact_frame)
{
    const double t0 = what->options.t_start, t1 = what->options.t_end;
    const bool contact = what->contact.verdict == IMP_CONTACT;
    *contact_frame = SIZE_MAX;
    if (request->has_at || !(t0 < t1)) {
        times[0] = request->has_at ? request->at : t0;
        if (contact && times[0] == what->contact.t) *contact_frame = 0;
        return 1;
    }
    size_t n = 0;
    for (size_t k = 0; k < request->frames; ++k) {
        const double last = (double)(request->frames - 1);
        const double t = k + 1 == request->frames ? t1 : t0 + (t1 - t0) * ((double)k / last);
        if (contact && *contact_frame == SIZE_MAX && t >= what->contact.t) {
            *contact_frame = n;
            if (t > what->contact.t) times[n++] = what->contact.t;
        }
        times[n++] = t;
    }
    return n;
}

/* --- Rigid or not ---------------------------------------------------------------------------- */

/* Three points that are far from one line, to tell a pose by. */
typedef struct triple {
    size_t at[3];
    bool found;
} triple;

static triple choose_triple(const track *t)
{
    triple three = {{0, 0, 0}, false};
    double farthest = 0;
    for (size_t k = 0; k < t->count; ++k) {
        const double d = vec_length(vec_sub(t->point[k], t->point[0]));
        if (d > farthest) farthest = d, three.at[1] = k;
    }
    const double length = farthest;
    const vec along = vec_unit(vec_sub(t->point[three.at[1]], t->point[0]));
    farthest = 0;
    for (size_t k = 0; k < t->count; ++k) {
        const double d = vec_length(vec_cross(along, vec_sub(t->point[k], t->point[0])));
        if (d > farthest) farthest = d, three.at[2] = k;
    }
    three.found = farthest > 1e-3 * length && length > 0;
    return three;
}

typedef struct basis {
    vec axis[3];
} basis;

static basis basis_at(const vec *points, const triple *three)
{
    const vec o = points[three->at[0]];
    const vec x = vec_unit(vec_sub(points[three->at[1]], o));
    const vec z = vec_unit(vec_cross(x, vec_sub(points[three->at[2]], o)));
    return (basis){{x, vec_cross(z, x), z}};
}

/* The rotation that takes one basis to the other, as a matrix. */
static void rotation(const basis *from, const basis *to, double r[3][3])
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            r[i][j] = 0;
            for (int k = 0; k < 3; ++k) r[i][j] += to->axis[k].x[i] * from->axis[k].x[j];
        }
}

static vec turned(double r[3][3], vec p)
{
    vec q;
    for (int i = 0; i < 3; ++i) q.x[i] = r[i][0] * p.x[0] + r[i][1] * p.x[1] + r[i][2] * p.x[2];
    return q;
}

/* By the largest of the four squares, so that nothing is divided by what is small. */
static void quaternion(double r[3][3], double q[4])
{
    const double trace = r[0][0] + r[1][1] + r[2][2];
    int i = r[1][1] > r[0][0] ? 1 : 0;
    if (r[2][2] > r[i][i]) i = 2;
    if (trace > r[i][i]) {
        q[0] = r[2][1] - r[1][2], q[1] = r[0][2] - r[2][0], q[2] = r[1][0] - r[0][1],
        q[3] = 1 + trace;
    } else {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = 1 + r[i][i] - r[j][j] - r[k][k];
        q[j] = r[i][j] + r[j][i], q[k] = r[i][k] + r[k][i], q[3] = r[k][j] - r[j][k];
    }
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int n = 0; n < 4; ++n) q[n] /= length;
}

/* The shorter way from the frame before. */
static void keep_near(double q[4], const double before[4])
{
    double dot = 0;
    for (int n = 0; n < 4; ++n) dot += q[n] * before[n];
    for (int n = 0; n < 4 && dot < 0; ++n) q[n] = -q[n];
}

static bool fit_pose(track *t, size_t frame, const triple *three, const basis *first, double slack)
{
    const vec *now = t->point + frame * t->count;
    const basis here = basis_at(now, three);
    double r[3][3];
    rotation(first, &here, r);
    t->poses[frame].shift = vec_sub(now[three->at[0]], turned(r, t->point[three->at[0]]));
    quaternion(r, t->poses[frame].turn);
    if (frame > 0) keep_near(t->poses[frame].turn, t->poses[frame - 1].turn);
    for (size_t k = 0; k < t->count; ++k) {
        const vec at = vec_add(turned(r, t->point[k]), t->poses[frame].shift);
        if (!(vec_length(vec_sub(at, now[k])) <= slack)) return false;
    }
    return true;
}

/* A hundred-thousandth of a pixel or so is no difference. */
static void judge_rigid(track *t, size_t frames, double size)
{
    const triple three = choose_triple(t);
    if (!three.found) return;
    const basis first = basis_at(t->point, &three);
    t->rigid = true;
    for (size_t k = 0; k < frames && t->rigid; ++k)
        t->rigid = fit_pose(t, k, &three, &first, 1e-8 * size);
}

/* --- All of it ---------------------------------------------------------------------------------- */

static bool begin_tracks(film *f)
{
    f->tracks = calloc(f->stage.count + 1, sizeof *f->tracks);
    for (size_t k = 0; k < f->stage.count && f->tracks != NULL; ++k) {
        track *t = &f->tracks[f->count++];
        t->mesh = &f->stage.meshes[k];
        t->count = t->mesh->nu * t->mesh->nv;
        t->point = calloc(f->frames * t->count, sizeof *t->point);
        t->normal = calloc(f->frames * t->count, sizeof *t->normal);
        t->poses = calloc(f->frames, sizeof *t->poses);
        t->there = calloc(f->frames, sizeof *t->there);
        t->always_there = true;
        if (t->point == NULL || t->normal == NULL || t->poses == NULL || t->there == NULL)
            return false;
    }
    return f->tracks != NULL;
}

static imp_code take_frame(film *f, size_t frame, imp_error *error)
{
    static const vec up = {{0, 0, 1}};
    for (size_t k = 0; k < f->count; ++k) {
        track *t = &f->tracks[k];
        mesh *m = &f->stage.meshes[k];
        double lo[3], hi[3], upper = 0;
        imp_piece_domain(f->stage.scene, (imp_place){m->body, m->surface, m->piece}, lo, hi);
        const double at = fmin(fmax(f->times[frame], lo[2]), hi[2]);
        t->there[frame] = at == f->times[frame];
        t->always_there &= t->there[frame];
        imp_code code = mesh_move(f->stage.scene, m, at, error);
        if (code == IMP_SUCCESS) code = mesh_error(f->stage.scene, m, at, &upper, error);
        if (code != IMP_SUCCESS) return code;
        if (!(upper <= f->stage.error_upper)) f->stage.error_upper = upper;
        memcpy(t->point + frame * t->count, m->point, t->count * sizeof *m->point);
        for (size_t i = 0; i < t->count; ++i)
            t->normal[frame * t->count + i] =
                vec_dot(m->normal[i], m->normal[i]) > 0 ? m->normal[i] : up;
    }
    return IMP_SUCCESS;
}

imp_code film_make(const subject *what, const view_request *request, film *f, imp_error *error)
{
    *f = (film){.times = calloc(request->frames + 1, sizeof *f->times)};
    if (f->times != NULL) f->frames = plan_frames(what, request, f->times, &f->contact_frame);
    imp_code code = storyboard_stage(what, request, f->times, f->frames, &f->stage, error);
    if (code == IMP_SUCCESS && !begin_tracks(f)) code = mesh_no_memory(error);
    for (size_t k = 0; k < f->frames && code == IMP_SUCCESS; ++k) code = take_frame(f, k, error);
    for (size_t k = 0; k < f->count && code == IMP_SUCCESS; ++k)
        judge_rigid(&f->tracks[k], f->frames, stage_size(&f->stage));
    return code;
}

void film_free(film *f)
{
    for (size_t k = 0; k < f->count; ++k) {
        free(f->tracks[k].point);
        free(f->tracks[k].normal);
        free(f->tracks[k].poses);
        free(f->tracks[k].there);
    }
    free(f->tracks);
    stage_free(&f->stage);
    *f = (film){.tracks = NULL};
}
