/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_READING_LIMITS_H
#define CORE_PLUGIN_READING_LIMITS_H

#include <stdint.h>

/* What making an instance, or a whole scene of text, may take; 0: no limit. */
typedef struct reading_limits {
    double seconds; /* processor time of the thread */
    uint64_t bytes;
} reading_limits;

/* Which limit reading has reached. */
typedef enum reading_end { READING_GOES_ON, READING_OUT_OF_TIME, READING_OUT_OF_ROOM } reading_end;

#endif
