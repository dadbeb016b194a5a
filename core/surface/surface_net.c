/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stddef.h>
#include <string.h>

#include "core/surface/surface_internal.h"

/* Whether all numbers are finite and no error is negative. */
static bool is_sane(const imp_net *net)
{
    const size_t points = (size_t)(net->degree[0] + 1) * (net->degree[1] + 1);
    bool sane = true;
    double off = 0;
    for (int i = 0; i < 3; ++i) {
        const double *x = net->point[i], *v = net->velocity[i];
        off += zero_if_finite(net->place[i]) + zero_if_finite(net->drift[i]);
        sane = sane && net->error[i] >= 0 && net->error[i] < INFINITY;
        for (size_t k = 0; k < points; ++k) off += zero_if_finite(x[k]) + zero_if_finite(v[k]);
    }
    for (size_t k = 0; k < points && net->is_weighted; ++k)
        sane = sane && net->weight[k] > 0 && net->weight[k] < INFINITY;
    return sane && off == 0;
}

static bool fits(const imp_net *net)
{
    return net->degree[0] < IMP_NET_POINTS && net->degree[1] < IMP_NET_POINTS &&
           (net->degree[0] + 1) * (net->degree[1] + 1) <= IMP_NET_POINTS;
}

static imp_status judge(imp_status status, const imp_net *net)
{
    return status == IMP_STATUS_OK && !(fits(net) && is_sane(net)) ? SURFACE_BAD_NET : status;
}

bool surface_offers_net(const surface *s)
{
    if (s->type->net == NULL) return false;
    for (size_t k = 0; k < s->map_count; ++k)
        if (s->maps[k].type->net == NULL) return false;
    return true;
}

/* Clears the net in two halves: for more than 2 kB the C library uses a repeated-store instruction,
 * which is slow to start. */
static void clear(imp_net *net)
{
    const size_t half = offsetof(imp_net, velocity);
    memset(net, 0, half);
    memset((char *)net + half, 0, sizeof *net - half);
}

imp_status surface_net(const surface *s, const imp_region *region, imp_net *net)
{
    if (!surface_offers_net(s)) return IMP_STATUS_UNBOUNDED;
    clear(net);
    const surface_call call = surface_call_begin(s->type->name, "net");
    imp_status status = s->type->net(s->self, region, net);
    status = judge(surface_call_end(call, status), net);
    for (size_t k = 0; k < s->map_count && status == IMP_STATUS_OK; ++k) {
        const mapping *map = &s->maps[k];
        const surface_call of_map = surface_call_begin(map->type->name, "net");
        status = map->type->net(map->self, region, net);
        status = judge(surface_call_end(of_map, status), net);
    }
    return status;
}
