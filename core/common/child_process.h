/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_CHILD_PROCESS_H
#define CORE_COMMON_CHILD_PROCESS_H

/* What a forked child does before it runs code of a plugin
 * ========================================================
 * It becomes the leader of a process group, so that whatever it starts can be ended with it and
 * signals to the host's group do not reach it; has no handler of the host; leaves no core file; and
 * keeps the descriptor `kept` as CHILD_DESCRIPTOR and no other one of the host: its standard
 * streams lead to /dev/null, but for that of errors where `errors` is a descriptor, not -1. exit()
 * there runs nothing that the host left for its own end. */

enum { CHILD_DESCRIPTOR = 3 };

/* Ends the process with status 1 if that cannot be done. */
void child_process_detach(int kept, int errors);

#endif
