/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_SHARED_H
#define CORE_SOLID_SHARED_H

#include "core/solid/shells.h"

/* Solids that share faces
 * =======================
 * A body may be put together of closed surfaces that share whole patches: boxes that stand face to
 * face, or a mesh that has faces twice. Then more than two patches meet at a seam, and which of
 * them go on at it is not known. A part, all patches that hang together by seams, is read by the
 * first of these rules that fits, whatever the orientations of its patches are.
 *
 * 1. If the part is closed when each patch counts once, copies of patches change nothing.
 * 2. If all copies together are closed, the part is taken as it is: a triangle with two sides.
 * 3. Copies cancel in pairs, after all numbers of copies are divided by their common divisor: the
 *    shells of which the part is put together are on both sides of a patch that two of them share.
 *    What is left must be closed, and exactly one shell of it must wind around the middle of each
 *    patch that is gone, which then lies inside.
 *
 * Where none of this leaves closed surfaces, nothing is left out. A part that is there several
 * times, and the rest of the body is not, counts once; but if it lies in a shell of another part,
 * or around one, it may be the wall of a cavity and of what fills it, and points inside of both are
 * not classified. */

/* Reads a body of which more than two patches share an edge. *s and *closure hold what was found
 * without leaving patches out, and are kept if no patch is left out. */
imp_code solid_shells_shared(shells *s, const patches *p, double slack, const limit_watch *watch,
                             imp_closure *closure, imp_error *error);

/* Returns the most memory that solid_shells_shared takes, apart from that of solid_shells_within,
 * which it calls for parts of the body. */
size_t solid_shared_bytes(size_t count);

#endif
