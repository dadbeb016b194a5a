/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_COMPILE_H
#define TOOLS_CLI_COMPILE_H

#include "tools/cli/message.h"

/* A plugin from one source file
 * =============================
 * With the SDK that came with this command, and the user's compiler: CC, CPPFLAGS, CFLAGS (C++: CXX
 * and CXXFLAGS) and LDFLAGS of the environment, as make has them. The flags that bounds rely on
 * come after the user's. */

/* Whether the suffix is one of C or C++. */
bool compile_knows(const char *source);

/* Compiles and links `source` to the shared object `target`. The compiler's messages go to standard
 * error; the complaint on behalf of `verb` quotes the first error. */
exit_status compile_plugin(const char *source, const char *target, const char *verb);

#endif
