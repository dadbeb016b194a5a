/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_FILE_TRUST_H
#define CORE_PLUGIN_FILE_TRUST_H

#include <stdbool.h>

/* Who may decide what is loaded
 * =============================
 * A plugin is code that runs with the rights of this process. Its file is trusted if nobody but
 * root and the user (the effective one) can change it, or put another in its place: on the whole
 * way there, through every link, each directory, link and file belongs to one of the two, and
 * neither file nor directory is writable by everybody. A directory above may be, if it is sticky
 * (as /tmp): others cannot replace what stands in it. The one that a path ends in may not, since
 * others could add to it. Groups are trusted, as those who set up a group's rights do. */

/* False: `why` names the path at fault, what is wrong, and the cure. */
typedef struct trust_fault {
    char text[700];
} trust_fault;
bool file_is_trusted(const char *path, trust_fault *why);

#endif
