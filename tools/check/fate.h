/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_FATE_H
#define TOOLS_CHECK_FATE_H

#include "core/common/child.h"

/* How a child process ended, as text: "crashed (Segmentation fault)", "timed out after 5 s", ... */
typedef struct fate_text {
    char text[120];
} fate_text;
fate_text fate_text_of(child_fate fate, double seconds);

#endif
