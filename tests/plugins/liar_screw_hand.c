/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* The wrong hand. */
COIL_PLUGIN("liar_screw_hand", coil_domain, IMP_SYMMETRY_SCREW_LEFT, 1, 0);
