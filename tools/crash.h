/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CRASH_H
#define TOOLS_CRASH_H

/* When a plugin crashes or exits in the middle of its work, the command says which one and in what
 * callback, and ends with EXIT_PLUGIN. A crash of our own stays what it is. */
void crash_prepare(void);

#endif
