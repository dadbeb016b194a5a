/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_OPERAND_H
#define TOOLS_CHECK_OPERAND_H

#include "tools/cli/arguments.h"

/* The operand of `impinge check`: a file, a type, or a type with parameters. */

#define OPERAND_BLANKS " \t\n\r" /* as in a pipeline */

/* Returns whether it is a path: has a slash or ends in .so. A type's name has no slash and does
 * not. */
bool operand_is_path(const char *operand);

/* The file a type comes from. */
typedef struct operand_file {
    bool found;
    char file[4096];
    char near[80]; /* the nearest existing name */
} operand_file;

/* A type's name: the operand up to its first blank; empty: all types of the file. */
typedef struct operand_type {
    const arguments *args;
    char name[80];
} operand_type;

/* Looks the type up in a child, since other plugins are loaded on the way. *l is from child_memory.
 * Complains of names that are unknown. */
exit_status operand_find_type(const arguments *args, const operand_type *w, double seconds,
                              operand_file *l);

/* Finds the plugin at a path. Complains if it cannot be read. */
exit_status operand_find_file(const arguments *args, const char *path, operand_file *l);

#endif
