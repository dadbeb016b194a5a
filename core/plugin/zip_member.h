/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ZIP_MEMBER_H
#define CORE_PLUGIN_ZIP_MEMBER_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "core/base/status.h"

/* One member of a zip archive
 * ===========================
 * Archives as numpy.savez and numpy.savez_compressed write them: members that are stored or
 * deflated, without a password, in one file without a comment, below 4 GB (no zip64). Deflated ones
 * need zlib (HAVE_ZLIB). All sizes are those of the directory at the archive's end, which are
 * compared with the file's before anything is read; a member takes no more memory than a buffer and
 * zlib's window of 32 kB, however large it says it is. */

typedef struct zip_member {
    FILE *file;             /* stands at what is left of the member */
    uint64_t size;          /* of the member; bytes */
    uint64_t packed;        /* bytes that it still has in the file */
    uint32_t sum, said;     /* CRC-32 of what was read (inverted); of the member, as said */
    struct inflater *state; /* NULL: it is stored */
    bool lacks_memory;      /* reading ended for lack of memory */
} zip_member;

/* What is wrong with an archive. */
typedef struct zip_fault {
    char text[240];
} zip_fault;

/* Whether a file that begins so is an archive. */
bool zip_begins_so(const unsigned char front[4]);

/* Opens the member NAME.npy of the archive, a regular file of that size, which stays the caller's.
 * IMP_ERROR_SCENE, and `fault` says why, for example which arrays there are; IMP_ERROR_MEMORY.
 * zip_member_close is called after success only. */
imp_code zip_member_open(zip_member *m, FILE *file, uint64_t file_size, const char *name,
                         zip_fault *fault);

/* Reads so many bytes, at most 2^20; returns fewer where the member ends or is damaged. */
size_t zip_member_read(zip_member *m, void *to, size_t bytes);

/* Whether the member ends here, in the file too, and what was read has its sum. */
bool zip_member_ends_well(zip_member *m);

void zip_member_close(zip_member *m);

#endif
