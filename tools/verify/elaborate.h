/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_ELABORATE_H
#define TOOLS_VERIFY_ELABORATE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Certificates for the kernel
 * ===========================
 * tools/kernel proves a leaf by the axis that it names, and divides nothing. This writes a
 * certificate of the same claim whose leaves it proves: where its test of a leaf fails, the cell is
 * divided and given axes until it does not. */

typedef struct elaborated {
    uint64_t leaves_before, leaves, tests; /* tests: calls of the kernel's */
    uint64_t at;                           /* byte of the certificate that is refused, and why */
    char why[1000];
} elaborated;

/* Reads a certificate and writes the other one; `effort`: cells that a leaf may become; `progress`
 * (or NULL) is called at each cell with the bytes read so far. False: found->why says why. */
bool elaborate(FILE *from, FILE *to, unsigned long effort, void progress(uint64_t bytes),
               elaborated *found);

struct claim;
/* Frees what claim_read made, which the kernel leaves to the end of its process. */
void claim_free(struct claim *c);

#endif
