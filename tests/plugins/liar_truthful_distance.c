/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* The distance of the other two without their lies. */
LIAR_DISTANCE("liar_truthful_distance", pipe_gap_distance);
