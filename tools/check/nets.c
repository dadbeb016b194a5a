/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/nets.h"

#include <float.h>
#include <impinge/formula.h>
#include <math.h>
#include <string.h>

enum { REGIONS = 2000, POINTS = 10 };

/* --- Form ------------------------------------------------------------------------------------- */

static bool has_sane_numbers(const imp_net *net, uint32_t points)
{
    bool sane = true;
    for (int i = 0; i < 3; ++i) {
        sane = sane && isfinite(net->place[i]) && isfinite(net->drift[i]);
        for (uint32_t k = 0; k < points; ++k)
            sane = sane && isfinite(net->point[i][k]) && isfinite(net->velocity[i][k]);
    }
    return sane;
}

static bool judge_form(const subject *s, const imp_region *region, const imp_net *net)
{
    const uint32_t n = net->degree[0], m = net->degree[1];
    const char *fault = NULL;
    bool errors = true, weights = true;
    if (n >= IMP_NET_POINTS || m >= IMP_NET_POINTS || (n + 1) * (m + 1) > IMP_NET_POINTS)
        return answer_fail(s->answer, "the net has degrees %u and %u over %s, more than %d points",
                           n, m, subject_box_text(3, region->lo, region->hi).text, IMP_NET_POINTS);
    for (int i = 0; i < 3; ++i) errors = errors && net->error[i] >= 0 && isfinite(net->error[i]);
    for (uint32_t k = 0; k < (n + 1) * (m + 1) && net->is_weighted; ++k)
        weights = weights && net->weight[k] > 0 && isfinite(net->weight[k]);
    if (!has_sane_numbers(net, (n + 1) * (m + 1)))
        fault = "has a number that is not finite";
    else if (!errors)
        fault = "has an error that is negative or not finite";
    else if (!weights)
        fault = "has a weight that is not positive";
    return fault == NULL || answer_fail(s->answer, "the net over %s %s",
                                        subject_box_text(3, region->lo, region->hi).text, fault);
}

/* --- The patch of a net ----------------------------------------------------------------------- */

static void bernstein(uint32_t n, long double s, long double *b)
{
    b[0] = 1;
    for (uint32_t k = 1; k <= n; ++k) {
        b[k] = b[k - 1] * s;
        for (uint32_t i = k - 1; i > 0; --i) b[i] = b[i - 1] * s + b[i] * (1 - s);
        b[0] *= 1 - s;
    }
}

typedef struct judged {
    long double value, size; /* sum of magnitudes */
} judged;

/* Coordinate i at s, tau: in long double, whose roundings stay below 256 LDBL_EPSILON of the size:
 * at most 35 in each factor of a weight, 36 sums and the quotient. */
static judged patch_at(const imp_net *net, int i, const long double s[2], long double tau)
{
    long double b[2][IMP_NET_POINTS], sum = 0, size = 0, weights = 0;
    const uint32_t m = net->degree[1];
    for (int j = 0; j < 2; ++j) bernstein(net->degree[j], s[j], b[j]);
    for (uint32_t k = 0; k < (net->degree[0] + 1) * (m + 1); ++k) {
        const long double w = net->is_weighted ? net->weight[k] : 1;
        const long double share = w * b[0][k / (m + 1)] * b[1][k % (m + 1)];
        const long double speed = net->is_moving ? net->velocity[i][k] : 0;
        sum += share * (net->point[i][k] + tau * speed);
        size += share * (fabsl(net->point[i][k]) + fabsl(tau * speed));
        weights += share;
    }
    const long double base = net->place[i], way = tau * net->drift[i];
    return (judged){base + way + sum / weights, fabsl(base) + fabsl(way) + size / weights};
}

static bool judge_point(const subject *s, const imp_region *r, const imp_net *net,
                        const double p[3], const double x[3], const double error[3])
{
    long double at[2];
    for (int j = 0; j < 2; ++j)
        at[j] = r->hi[j] > r->lo[j]
                    ? ((long double)p[j] - r->lo[j]) / ((long double)r->hi[j] - r->lo[j])
                    : 0;
    for (int i = 0; i < 3; ++i) {
        const judged on = patch_at(net, i, at, (long double)p[2] - r->c[2]);
        const long double off = fabsl(x[i] - on.value) - error[i] - 256 * LDBL_EPSILON * on.size;
        ++s->answer->tests;
        if (off > net->error[i])
            return answer_fail_for(s->answer, FAULT_REMAINDER | FAULT_ERROR,
                                   "%c is %.17g (error %g) at %s, %.9Lg off the control net, whose "
                                   "error is %.9g over %s",
                                   "xyz"[i], x[i], error[i], subject_point_text(3, p).text, off,
                                   net->error[i], subject_box_text(3, r->lo, r->hi).text);
    }
    return true;
}

