/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* A slit that screw motions move. */
COIL_PLUGIN("liar_screw_slit", coil_slit_domain, IMP_SYMMETRY_SCREW_RIGHT, 1, IMP_SYMMETRY_CLOSED);
