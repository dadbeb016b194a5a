/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/film.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tools/view/storyboard.h"

/* --- Which frames ----------------------------------------------------------------------------- */

static int by_value(const void *a, const void *b)
{
    const double s = *(const double *)a, t = *(const double *)b;
    return s < t ? -1 : s > t;
}

/* Times between the ends, and no time twice. */
static size_t sorted(double *times, size_t count, double t0, double t1)
{
    size_t kept = 0;
    qsort(times, count, sizeof *times, by_value);
    for (size_t k = 0; k < count; ++k)
        if (t0 <= times[k] && times[k] <= t1 && (kept == 0 || times[k] > times[kept - 1]))
            times[kept++] = times[k];
    return kept;
}

static double *plan_frames(const subject *what, const view_request *request, size_t *frames)
{
    const double t0 = what->options.t_start, t1 = what->options.t_end;
    const size_t even = request->frames;
    double *times = calloc(even + what->events.count + 1, sizeof *times);
    *frames = 1;
    if (times == NULL) return NULL;
    times[0] = t0;
    if (request->at_kind == REQUEST_AT_TIME) times[0] = request->at;
    if (request->at_kind == REQUEST_AT_SPOT && what->spot.is_known) times[0] = what->spot.t;
    if (request->at_kind != REQUEST_AT_ALL || !(t0 < t1)) return times;
    for (size_t k = 0; k < even; ++k)
        times[k] = k + 1 == even ? t1 : t0 + (t1 - t0) * ((double)k / (double)(even - 1));
    for (size_t k = 0; k < what->events.count; ++k) times[even + k] = what->events.event[k].t;
    times[even + what->events.count] = what->spot.is_known ? what->spot.t : t0;
    *frames = sorted(times, even + what->events.count + 1, t0, t1);
    return times;
}

static size_t frame_of(const film *f, const stage_spot *spot)
{
    for (size_t k = 0; k < f->frames; ++k)
        if (spot->is_known && f->times[k] == spot->t) return k;
    return SIZE_MAX;
}

/* --- Poses ------------------------------------------------------------------------------------ */

/* Uses the largest of the four squares, so that no divisor is small. */
static void quaternion(const double r[3][3], double q[4])
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

/* Chooses the sign that gives the shorter rotation from the previous frame. */
static void keep_near(double q[4], const double before[4])
{
    double dot = 0;
    for (int n = 0; n < 4; ++n) dot += q[n] * before[n];
    for (int n = 0; n < 4 && dot < 0; ++n) q[n] = -q[n];
}

/* Returns the motion from the place at frame 0, given by `first`, to that given by `now`. */
static pose pose_between(const imp_rigid_motion *first, const imp_rigid_motion *now)
{
    double turn[3][3];
    pose p = {.shift = vec_of(now->shift)};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            turn[i][j] = 0;
            for (int k = 0; k < 3; ++k) turn[i][j] += now->turn[i][k] * first->turn[j][k];
            p.shift.x[i] -= turn[i][j] * first->shift[j];
        }
    quaternion(turn, p.turn);
    return p;
}

/* --- Tracks ----------------------------------------------------------------------------------- */

static double clamped_time(const stage *s, const mesh *m, double t)
{
    double lo[3], hi[3];
    imp_scene_domain(s->scene, m->body, m->surface, lo, hi);
    return fmin(fmax(t, lo[2]), hi[2]);
}

static imp_code find_poses(film *f, track *t, imp_error *error)
{
    imp_rigid_motion first, now;
    t->rigid = t->mesh->is_rigid;
    for (size_t k = 0; k < f->frames && t->rigid; ++k) {
        const double at = clamped_time(&f->stage, t->mesh, f->times[k]);
        const imp_code code = mesh_motion(f->stage.scene, t->mesh, at, &now, error);
        if (code != IMP_SUCCESS) return code;
        if (k == 0) first = now;
        t->rigid = now.is_known;
        if (t->rigid) t->poses[k] = pose_between(&first, &now);
        if (t->rigid && k > 0) keep_near(t->poses[k].turn, t->poses[k - 1].turn);
    }
    return IMP_SUCCESS;
}