/* --- Surfaces --------------------------------------------------------------------------------- */

static bool judge_surface(const subject *s, uint64_t *random)
{
    const box where = draw_box(random, &s->domain, 3);
    const imp_region region = imp_region_between(where.lo, where.hi);
    imp_net net;
    const imp_status status = subject_net(s, &region, &net);
    if (status == IMP_STATUS_UNBOUNDED) return true;
    if (status != IMP_STATUS_OK)
        return answer_fail(s->answer, "net returned '%s' over %s", subject_status_name(status),
                           subject_box_text(3, region.lo, region.hi).text);
    if (!judge_form(s, &region, &net)) return false;
    for (int k = 0; k < POINTS; ++k) {
        double p[3], x[3], error[3];
        for (int j = 0; j < 3; ++j) {
            const double at = region.c[j] + region.d[j] * draw_normalized(random);
            p[j] = at < region.lo[j] ? region.lo[j] : at > region.hi[j] ? region.hi[j] : at;
        }
        if (!subject_eval_sane(s, 1, p, x, error)) return false;
        if (!judge_point(s, &region, &net, p, x, error)) return false;
    }
    return true;
}

/* --- Maps ------------------------------------------------------------------------------------- */

static double sixteenths(uint64_t *random) { return (double)draw_index(random, 65) / 16 - 2; }

/* A moving bilinear patch over u and v in [0, 1] and some time, whose points at quarters are
 * exact. */
static imp_net draw_net(uint64_t *random)
{
    imp_net net = {.degree = {1, 1}, .is_moving = 1};
    for (int i = 0; i < 3; ++i) {
        net.place[i] = sixteenths(random);
        net.drift[i] = sixteenths(random);
        for (int k = 0; k < 4; ++k) {
            net.point[i][k] = sixteenths(random);
            net.velocity[i][k] = sixteenths(random);
        }
    }
    return net;
}

static double quarter(uint64_t *random) { return (double)draw_index(random, 5) / 4; }

static bool judge_map(const subject *s, uint64_t *random)
{
    const double *lo = s->domain.lo, *hi = s->domain.hi;
    const double from = ceil(16 * lo[3]) / 16, to = floor(16 * hi[3]) / 16;
    const double t0 = from < to ? from : lo[3], t1 = from < to ? to : lo[3];
    const imp_region region = imp_region_between((double[3]){0, 0, t0}, (double[3]){1, 1, t1});
    const imp_net given = draw_net(random);
    imp_net net = given;
    const imp_status status = subject_map_net(s, &region, &net);
    if (status == IMP_STATUS_UNBOUNDED) return true;
    if (status != IMP_STATUS_OK)
        return answer_fail(s->answer, "net returned '%s'", subject_status_name(status));
    if (!judge_form(s, &region, &net)) return false;
    for (int k = 0; k < POINTS; ++k) {
        const double t = t0 + (t1 - t0) * quarter(random);
        const double p[3] = {quarter(random), quarter(random), t};
        double in[4] = {0, 0, 0, t}, x[3], error[3];
        for (int i = 0; i < 3; ++i)
            in[i] = (double)patch_at(&given, i, (long double[2]){p[0], p[1]},
                                     (long double)t - region.c[2])
                        .value;
        if (!subject_eval_sane(s, 1, in, x, error)) return false;
        if (!judge_point(s, &region, &net, p, x, error)) return false;
    }
    return true;
}

void nets_check(const subject *s, uint64_t *random, double effort)
{
    const imp_instance *i = s->instance;
    if (i->surface != NULL ? i->surface->net == NULL : i->map->net == NULL) {
        answer_skip(s->answer, "the type has no net");
        return;
    }
    const double count = REGIONS * effort;
    for (int k = 0; (k < count || k == 0) && s->answer->verdict != CHECK_FAIL; ++k)
        s->n == 3 ? judge_surface(s, random) : judge_map(s, random);
    if (s->answer->verdict == CHECK_PASS && s->answer->tests == 0)
        answer_skip(s->answer, "it has no net with these parameters");
}
