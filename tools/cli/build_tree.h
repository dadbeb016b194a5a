/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BUILD_TREE_H
#define TOOLS_CLI_BUILD_TREE_H

/* The plugins of the tree that this very program was built in, if it runs from there: an
 * absolute path that lives as long as the program, else NULL (installed). Whoever builds
 * Impinge can then run tools/impinge without installing and meets the plugins just built.
 *
 * libtool keeps the real program in tools/.libs and the modules in plugins/.libs, beside
 * a config.status at the top; no installed tree looks like that. */
const char *build_tree_plugins(void);

/* The directory of the data files that come with the command, in that same tree; else NULL. */
const char *build_tree_data(void);

#endif
