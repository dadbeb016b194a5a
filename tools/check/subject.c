/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/subject.h"

#include <impinge/formula.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/common/capabilities.h"

/* --- Calls ------------------------------------------------------------------------------------ */

void subject_note_stage(check_answer *answer, const char *name, const char *stage)
{
    answer->call = (check_call){.name = name};
    if (name == NULL) return;
    snprintf(answer->call.stage, sizeof answer->call.stage, "%s", stage);
    answer_count_call(answer);
}

imp_code subject_create(imp_registry *registry, imp_type_kind kind, const char *stage,
                        imp_instance *made, imp_error *error, check_answer *answer)
{
    *made = (imp_instance){NULL, NULL, NULL};
    *error = (imp_error){IMP_SUCCESS, ""};
    subject_note_stage(answer, "create", stage);
    const imp_code code = imp_instance_from_text(registry, kind, stage, made, error);
    subject_note_stage(answer, NULL, NULL);
    return code;
}

void subject_destroy(imp_instance *made, const char *stage, check_answer *answer)
{
    subject_note_stage(answer, "destroy", stage);
    imp_instance_free(made);
    subject_note_stage(answer, NULL, NULL);
}

void subject_note_call(check_answer *answer, const char *name, const char *hint)
{
    answer->call = (check_call){.name = name, .hint = hint};
    if (name != NULL) answer_count_call(answer);
}

static void note(const subject *s, const char *name, int n, const double *lo, const double *hi)
{
    check_call *call = &s->answer->call;
    call->name = name;
    call->stage[0] = '\0';
    call->count = hi != NULL ? 2 * n : n;
    if (lo != NULL) memcpy(call->number, lo, (size_t)n * sizeof *lo);
    if (hi != NULL) memcpy(call->number + n, hi, (size_t)n * sizeof *hi);
    answer_count_call(s->answer);
}

static imp_status noted(const subject *s, imp_status status)
{
    s->answer->call.name = NULL;
    return status;
}

imp_status subject_eval(const subject *s, size_t count, const double *p, double *x, double *error)
{
    const imp_instance *i = s->instance;
    memset(x, 0xff, 3 * count * sizeof *x); /* NaN: shows what is not written */
    if (error != NULL) memset(error, 0xff, 3 * count * sizeof *error);
    note(s, "eval", s->n, p, NULL);
    return noted(s, i->surface != NULL ? i->surface->eval(i->self, count, p, x, error)
                                       : i->map->eval(i->self, count, p, x, error));
}

static imp_status surface_rate(const subject *s, const box *where, double rate[3][BOX_DIMS])
{
    const imp_region region = imp_region_between(where->lo, where->hi);
    imp_rate_matrix m;
    memset(&m, 0xff, sizeof m); /* NaN again */
    const imp_status status = s->instance->surface->rate(s->instance->self, &region, &m);
    for (int i = 0; i < 3; ++i) {
        memset(rate[i], 0, BOX_DIMS * sizeof *rate[i]);
        memcpy(rate[i], m.m[i], sizeof m.m[i]);
    }
    return status;
}

static imp_status map_rate(const subject *s, const box *where, double rate[3][BOX_DIMS])
{
    imp_box4 space;
    imp_map_rates m;
    memset(&m, 0xff, sizeof m);
    memcpy(space.lo, where->lo, sizeof space.lo);
    memcpy(space.hi, where->hi, sizeof space.hi);
    const imp_status status = s->instance->map->rate(s->instance->self, &space, &m);
    for (int i = 0; i < 3; ++i) {
        memset(rate[i], 0, BOX_DIMS * sizeof *rate[i]);
        memcpy(rate[i], m.m[i], sizeof m.m[i]);
    }
    return status;
}

imp_status subject_rate(const subject *s, const box *where, double rate[3][BOX_DIMS])
{
    note(s, "rate", s->n, where->lo, where->hi);
    return noted(s, s->n == 3 ? surface_rate(s, where, rate) : map_rate(s, where, rate));
}

imp_status subject_include(const subject *s, const imp_region *region, imp_model model[3])
{
    note(s, "include", 3, region->lo, region->hi);
    memset(model, 0xff, 3 * sizeof *model);
    return noted(s, s->instance->surface->include(s->instance->self, region, model));
}

imp_status subject_apply(const subject *s, const imp_model in[4], imp_model out[3])
{
    double lo[4], hi[4];
    for (int i = 0; i < 4; ++i) {
        lo[i] = in[i].lo;
        hi[i] = in[i].hi;
    }
    note(s, "apply", 4, lo, hi);
    memset(out, 0xff, 3 * sizeof *out);
    return noted(s, s->instance->map->apply(s->instance->self, in, out));
}

imp_status subject_net(const subject *s, const imp_region *region, imp_net *net)
{
    note(s, "net", 3, region->lo, region->hi);
    memset(net, 0, sizeof *net);
    return noted(s, s->instance->surface->net(s->instance->self, region, net));
}

imp_status subject_map_net(const subject *s, const imp_region *region, imp_net *net)
{
    note(s, "net", 3, region->lo, region->hi);
    return noted(s, s->instance->map->net(s->instance->self, region, net));
}

