/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/file_state.h"

#include <sys/stat.h>

bool file_state_read(const char *path, file_state *state)
{
    struct stat file;
    *state = (file_state){0};
    if (stat(path, &file) != 0 || !S_ISREG(file.st_mode)) return false;
    *state = (file_state){.device = (uint64_t)file.st_dev,
                          .inode = (uint64_t)file.st_ino,
                          .size = (uint64_t)file.st_size,
                          .modified_s = (int64_t)file.st_mtim.tv_sec,
                          .modified_ns = (int64_t)file.st_mtim.tv_nsec,
                          .changed_s = (int64_t)file.st_ctim.tv_sec,
                          .changed_ns = (int64_t)file.st_ctim.tv_nsec};
    return true;
}
