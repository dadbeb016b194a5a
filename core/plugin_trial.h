/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_TRIAL_H
#define CORE_PLUGIN_TRIAL_H

#include <stdbool.h>

#include "elf_probe.h"
#include "status.h"

/* The first load of a plugin happens in a child process
 * =====================================================
 * Constructors run inside dlopen, and whatever they do they do to the host: crash, exit, hang. So
 * a file that was never loaded before is opened in a child with a deadline, and only what came
 * back from there whole is loaded here. The outcome is remembered with the file's identity (path,
 * device, inode, size, times of modification and of change) in the user's cache, so that this costs
 * once. */

/* Runs `open` on the path in a child; its answer and text become ours. A child that dies or does
 * not finish in time refuses the plugin: IMP_ERROR_PLUGIN, with what happened. IMP_ERROR_MEMORY: no
 * child could be made. */
imp_code plugin_trial_run(const char *path, imp_code (*open)(const char *path, imp_error *error),
                          imp_error *error);

/* What earlier trials found. */
typedef struct trial_book trial_book;

/* Reads the user's book; an empty one if there is none, or none may be used (privileged process, no
 * home). NULL: no memory. */
trial_book *trial_book_read(void);

/* Whether the file as it is now was tried; then *code and *text are the outcome (text lives as long
 * as the book, "" if it passed). */
bool trial_book_find(const trial_book *book, const char *path, const elf_probe *file,
                     imp_code *code, const char **text);

/* Replaces what is known of the path; false: no memory. */
bool trial_book_add(trial_book *book, const char *path, const elf_probe *file, imp_code code,
                    const char *text);

/* Writes the book back if it has changed, whole or not at all, and frees it. A cache that cannot be
 * written costs time, nothing else. */
void trial_book_close(trial_book *book);

#endif
