/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/coil.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* Only the flanks, without end discs. The radius follows the phase, starts u - 2 pi z / pitch, z
 * from the centre: a screw motion by starts * pitch a turn takes the endless thread into itself. */

enum { RADIUS, PROFILE, PITCH, STARTS, HEIGHT, CENTER };
enum { HARMONICS_MAX = 32, STARTS_MAX = 1000 };

#define THREAD_FAR 1e100
#define THREAD_SHORT 1e-100

static const imp_parameter parameters[] = {
    [RADIUS] =
        IMP_ROW("radius", "length", "1", 0, 0, 0, 0, THREAD_SHORT, THREAD_FAR, "mean radius"),
    [PROFILE] = IMP_ROW(
        "profile", "length", "[0.1]", IMP_PARAMETER_SCALAR_OK, 1, 0, 0, -THREAD_FAR, THREAD_FAR,
        "amplitudes a_1, a_2, ... of the radius' waves from crest to crest; one alone is half "
        "the depth"),
    [PITCH] = IMP_ROW("pitch", "length", "0.5", 0, 0, 0, 0, -THREAD_FAR, THREAD_FAR,
                      "along the axis from crest to crest, any but 0; negative: left-handed"),
    [STARTS] = IMP_ROW_INTEGER("starts", "1", "1", 1, STARTS_MAX,
                               "threads side by side; a turn advances by starts * pitch"),
    [HEIGHT] = IMP_ROW("height", "length", "2", 0, 0, 0, 0, THREAD_SHORT, THREAD_FAR,
                       "extent along the z axis"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "middle of the axis"),
};

typedef struct thread_instance {
    double radius, root, crest; /* root: at most the least radius, > 0; crest: at least the most */
    double starts, height, center[3];
    near_constant along_v, along_z; /* 2 pi height / pitch, 2 pi / pitch; rad, rad/length */
    bool is_closed;                 /* the lead is exact */
    double lead, lead_off; /* starts * pitch, rounded, and room for that; 0: no screw is claimed */
    size_t count;
    double profile[];
} thread_instance;

/* At least |a_1| + |a_2| + ... */
static double depth_upper(const imp_value *profile)
{
    double sum = 0;
    for (size_t k = 0; k < profile->count; ++k) sum = imp_sum_up(sum + fabs(profile->number[k]));
    return sum;
}

static double root_lower(double radius, const imp_value *profile)
{
    return imp_sum_down(radius - depth_upper(profile));
}

static imp_status check(const imp_value *values, imp_create_error *why)
{
    const imp_value *profile = &values[PROFILE];
    const double pitch = values[PITCH].number[0], radius = values[RADIUS].number[0];
    if (!(fabs(pitch) >= THREAD_SHORT))
        return imp_reject(why, PITCH, -1, "got %g, must be any length but 0 (at least %g in size)",
                          pitch, THREAD_SHORT);
    if (profile->count > HARMONICS_MAX)
        return imp_reject(why, PROFILE, -1, "%zu amplitudes given, at most %d are allowed",
                          profile->count, HARMONICS_MAX);
    if (!(root_lower(radius, profile) > 0))
        return imp_reject(
            why, PROFILE, -1,
            "the sizes of the amplitudes add up to the radius, %g, or more; must be less", radius);
    return IMP_STATUS_OK;
}

/* Room in the distance beyond this part of the radius is worth more than the symmetry is. */
#define ROOM_MOST 0x1p-30

/* Lemma. starts * pitch is off by at most u of the lead, u = 2^-53, and screw motions by at most
 * IMP_SCREW_TURNS turns by as often as much. */
static void set_lead(thread_instance *s, double pitch)
{
    s->lead = s->starts * pitch;
    const double length = fabs(s->lead);
    const bool is_exact = fma(s->starts, pitch, -s->lead) == 0;
    s->is_closed = is_exact;
    s->lead_off = is_exact ? 0 : length * (0x1p-52 * IMP_SCREW_TURNS);
    if (length >= THREAD_SHORT && length <= THREAD_FAR && s->lead_off <= ROOM_MOST * s->radius)
        return;
    s->lead = s->lead_off = 0;
}

static imp_status thread_create(const imp_value *values, void **self, imp_create_error *why)
{
    const imp_value *profile = &values[PROFILE];
    const imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    thread_instance *s = malloc(sizeof *s + profile->count * sizeof s->profile[0]);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    s->radius = values[RADIUS].number[0];
    s->root = root_lower(s->radius, profile);
    s->crest = imp_sum_up(s->radius + depth_upper(profile));
    s->starts = values[STARTS].number[0];
    s->height = values[HEIGHT].number[0];
    imp_copy_vector(s->center, &values[CENTER]);
    const imp_model wave = imp_div(imp_scale(imp_const_pi(), 2), imp_num(values[PITCH].number[0]));
    s->along_z = near_of(wave);
    s->along_v = near_of(imp_scale(wave, s->height));
    set_lead(s, values[PITCH].number[0]);
    s->count = profile->count;
    memcpy(s->profile, profile->number, s->count * sizeof s->profile[0]);
    *self = s;
    return IMP_STATUS_OK;
}

