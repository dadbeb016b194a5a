/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_CHILD_H
#define TOOLS_CHECK_CHILD_H

#include <stdbool.h>
#include <stddef.h>

/* Work that may crash, hang or exit, done in a child process
 * ==========================================================
 * The child gets `result`, memory that both share, and does not return from `work` if the plugin
 * it tries does not let it. Its standard streams lead nowhere. */

typedef void child_work(void *result, const void *task);

typedef enum child_end {
    CHILD_DONE,   /* work returned */
    CHILD_KILLED, /* by a signal: see `number` */
    CHILD_EXITED, /* it called exit: see `number` */
    CHILD_LATE,   /* the deadline passed; it has been killed */
    CHILD_NOT_RUN /* no process to be had: see `number`, an errno */
} child_end;

typedef struct child_fate {
    child_end end;
    int number; /* signal, exit status or errno */
} child_fate;

/* Zeroed memory that children share, or NULL. */
void *child_memory(size_t size);
void child_memory_free(void *memory, size_t size);

child_fate child_run(child_work *work, void *result, const void *task, double seconds);

/* "crashed (Segmentation fault)", "called exit (status 3)", ... */
typedef struct fate_text {
    char text[120];
} fate_text;
fate_text child_fate_text(child_fate fate, double seconds);

#endif
