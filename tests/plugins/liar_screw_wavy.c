/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* An end that is no plane. */
COIL_PLUGIN_OF("liar_screw_wavy", coil_wavy, coil_domain, IMP_SYMMETRY_SCREW_RIGHT, 1,
               IMP_SYMMETRY_CLOSED);
