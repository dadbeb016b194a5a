/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_ACTIVE_CALLBACK_H
#define CORE_BASE_ACTIVE_CALLBACK_H

/* Which plugin this thread is in, so that a crash can be laid at the right door: a signal handler
 * of the program asks imp_call_in_progress. Set before a callback, cleared after the last of a
 * group; a few stores. */

void active_callback_begin(const char *type, const char *callback);
void active_callback_end(void);

/* The type and callback begun last in this thread, for messages about what it answered. */
const char *active_callback_last(const char **callback);

#endif
