/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_FILE_STATE_H
#define CORE_BASE_FILE_STATE_H

#include <stdbool.h>
#include <stdint.h>

/* Which contents a file has: two states are equal, byte by byte, if the file was neither replaced
 * nor written between them. The time of its last change is included, which nobody can set; file
 * systems tell two times apart that are 4 ms to 2 s apart. */
typedef struct file_state {
    uint64_t device, inode, size;
    int64_t modified_s, modified_ns, changed_s, changed_ns;
} file_state;

/* False: there is no regular file, and the state is all 0. */
bool file_state_read(const char *path, file_state *state);

#endif
