/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BUILD_TREE_H
#define TOOLS_CLI_BUILD_TREE_H

/* Returns the plugin directory of the build tree, if the program runs from one: an absolute path
 * that lives as long as the program, else NULL (installed). So tools/impinge can run without
 * installation and uses the plugins just built.
 *
 * libtool keeps the real program in tools/.libs and the modules in plugins/.libs, beside
 * a config.status at the top; no installed tree looks like that. */
const char *build_tree_plugins(void);

/* Returns the directory of the command's data files in the build tree; else NULL. */
const char *build_tree_data(void);

#endif
