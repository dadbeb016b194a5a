/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/surface.h>

/* Has the note, and no symbol behind it. */
IMP_NOTE_("no_entry", "1.0");

extern IMP_EXPORT const int some_other_symbol;
const int some_other_symbol = 1;
