/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_MALLOC_WATCH_H
#define TOOLS_CHECK_MALLOC_WATCH_H

#include <stdbool.h>

/* Calls of malloc, free and their kin by shared objects
 * =====================================================
 * A shared object calls malloc through an address that the loader has written into its tables. Here
 * these addresses are replaced, in all objects that are loaded except the command itself: in the
 * plugin, and in libc and libstdc++, so that strdup, qsort and operator new are seen too. The
 * replacements do what they replace. This cannot be undone, and is meant for a child process that
 * ends soon. */

/* False: no object has such an address. Objects that are loaded later are not watched. */
bool malloc_watch_begin(void);

/* From here on calls by this thread are noted. */
void malloc_watch_start(void);

/* Ends that. The name of the first function that was called, or NULL. */
const char *malloc_watch_stop(void);

#endif
