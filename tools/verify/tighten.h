/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_TIGHTEN_H
#define TOOLS_VERIFY_TIGHTEN_H

#include "tools/verify/walk.h"

/* Smaller certificates
 * ====================
 * While a certificate is proved, a shorter one is written that claims the same: two leaves of one
 * cell become a single leaf where the prover parts the whole cell with no more work, and an axis is
 * left out where the prover does without. Nothing here is trusted: what is written is proved again
 * by whoever reads it. */

typedef struct tightening tightening;

/* Has the walk, whose input nothing has been read of, write to the file. NULL: no memory. The
 * caller frees the result after the walk. */
tightening *tighten_begin(walk *w, FILE *to);

/* Writes the checksum, and returns how many leaves were written. False: memory ran out, or the file
 * takes no more. */
bool tighten_end(tightening *g, uint64_t *leaves);

void tighten_free(tightening *g);

#endif
