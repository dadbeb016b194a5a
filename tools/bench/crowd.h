/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_CROWD_H
#define TOOLS_BENCH_CROWD_H

#include <stddef.h>
#include <stdint.h>

/* Returns a scene file's text, on one line: `count` bodies, half of them deforming, that begin
 * apart from each other, one in each cell of a cube, and drift in all directions. The same for a
 * seed on every machine. NULL: no memory. The caller frees it. */
char *crowd_text(size_t count, uint64_t seed);

/* Returns a scene file's text: two meshes, tori of 2 * rows * columns triangles each, that turn,
 * and drift into each other. NULL: no memory. The caller frees it. */
char *crowd_two_meshes(size_t rows, size_t columns);

#endif
