/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/polynomial.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { AMPLITUDE, AMPLITUDES, WAVE_VECTOR, SPEED, PHASE };

static const imp_parameter parameters[] = {
    [AMPLITUDE] = IMP_ROW_VECTOR("amplitude", "length", NULL, IMP_PARAMETER_OPTIONAL,
                                 "constant amplitude: greatest displacement, in any direction"),
    [AMPLITUDES] =
        IMP_ROW_VECTORS("amplitudes", "length/time^k", NULL, 3, IMP_PARAMETER_OPTIONAL,
                        "instead: coefficients [x,y,z] of t^0, t^1, t^2 ... of the amplitude"),
    [WAVE_VECTOR] = IMP_ROW("wave_vector", "rad/length", "[1,0,0]", 0, 1, 3, 0, -AXIS_MAX, AXIS_MAX,
                            "direction in which the wave travels, 2pi / wavelength long"),
    [SPEED] = IMP_ROW_NUMBER("speed", "length/time", "1", "speed of a crest; negative: backwards"),
    [PHASE] = IMP_ROW_NUMBER("phase", "rad", "0", "phase at the origin at time 0"),
};

typedef struct wave_instance {
    near_constant vector[3], frequency; /* frequency: -|vector| speed */
    double phase;
    polynomial amplitude;
    double coefficients[];
} wave_instance;

/* How many coefficients, and where they are. */
static const imp_value *given(const imp_value *values, size_t *count)
{
    const bool constant = imp_is_given(&values[AMPLITUDE]);
    *count = constant ? 1 : values[AMPLITUDES].extent[0];
    return &values[constant ? AMPLITUDE : AMPLITUDES];
}

static void set_waves(wave_instance *s, const double vector[3], double speed)
{
    imp_model k[3], unit[3];
    for (int i = 0; i < 3; ++i) {
        k[i] = imp_num(vector[i]);
        s->vector[i] = near_exact(vector[i]);
    }
    axis_unit_of(vector, unit); /* k . unit is |k|, exact along x, y and z */
    s->frequency = near_of(imp_scale(imp_dot3(k, unit), -speed));
}

static imp_status wave_create(const imp_value *values, void **self, imp_create_error *why)
{
    size_t count;
    imp_status status = check_one_of(values, AMPLITUDE, AMPLITUDES, why, parameters);
    if (status == IMP_STATUS_OK) status = axis_check(WAVE_VECTOR, values[WAVE_VECTOR].number, why);
    if (status != IMP_STATUS_OK) return status;
    const imp_value *amplitude = given(values, &count);
    wave_instance *s = malloc(sizeof *s + 3 * count * sizeof(double));
    if (s == NULL) return IMP_STATUS_INTERNAL;
    set_waves(s, values[WAVE_VECTOR].number, values[SPEED].number[0]);
    s->phase = values[PHASE].number[0];
    s->amplitude = polynomial_spread(amplitude->number, count, 3, 3, s->coefficients);
    *self = s;
    return IMP_STATUS_OK;
}

static void wave_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                         imp_model out[3])
{
    const wave_instance *s = self;
    const imp_model at[3] = {x, y, z};
    imp_model phase = imp_add(axis_dot(s->vector, at), near_scale(t, s->frequency));
    imp_model swing = imp_sin(imp_shift(phase, s->phase));
    for (size_t i = 0; i < 3; ++i)
        out[i] = imp_add(at[i], imp_mul(polynomial_at(&s->amplitude, i, t), swing));
}
IMP_MAP_FORMULA(wave_formula)
IMP_MAP_AT_ALL_TIMES(wave)

static imp_status wave_write_formula(const void *self, const imp_text_sink *to)
{
    const wave_instance *s = self;
    polynomial_define(&s->amplitude, 0, "a0", to);
    polynomial_define(&s->amplitude, 1, "a1", to);
    polynomial_define(&s->amplitude, 2, "a2", to);
    imp_add_text(to, "k = hypot(wave_vector0, wave_vector1, wave_vector2); "
                     "swing = sin(wave_vector0*x + wave_vector1*y + wave_vector2*z - k*speed*t + "
                     "phase); x + a0*swing; y + a1*swing; z + a2*swing");
    return IMP_STATUS_OK;
}

static const imp_map_type wave = {
    IMP_MAP_FIELDS(wave, wave_formula),
    .write_formula = wave_write_formula,
    .summary = "displaces every point by a travelling wave",
    .equation = "(x,y,z) + amplitude sin(k.(x,y,z) - |k| speed t + phase), k = wave_vector; "
                "amplitude may be sum_k amplitudes_k t^k",
    .source = NULL,
    .example = "wave amplitude=0,0,0.1 wave_vector=6,0,0 speed=1",
};

PUBLISH_MAP(wave);
