/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* A slit too narrow for random motions to meet. */
COIL_PLUGIN("liar_screw_crack", coil_crack_domain, IMP_SYMMETRY_SCREW_RIGHT, 1,
            IMP_SYMMETRY_CLOSED);