static imp_code begin_track(film *f, track *t, mesh *m, imp_error *error)
{
    *t = (track){.mesh = m, .count = m->point_count, .always_there = true};
    t->poses = calloc(f->frames, sizeof *t->poses);
    t->there = calloc(f->frames, sizeof *t->there);
    if (t->poses == NULL || t->there == NULL) return mesh_no_memory(error);
    imp_code code = find_poses(f, t, error);
    if (code != IMP_SUCCESS) return code;
    const size_t kept = (t->rigid ? 1 : f->frames) * t->count;
    code = allowance_check_bytes(f->stage.allowance, 2 * kept * sizeof *t->point,
                                 "frames were kept", error);
    if (code != IMP_SUCCESS) return code;
    t->point = calloc(kept, sizeof *t->point);
    t->normal = calloc(kept, sizeof *t->normal);
    return t->point != NULL && t->normal != NULL ? IMP_SUCCESS : mesh_no_memory(error);
}

/* Stores the mesh's present points as those of the frame. */
static void keep_points(track *t, size_t frame)
{
    static const vec up = {{0, 0, 1}};
    const mesh *m = t->mesh;
    memcpy(t->point + frame * t->count, m->point, t->count * sizeof *m->point);
    for (size_t i = 0; i < t->count; ++i)
        t->normal[frame * t->count + i] =
            vec_dot(m->normal[i], m->normal[i]) > 0 ? m->normal[i] : up;
}

static imp_code take_frame(film *f, track *t, mesh *m, size_t frame, imp_error *error)
{
    const double at = clamped_time(&f->stage, m, f->times[frame]);
    double upper = 0;
    t->there[frame] = at == f->times[frame];
    t->always_there &= t->there[frame];
    if (t->rigid && frame > 0) return IMP_SUCCESS;
    imp_code code = mesh_move(f->stage.scene, m, at, f->stage.allowance, error);
    if (code == IMP_SUCCESS)
        code = mesh_error(f->stage.scene, m, at, f->stage.allowance, &upper, error);
    if (code != IMP_SUCCESS) return code;
    if (!(upper <= f->stage.error_upper)) f->stage.error_upper = upper;
    keep_points(t, frame);
    return code;
}

/* turn(x): x + 2 w (q x x) + 2 q x (q x x), with the quaternion (q, w). */
static vec turned(const double turn[4], vec x)
{
    const vec q = vec_of(turn), once = vec_scale(2, vec_cross(q, x));
    return vec_add(vec_along(x, turn[3], once), vec_cross(q, once));
}

vec pose_apply(const pose *p, vec x) { return vec_add(turned(p->turn, x), p->shift); }

vec track_point(const track *t, size_t frame, size_t k)
{
    if (!t->rigid) return t->point[frame * t->count + k];
    return pose_apply(&t->poses[frame], t->point[k]);
}

vec track_normal(const track *t, size_t frame, size_t k)
{
    return t->rigid ? turned(t->poses[frame].turn, t->normal[k]) : t->normal[frame * t->count + k];
}

static imp_code make_tracks(film *f, imp_error *error)
{
    f->tracks = calloc(f->stage.count + 1, sizeof *f->tracks);
    if (f->tracks == NULL) return mesh_no_memory(error);
    for (size_t k = 0; k < f->stage.count; ++k) {
        track *t = &f->tracks[f->count++];
        mesh *m = &f->stage.meshes[k];
        imp_code code = begin_track(f, t, m, error);
        for (size_t frame = 0; frame < f->frames && code == IMP_SUCCESS; ++frame)
            code = take_frame(f, t, m, frame, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

imp_code film_make(subject *what, const view_request *request, film *f, imp_error *error)
{
    *f = (film){.spot_frame = SIZE_MAX};
    if (request->at_kind == REQUEST_AT_SPOT) {
        const imp_code code = subject_find_nearest(what, error);
        if (code != IMP_SUCCESS) return code;
    }
    f->times = plan_frames(what, request, &f->frames);
    imp_code code = storyboard_stage(what, request, f->times, f->frames, &f->stage, error);
    if (code == IMP_SUCCESS) f->spot_frame = frame_of(f, &what->spot);
    return code == IMP_SUCCESS ? make_tracks(f, error) : code;
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
