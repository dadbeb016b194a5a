/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_LOAD_PROBE_H
#define CORE_PLUGIN_LOAD_PROBE_H

#include <stdbool.h>

#include "core/base/status.h"
#include "core/plugin/elf_probe.h"

/* The first load of a plugin happens in a child process
 * =====================================================
 * Constructors run inside dlopen, and whatever they do they do to the host: crash, exit, hang. So
 * a file that was never loaded before is opened in a child with a deadline, and only what came
 * back from there whole is loaded here. The outcome is kept with the file's identity (path,
 * device, inode, size, times of modification and of change) in the user's cache, so that this costs
 * once. */

/* Where a plugin was refused. Refusals from LOAD_PROBE on are its own doing; an earlier one may be
 * due to the moment (no more files may be open) or to another file (a library that is missing
 * today). */
typedef enum load_step { LOAD_READ, LOAD_OPEN, LOAD_PROBE, LOAD_ENTRY, LOAD_TYPES } load_step;

/* IMP_SUCCESS; or which step refused, the name of the check in it, and why. */
typedef struct load_outcome {
    imp_code code;
    load_step step;
    char check[16];
    imp_error error;
} load_outcome;

/* Sets a refusal; its text is set already if `format` is NULL. */
void load_outcome_refuse(load_outcome *outcome, load_step step, const char *check,
                         const char *format, ...) __attribute__((format(printf, 4, 5)));

typedef void load_attempt(const char *path, load_outcome *outcome);

/* Runs `attempt` on the path in a child process; its outcome becomes ours. A child that dies or
 * does not finish in time refuses the plugin: LOAD_PROBE, with what happened, or LOAD_OPEN if it
 * was ended or stopped by somebody else (Ctrl-C, the out-of-memory killer) or could not be made.
 * IMP_ERROR_MEMORY: out of memory for the outcome. */
void load_probe_run(const char *path, load_attempt *attempt, load_outcome *outcome);

/* The outcomes of earlier loads, in the user's cache. */
typedef struct load_cache load_cache;

/* Reads the user's cache; an empty one if the file is missing or may not be used (privileged
 * process, no home). NULL: no memory. */
load_cache *load_cache_read(void);

/* Whether the file as it is now was tried; then *code and *text are the outcome (text is valid as
 * long as the cache, "" if it passed). */
bool load_cache_find(const load_cache *cache, const char *path, const elf_probe *file,
                     imp_code *code, const char **text);

/* Whether the file that is there now was tried, and passed. */
bool load_cache_has_passed(const load_cache *cache, const char *path);

/* Replaces what is known of the path; false: no memory. */
bool load_cache_add(load_cache *cache, const char *path, const elf_probe *file, imp_code code,
                    const char *text);

/* Writes the cache back if it has changed, whole or not at all, and frees it. A cache that cannot
 * be written costs time, nothing else. */
void load_cache_close(load_cache *cache);

#endif
