/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <stdlib.h>
#include <string.h>

/* A turn about the line x = 1, y = 2 that rises, all in order, and maps whose poses make one
 * mistake each. */

static imp_status turn_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = malloc(1);
    return *self != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static void turn(const void *self, imp_model t, imp_pose *pose)
{
    (void)self;
    imp_model sine, cosine;
    imp_sincos(imp_scale(t, 2), &sine, &cosine);
    imp_pose_at_rest(pose);
    pose->turn[0][0] = pose->turn[1][1] = cosine;
    pose->turn[1][0] = sine;
    pose->turn[0][1] = imp_neg(sine);
    pose->shift[0] = imp_num(1);
    pose->shift[1] = imp_num(2);
    pose->shift[2] = imp_scale(imp_sqr(t), 0.25);
    pose->pivot[0] = 1, pose->pivot[1] = 2;
}
IMP_RIGID_FORMULA(turn)

/* Its mirror image, which a pose describes but no motion reaches. */
static void mirror(const void *self, imp_model t, imp_pose *pose)
{
    turn(self, t, pose);
    for (int i = 0; i < 3; ++i) pose->turn[i][2] = imp_neg(pose->turn[i][2]);
}
IMP_RIGID_FORMULA(mirror)

static void swell(const void *self, imp_model t, imp_pose *pose)
{
    turn(self, t, pose);
    for (int i = 0; i < 3; ++i) pose->turn[i][2] = imp_scale(pose->turn[i][2], 1.001);
}
IMP_RIGID_FORMULA(swell)

/* The turn and a wave, which its pose leaves out: at the pivot, and 2 from it along y, there is
 * none. */
static void wave(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                 imp_model out[3])
{
    imp_pose pose;
    const imp_model at[3] = {x, y, z};
    turn(self, t, &pose);
    imp_pose_apply(&pose, at, out);
    imp_model phase = imp_mul(imp_shift(y, -2), imp_scale(imp_const_pi(), 0.5));
    out[2] = imp_add(out[2], imp_scale(imp_sin(phase), 0.01));
}
IMP_MAP_FORMULA(wave)

#define MISTAKE(NAME, CALLS, RIGID)                                                                \
    static const imp_map_type NAME##_type = {.struct_size = sizeof(imp_map_type),                  \
                                             .parameter_size = sizeof(imp_parameter),              \
                                             .name = #NAME,                                        \
                                             .summary = "a turn with a mistake in its pose",       \
                                             .equation = "a turn by 2 t about (1, 2, 0), rising",  \
                                             .example = #NAME,                                     \
                                             .create = turn_create,                                \
                                             .destroy = free,                                      \
                                             .time_domain = always,                                \
                                             .eval = CALLS##_eval,                                 \
                                             .rate = CALLS##_rate,                                 \
                                             .apply = CALLS##_apply,                               \
                                             .rigid = RIGID}

static imp_status sure(const void *self, const imp_model *t, imp_pose *pose)
{
    const imp_status status = turn_rigid(self, t, pose);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) pose->turn[i][j].e *= 0.5;
    return status;
}
MISTAKE(pose_remainder_halved, turn, sure);

static imp_status slow(const void *self, const imp_model *t, imp_pose *pose)
{
    const imp_status status = turn_rigid(self, t, pose);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) pose->turn[i][j].rate[2] *= 0.5;
    return status;
}
MISTAKE(pose_rate_halved, turn, slow);

static imp_status narrow(const void *self, const imp_model *t, imp_pose *pose)
{
    const imp_status status = turn_rigid(self, t, pose);
    imp_model *rise = &pose->shift[2];
    rise->hi = 0.5 * rise->lo + 0.5 * rise->hi;
    return status;
}
MISTAKE(pose_range_halved, turn, narrow);

static imp_status moment(const void *self, const imp_model *t, imp_pose *pose)
{
    const imp_model now = imp_num(t->a);
    return turn_rigid(self, &now, pose);
}
MISTAKE(pose_of_one_moment, turn, moment);

static imp_status backward(const void *self, const imp_model *t, imp_pose *pose)
{
    const imp_model back = imp_neg(*t);
    return turn_rigid(self, &back, pose);
}
MISTAKE(pose_turns_backward, turn, backward);

static imp_status off_pivot(const void *self, const imp_model *t, imp_pose *pose)
{
    const imp_status status = turn_rigid(self, t, pose);
    pose->pivot[0] = 0;
    return status;
}
MISTAKE(pose_without_pivot, turn, off_pivot);

static imp_status of_u(const void *self, const imp_model *t, imp_pose *pose)
{
    const imp_status status = turn_rigid(self, t, pose);
    pose->turn[0][0].depends |= 1;
    return status;
}
MISTAKE(pose_depends_on_u, turn, of_u);

static long asked;

static imp_status remember(const void *self, const imp_model *t, imp_pose *pose)
{
    asked += 1;
    return turn_rigid(self, t, pose);
}
MISTAKE(pose_remembers, turn, remember);

MISTAKE(pose_of_a_wave, wave, turn_rigid);
MISTAKE(pose_mirrors, mirror, mirror_rigid);
MISTAKE(pose_swells, swell, swell_rigid);
MISTAKE(pose_no_mistake, turn, turn_rigid);

static const imp_map_type *const maps[] = {
    &pose_remainder_halved_type, &pose_rate_halved_type,    &pose_range_halved_type,
    &pose_of_one_moment_type,    &pose_turns_backward_type, &pose_without_pivot_type,
    &pose_depends_on_u_type,     &pose_mirrors_type,        &pose_swells_type,
    &pose_of_a_wave_type,        &pose_remembers_type,      &pose_no_mistake_type};
static const imp_map_factory factory = {sizeof factory, sizeof maps / sizeof *maps, maps};

static const void *get_factory(const char *id)
{
    return strcmp(id, IMP_MAP_FACTORY) == 0 ? &factory : NULL;
}
IMPINGE_PLUGIN("mistakes_pose", "1.0", "Apache-2.0", "tests", get_factory);
