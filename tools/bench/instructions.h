/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_INSTRUCTIONS_H
#define TOOLS_BENCH_INSTRUCTIONS_H

/* The processor's counter of instructions of this thread, outside the kernel. Virtual machines and
 * containers often have none. */

/* Starts counting from 0. Answers a descriptor for instructions_stop, or -1: no counter. */
int instructions_start(void);

/* Instructions since instructions_start; NAN without a counter. Closes the descriptor. */
double instructions_stop(int counter);

#endif
