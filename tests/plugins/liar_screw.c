/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* A lead that is 0.1 % too long. */
COIL_PLUGIN("liar_screw", coil_domain, IMP_SYMMETRY_SCREW_RIGHT, 1.001, 0);
