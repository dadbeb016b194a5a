/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* The liars' surface without a lie: if this one were accused, their tests would prove nothing. */
LIAR_INCLUDE("liar_truthful", wavy_formula_include);