static void thread_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -0.5, 0.5);
}

static imp_model radius_at(const void *self, imp_model phase)
{
    const thread_instance *s = self;
    imp_model sum = imp_num(0);
    for (size_t k = 0; k < s->count; ++k)
        sum = imp_add(sum, imp_scale(imp_cos(imp_scale(phase, (double)(k + 1))), s->profile[k]));
    return imp_shift(sum, s->radius);
}

static void thread_formula(const void *self, imp_model u, imp_model v, imp_model t,
                           imp_model out[3])
{
    const thread_instance *s = self;
    const imp_model phase = imp_sub(imp_scale(u, s->starts), near_scale(v, s->along_v));
    const imp_model radius = radius_at(s, phase);
    imp_model sin_u, cos_u;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    out[0] = imp_shift(imp_mul(radius, cos_u), s->center[0]);
    out[1] = imp_shift(imp_mul(radius, sin_u), s->center[1]);
    out[2] = imp_shift(imp_scale(v, s->height), s->center[2]);
}
IMP_SURFACE_FORMULA(thread_formula)

/* --- Distance -------------------------------------------------------------------------------- */

/* At most R' where the phase is within the range. */
static double slope_upper(const void *self, imp_interval phase)
{
    const thread_instance *s = self;
    imp_interval sum = imp_interval_make(0, 0);
    for (size_t k = 0; k < s->count; ++k) {
        const double order = (double)(k + 1);
        const imp_interval sine = imp_interval_sin(imp_interval_scale(phase, order));
        sum = imp_interval_add(sum,
                               imp_interval_scale(imp_interval_scale(sine, s->profile[k]), order));
    }
    return imp_interval_mag(sum);
}

/* From the endless thread. */
static imp_model thread_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const thread_instance *s = self;
    const coil c = {near_exact(s->starts),
                    s->along_z,
                    near_exact(0),
                    s->root,
                    s->crest,
                    INFINITY,
                    s,
                    radius_at,
                    slope_upper};
    const imp_model gap = coil_gap(&c, imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                                   imp_shift(z, -s->center[2]));
    (void)t;
    return imp_add(gap, imp_between(-s->lead_off, s->lead_off));
}
IMP_DISTANCE_FORMULA(thread_gap)

/* Screws of the endless thread. A turn by A changes the phase by starts A, which is as much as that
 * by starts pitch A / (2 pi) along the axis. */
static imp_status thread_symmetry(const void *self, imp_symmetry *symmetry)
{
    const thread_instance *s = self;
    if (s->lead == 0) return IMP_STATUS_UNBOUNDED;
    symmetry->kind = s->lead > 0 ? IMP_SYMMETRY_SCREW_RIGHT : IMP_SYMMETRY_SCREW_LEFT;
    symmetry->axis[2] = fabs(s->lead);
    if (s->is_closed) symmetry->is_closed = IMP_SYMMETRY_CLOSED;
    memcpy(symmetry->center, s->center, sizeof s->center);
    return IMP_STATUS_OK;
}

static imp_status thread_write_formula(const void *self, const imp_text_sink *to)
{
    const thread_instance *s = self;
    for (size_t k = 0; k < s->count; ++k) imp_define_at(to, "profile", k, s->profile[k]);
    imp_add_text(to, "phase = starts*u - 2*pi*height*v/pitch; ring = radius");
    for (size_t k = 0; k < s->count; ++k) {
        imp_add_text(to, " + profile");
        imp_add_whole(to, k);
        imp_add_text(to, "*cos(");
        imp_add_whole(to, k + 1);
        imp_add_text(to, "*phase)");
    }
    imp_add_text(to, "; u in [0, 2*pi]; v in [-1/2, 1/2]; center0 + ring*cos(u); "
                     "center1 + ring*sin(u); center2 + height*v");
    return IMP_STATUS_OK;
}

static const imp_surface_type thread = {
    IMP_SURFACE_FIELDS(thread, thread_formula),
    .distance = thread_gap_distance,
    .symmetry = thread_symmetry,
    .write_formula = thread_write_formula,
    .summary = "flanks of a screw thread about the z axis, of any profile",
    .equation =
        "center + (R cos u, R sin u, height v), R = radius + sum_k profile_k cos(k (starts u - "
        "2 pi height v / pitch)), u in [0,2pi], v in [-1/2,1/2]",
    .source = NULL,
    .example = "thread radius=1 profile=0.1 pitch=0.5 height=2",
};

PUBLISH_SURFACE(thread);
