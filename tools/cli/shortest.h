/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SHORTEST_H
#define TOOLS_CLI_SHORTEST_H

#include <stddef.h>

enum { SHORTEST_SIZE = 32 };

/* Writes the number in the fewest digits that read back exactly: with 15, 16 or 17 digits as printf
 * rounds it, the first that reads back. Returns the length; a NUL follows. The number must be
 * finite. [any thread] */
size_t shortest_write(double number, char to[SHORTEST_SIZE]);

#endif
