/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ELF_PROBE_H
#define CORE_PLUGIN_ELF_PROBE_H

#include <stdbool.h>
#include <stdint.h>

#include "core/base/text.h"

/* What a plugin file says about itself, before any of its code runs
 * =================================================================
 * dlopen trusts its file: a truncated one kills the process with SIGBUS, and constructors run
 * before the host knows which ABI they were built for. So the file is read first, like any
 * data: in small pieces, each checked against the file's size, never mapped.
 *
 * The result is a list of named checks, each with a verdict and a line of text: what was
 * found, and where it is refused, the cure. A loader stops at the first refusal; `impinge why`
 * asks for all. */

typedef enum elf_check_id {
    PROBE_FILE,     /* a regular file that can be read */
    PROBE_FORMAT,   /* an ELF file */
    PROBE_CLASS,    /* word size and byte order of this machine */
    PROBE_MACHINE,  /* the processor of this machine */
    PROBE_KIND,     /* a shared object */
    PROBE_HEADERS,  /* tables of program and section headers inside the file */
    PROBE_SEGMENTS, /* everything to be mapped inside the file, and apart in memory */
    PROBE_TABLES,   /* symbols, strings and relocations lead nowhere outside the object */
    PROBE_NOTE,     /* the note .note.impinge, well formed */
    PROBE_ABI,      /* a version of the ABI this host speaks */
    PROBE_CHECKS
} elf_check_id;

typedef enum elf_verdict {
    PROBE_NOT_REACHED, /* the checks it builds upon did not pass, or we stopped before */
    PROBE_PASSED,
    PROBE_REFUSED
} elf_verdict;

typedef struct elf_check {
    const char *name; /* one word */
    elf_verdict verdict;
    char text[320]; /* a line; empty if not reached */
} elf_check;

/* Which file it is: probe again when this changes. A copy that keeps size and time of modification
 * (cp -p, touch -r) has another time of change. */
typedef struct elf_identity {
    uint64_t device, inode, size;
    int64_t modified_s, modified_ns; /* time of last modification, since 1970; owners may set it */
    int64_t changed_s, changed_ns;   /* the same of file or status; nobody sets it */
} elf_identity;

bool elf_identity_is_same(elf_identity a, elf_identity b);

/* Whether the file there now is that one. */
bool elf_identity_is_at(elf_identity file, const char *path);

typedef struct elf_probe {
    elf_check check[PROBE_CHECKS];
    elf_identity file; /* once PROBE_FILE has passed */

    bool is_tried;      /* PROBE_TABLES has passed before */
    bool lacks_memory;  /* the refusal tells nothing of the file */
    char sanitizer[32]; /* the runtime it needs, as libasan.so.8; empty: none */

    /* The note, once PROBE_NOTE has passed. */
    uint32_t abi_major, abi_minor;
    char name[TEXT_NAME_MAX + 1]; /* of the plugin */
    char version[TEXT_NAME_MAX + 1];
} elf_probe;

/* Runs the checks on a file: all that can be, or up to the first refusal. True if every check
 * passed. Never crashes, whatever the file holds. */
bool elf_probe_file(const char *path, bool all, elf_probe *probe);

/* Up to the first refusal, of a file whose PROBE_TABLES has passed before: that check, which takes
 * longest, is left out. */
bool elf_probe_tried(const char *path, elf_probe *probe);

/* The first check that refused, or NULL. */
const elf_check *elf_probe_refusal(const elf_probe *probe);

/* Whether this host takes a plugin of that ABI. `text` gets the facts, or which field differs,
 * both its values and the cure. */
bool elf_probe_abi_fits(uint32_t major, uint32_t minor, char *text, size_t size);

#endif
