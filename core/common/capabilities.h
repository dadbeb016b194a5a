/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_CAPABILITIES_H
#define CORE_COMMON_CAPABILITIES_H

#include <stdbool.h>

#include <impinge/surface.h>

/* What a type may offer beside points and rates
 * =============================================
 * One row for each capability of <impinge/surface.h>. The registry lists the capabilities that a
 * type offers, the check of plugins refuses one without another that it needs, and `impinge check`
 * asks which checks apply. A new capability begins with a row here. */

typedef enum capability {
    CAPABILITY_CORE,
    CAPABILITY_ORDER_2,
    CAPABILITY_NET,
    CAPABILITY_PIECES,
    CAPABILITY_RIGID,
    CAPABILITY_SPAN,
    CAPABILITY_DISTANCE,
    CAPABILITY_SYMMETRY,
    CAPABILITY_FORMULA,
    CAPABILITY_PARTS,
    CAPABILITY_RENEW,
    CAPABILITY_TUBE,
    CAPABILITIES
} capability;

typedef struct capability_row {
    const char *name; /* as in imp_type_info.capabilities */
    /* Whether a type offers it; NULL: types of this kind never do. */
    bool (*of_surface)(const imp_surface_type *type);
    bool (*of_map)(const imp_map_type *type);
    capability needs; /* what it says nothing without, */
    const char *why;  /* in words that go on "it says "; NULL where it needs CAPABILITY_CORE */
} capability_row;

extern const capability_row capabilities[CAPABILITIES];

/* Whether the type offers it; NULL, which is no type of this kind, offers nothing. */
bool surface_type_offers(const imp_surface_type *type, capability which);
bool map_type_offers(const imp_map_type *type, capability which);

#endif
