/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/capabilities.h"

static bool is_surface(const imp_surface_type *type) { return type != NULL; }
static bool is_map(const imp_map_type *type) { return type != NULL; }

#define OFFERS(KIND, CALLBACK)                                                                     \
    static bool KIND##_offers_##CALLBACK(const imp_##KIND##_type *type)                            \
    {                                                                                              \
        return IMP_OFFERS(type, CALLBACK);                                                         \
    }
OFFERS(surface, include)
OFFERS(surface, net)
OFFERS(surface, piece)
OFFERS(surface, distance)
OFFERS(surface, symmetry)
OFFERS(surface, renew)
OFFERS(surface, tube)
OFFERS(map, apply)
OFFERS(map, net)
OFFERS(map, rigid)
OFFERS(map, span)
OFFERS(map, parts)
OFFERS(map, renew)

#define OFFERS_FORMULA(KIND)                                                                       \
    static bool KIND##_offers_formula(const imp_##KIND##_type *type)                               \
    {                                                                                              \
        return IMP_OFFERS(type, formula) || IMP_OFFERS(type, write_formula);                       \
    }
OFFERS_FORMULA(surface)
OFFERS_FORMULA(map)

const capability_row capabilities[CAPABILITIES] = {
    [CAPABILITY_CORE] = {"core", is_surface, is_map, CAPABILITY_CORE, NULL},
    [CAPABILITY_ORDER_2] = {"order-2", surface_offers_include, map_offers_apply, CAPABILITY_CORE,
                            NULL},
    [CAPABILITY_NET] = {"net", surface_offers_net, map_offers_net, CAPABILITY_CORE, NULL},
    [CAPABILITY_PIECES] = {"pieces", surface_offers_piece, NULL, CAPABILITY_CORE, NULL},
    [CAPABILITY_RIGID] = {"rigid", NULL, map_offers_rigid, CAPABILITY_CORE, NULL},
    [CAPABILITY_SPAN] = {"span", NULL, map_offers_span, CAPABILITY_CORE, NULL},
    [CAPABILITY_DISTANCE] = {"distance", surface_offers_distance, NULL, CAPABILITY_CORE, NULL},
    [CAPABILITY_SYMMETRY] = {"symmetry", surface_offers_symmetry, NULL, CAPABILITY_DISTANCE,
                             "what changes no distance"},
    [CAPABILITY_FORMULA] = {"formula", surface_offers_formula, map_offers_formula, CAPABILITY_CORE,
                            NULL},
    [CAPABILITY_PARTS] = {"parts", NULL, map_offers_parts, CAPABILITY_CORE, NULL},
    [CAPABILITY_RENEW] = {"renew", surface_offers_renew, map_offers_renew, CAPABILITY_CORE, NULL},
    [CAPABILITY_TUBE] = {"tube", surface_offers_tube, NULL, CAPABILITY_CORE, NULL},
};

bool surface_type_offers(const imp_surface_type *type, capability which)
{
    const capability_row *row = &capabilities[which];
    return type != NULL && row->of_surface != NULL && row->of_surface(type);
}

bool map_type_offers(const imp_map_type *type, capability which)
{
    const capability_row *row = &capabilities[which];
    return type != NULL && row->of_map != NULL && row->of_map(type);
}