bool subject_is_rigid(const subject *s)
{
    const imp_map_type *map = s->instance->map;
    return map_type_offers(map, CAPABILITY_RIGID);
}

imp_region subject_span(const box *where)
{
    return imp_region_between(where->lo + 1, where->hi + 1); /* of y, z, t */
}

imp_status subject_pose(const subject *s, const imp_region *span, imp_pose *pose)
{
    const imp_model t = span->d[2] > 0 ? imp_param(span, 2) : imp_num(span->c[2]);
    memset(pose, 0, sizeof *pose);
    if (!subject_is_rigid(s)) return IMP_STATUS_OK;
    note(s, "rigid", 3, span->lo, span->hi);
    return noted(s, s->instance->map->rigid(s->instance->self, &t, pose));
}

bool subject_has_distance(const subject *s)
{
    const imp_surface_type *type = s->instance->surface;
    return surface_type_offers(type, CAPABILITY_DISTANCE);
}

imp_status subject_distance(const subject *s, const imp_model point[4], imp_model *distance)
{
    double lo[4], hi[4];
    for (int i = 0; i < 4; ++i) {
        lo[i] = point[i].lo;
        hi[i] = point[i].hi;
    }
    note(s, "distance", 4, lo, hi);
    memset(distance, 0xff, sizeof *distance);
    return noted(s, s->instance->surface->distance(s->instance->self, point, distance));
}

imp_status subject_symmetry(const subject *s, imp_symmetry *symmetry)
{
    const imp_surface_type *type = s->instance->surface;
    memset(symmetry, 0, sizeof *symmetry);
    if (!surface_type_offers(type, CAPABILITY_SYMMETRY)) return IMP_STATUS_UNBOUNDED;
    note(s, "symmetry", 0, NULL, NULL);
    return noted(s, type->symmetry(s->instance->self, symmetry));
}

bool subject_has_tube(const subject *s)
{
    return surface_type_offers(s->instance->surface, CAPABILITY_TUBE);
}

imp_status subject_tube(const subject *s, const imp_region *region, imp_tube *tube)
{
    memset(tube, 0, sizeof *tube);
    note(s, "tube", 3, region->lo, region->hi);
    return noted(s, s->instance->surface->tube(s->instance->self, region, tube));
}

void subject_operands(const box *where, imp_model in[4])
{
    const imp_region region = imp_region_between(where->lo, where->hi);
    for (int i = 0; i < 3; ++i) in[i] = imp_param(&region, i);
    in[3] = imp_between(where->lo[3], where->hi[3]);
}

imp_status subject_model(const subject *s, box where, imp_model model[3])
{
    imp_model in[4];
    const imp_region region = imp_region_between(where.lo, where.hi);
    memset(model, 0, 3 * sizeof *model);
    if (s->n == 3)
        return s->instance->surface->include != NULL ? subject_include(s, &region, model)
                                                     : IMP_STATUS_OK;
    subject_operands(&where, in);
    return s->instance->map->apply != NULL ? subject_apply(s, in, model) : IMP_STATUS_OK;
}

/* --- Direct checks of each result ------------------------------------------------------------- */

static bool judge_point(const subject *s, const double *p, const double *x, const double *error)
{
    for (int i = 0; i < 3; ++i) {
        if (!isfinite(x[i]))
            return answer_fail_for(s->answer, FAULT_VALUE, "eval gives %c = %g at %s", "xyz"[i],
                                   x[i], subject_point_text(s->n, p).text);
        if (error != NULL && !(error[i] >= 0 && error[i] < INFINITY))
            return answer_fail_for(s->answer, FAULT_ERROR, "eval gives the error %g of %c at %s",
                                   error[i], "xyz"[i], subject_point_text(s->n, p).text);
    }
    return true;
}

bool subject_eval_sane(const subject *s, size_t count, const double *p, double *x, double *error)
{
    const imp_status status = subject_eval(s, count, p, x, error);
    if (status != IMP_STATUS_OK)
        return answer_fail_for(
            s->answer, FAULT_VALUE, "eval returned '%s' for %zu points, the first at %s",
            subject_status_name(status), count, subject_point_text(s->n, p).text);
    for (size_t k = 0; k < count; ++k)
        if (!judge_point(s, p + k * (size_t)s->n, x + 3 * k, error != NULL ? error + 3 * k : NULL))
            return false;
    return true;
}

bool subject_rate_sane(const subject *s, const box *where, double rate[3][BOX_DIMS])
{
    const imp_status status = subject_rate(s, where, rate);
    const subject_text at = subject_box_text(s->n, where->lo, where->hi);
    if (status == IMP_STATUS_UNBOUNDED) return false;
    if (status != IMP_STATUS_OK)
        return answer_fail_for(s->answer, FAULT_RATE, "rate returned '%s' over %s",
                               subject_status_name(status), at.text);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < s->n; ++j)
            if (!(rate[i][j] >= 0 && rate[i][j] < INFINITY))
                return answer_fail_for(s->answer, FAULT_RATE, "the rate of %c by %c is %g over %s",
                                       "xyz"[i], (s->n == 3 ? "uvt" : "xyzt")[j], rate[i][j],
                                       at.text);
    return true;
}
