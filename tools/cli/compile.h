/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_COMPILE_H
#define TOOLS_CLI_COMPILE_H

#include "tools/cli/message.h"

/* A plugin from one source file
 * =============================
 * With the SDK that came with this command, and the user's compiler: CC, CPPFLAGS, CFLAGS (C++: CXX
 * and CXXFLAGS) and LDFLAGS of the environment, as make has them. What bounds rely on stands behind
 * the user's flags. */

/* Is it a source of C or C++, by its suffix? */
bool compile_knows(const char *source);

/* Compiles and links `source` to the shared object `target`. What the compiler says goes to
 * standard error; the complaint on behalf of `verb` tells the first error of it. */
exit_status compile_plugin(const char *source, const char *target, const char *verb);

#endif
