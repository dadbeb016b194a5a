/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "coil.h"

/* The truth. */
COIL_PLUGIN("liar_truthful_screw", IMP_SYMMETRY_SCREW_RIGHT, 1);
