/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* The wrong hand. */
COIL_PLUGIN("liar_screw_hand", IMP_SYMMETRY_SCREW_LEFT, 1);
