/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* The truth. */
COIL_PLUGIN("liar_truthful_screw", coil_domain, IMP_SYMMETRY_SCREW_RIGHT, 1, IMP_SYMMETRY_CLOSED);
