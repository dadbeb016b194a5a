/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_CHILD_H
#define CORE_COMMON_CHILD_H

#include <stdbool.h>
#include <stddef.h>

/* Work that may crash, hang or exit, done in a child process with a deadline
 * ===========================================================================
 * The child writes to `result`, memory that both processes share. It is detached from its parent
 * (child_process.h), but does not outlive it. */

typedef void child_work(void *result, const void *task);

typedef enum child_end {
    CHILD_DONE,    /* work returned */
    CHILD_KILLED,  /* by the signal `number` */
    CHILD_EXITED,  /* with the status `number`; -1: unknown, the program has others wait for it */
    CHILD_LATE,    /* killed at the deadline */
    CHILD_STOPPED, /* killed at the deadline; the signal `number` from outside had stopped it */
    CHILD_NOT_RUN  /* no process or pipe: `number` is the errno */
} child_end;

typedef struct child_fate {
    child_end end;
    int number;
} child_fate;

/* Allocates zeroed memory that children share. NULL: no memory. */
void *child_memory(size_t size);
void child_memory_free(void *memory, size_t size);

child_fate child_run(child_work *work, void *result, const void *task, double seconds);

/* Does what child_run does; what the work writes to standard error first is put into said[size],
 * NUL-terminated. More than a pipe holds is lost, and writing it does not wait. */
child_fate child_run_heard(child_work *work, void *result, const void *task, double seconds,
                           char *said, size_t size);

#endif
