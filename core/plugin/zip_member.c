/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/zip_member.h"

#include <stdlib.h>
#include <string.h>
#ifdef HAVE_ZLIB
#include <zlib.h>
#endif

#include "core/base/text.h"

/* The format is that of PKWARE's APPNOTE.TXT: members, each behind a head of its own; a directory
 * of them; and a record of 22 bytes that says where the directory is. Numbers are little-endian. */

enum {
    RECORD_BYTES = 22,
    ENTRY_BYTES = 46, /* of the directory, before the name */
    HEAD_BYTES = 30,  /* of a member, before the name */
    NAME_MAX_BYTES = 255,
    STORED = 0,
    DEFLATED = 8,
    HAS_PASSWORD = 1 /* flag */
};

/* Deflate makes at most 258 bytes of two bits: one for the length, one for the distance. */
#define DEFLATE_MOST ((uint64_t)258 * 8 / 2)

static uint32_t two(const unsigned char *at) { return at[0] | (uint32_t)at[1] << 8; }
static uint32_t four(const unsigned char *at) { return two(at) | two(at + 2) << 16; }

static imp_code refuse(zip_fault *fault, const char *why)
{
    snprintf(fault->text, sizeof fault->text, "%s", why);
    return IMP_ERROR_SCENE;
}

static bool read_at(FILE *file, uint64_t at, void *to, size_t bytes)
{
    return fseeko(file, (off_t)at, SEEK_SET) == 0 && fread(to, 1, bytes, file) == bytes;
}

bool zip_begins_so(const unsigned char front[4])
{
    /* A member's head, or the record of an archive without members. */
    return memcmp(front, "PK\x03\x04", 4) == 0 || memcmp(front, "PK\x05\x06", 4) == 0;
}

/* --- The directory ---------------------------------------------------------------------------- */

typedef struct directory {
    FILE *file;
    uint64_t at, end; /* of what is left of it, in the file */
    uint64_t start;
    zip_fault *fault;
} directory;

static imp_code find_directory(directory *d, uint64_t file_size)
{
    unsigned char record[RECORD_BYTES];
    if (file_size < RECORD_BYTES ||
        !read_at(d->file, file_size - RECORD_BYTES, record, sizeof record) ||
        memcmp(record, "PK\x05\x06", 4) != 0)
        return refuse(d->fault, "its end is not that of an archive: it was cut off, or has a "
                                "comment");
    d->end = file_size - RECORD_BYTES;
    d->start = d->at = four(record + 16);
    const bool is_here = d->start + four(record + 12) == d->end;
    if (is_here && two(record + 4) == 0 && two(record + 6) == 0) return IMP_SUCCESS;
    return refuse(d->fault, "its directory is not where it says, or it has more than 4 GB or 65534 "
                            "members");
}

typedef struct entry {
    uint32_t flags, method, sum;
    uint64_t packed, size, at;     /* bytes in the file, of the member; where its head begins */
    char name[NAME_MAX_BYTES + 1]; /* empty: longer than that */
    size_t length;
} entry;

static imp_code read_entry(directory *d, entry *e)
{
    unsigned char bytes[ENTRY_BYTES];
    const char *const why = "its directory is damaged";
    if (d->end - d->at < sizeof bytes || !read_at(d->file, d->at, bytes, sizeof bytes) ||
        memcmp(bytes, "PK\x01\x02", 4) != 0)
        return refuse(d->fault, why);
    e->length = two(bytes + 28);
    const uint64_t more = e->length + two(bytes + 30) + two(bytes + 32);
    if (d->end - d->at - sizeof bytes < more) return refuse(d->fault, why);
    d->at += sizeof bytes + more;
    e->flags = two(bytes + 8), e->method = two(bytes + 10), e->sum = four(bytes + 16);
    e->packed = four(bytes + 20), e->size = four(bytes + 24), e->at = four(bytes + 42);
    const size_t kept = e->length <= NAME_MAX_BYTES ? e->length : 0;
    e->name[kept] = '\0';
    return fread(e->name, 1, kept, d->file) == kept ? IMP_SUCCESS : refuse(d->fault, why);
}

static bool has_name(const entry *e, const char *name)
{
    const size_t length = strlen(name);
    return e->length == length + 4 && e->length <= NAME_MAX_BYTES &&
           memcmp(e->name, name, length) == 0 && memcmp(e->name + length, ".npy", 4) == 0;
}

/* Adds the name of an array to a list of them, where there is room. */
static void list_name(zip_fault *list, const entry *e)
{
    char quoted[40];
    if (e->length <= 4 || strlen(e->name) != e->length ||
        strcmp(e->name + e->length - 4, ".npy") != 0)
        return;
    const int fits = snprintf(quoted, sizeof quoted, "%s'%.*s'", list->text[0] != '\0' ? ", " : "",
                              (int)e->length - 4, e->name);
    for (char *c = quoted; *c != '\0'; ++c)
        if (*c < ' ' || *c > '~') *c = '?';
    if ((size_t)fits < sizeof quoted && strlen(list->text) + (size_t)fits < 120)
        text_append(list->text, sizeof list->text, "%s", quoted);
}

/* Finds the only entry of that name; with NULL, refuses by the names there are. */
static imp_code find_entry(directory *d, const char *name, entry *found)
{
    zip_fault list = {""};
    size_t count = 0;
    while (d->at < d->end) {
        entry e;
        const imp_code code = read_entry(d, &e);
        if (code != IMP_SUCCESS) return code;
        list_name(&list, &e);
        if (name == NULL || !has_name(&e, name)) continue;
        *found = e;
        if (++count > 1) return refuse(d->fault, "it has two arrays of that name");
    }
    if (count == 1) return IMP_SUCCESS;
    refuse(d->fault, name != NULL ? "it has no such array"
                                  : "it is an archive (.npz); add \"array\": NAME of one of its "
                                    "arrays");
    if (list.text[0] != '\0')
        text_append(d->fault->text, sizeof d->fault->text, "%s %s", name != NULL ? ", but" : ":",
                    list.text);
    return IMP_ERROR_SCENE;
}

/* Compares what the directory says with the file, and goes to the member's first byte. */
static imp_code go_to(const directory *d, const entry *e)
{
    unsigned char head[HEAD_BYTES];
    char name[NAME_MAX_BYTES];
    if ((e->flags & HAS_PASSWORD) != 0) return refuse(d->fault, "it needs a password");
    if (e->at > d->start || d->start - e->at < sizeof head ||
        !read_at(d->file, e->at, head, sizeof head) || memcmp(head, "PK\x03\x04", 4) != 0 ||
        two(head + 26) != e->length || fread(name, 1, e->length, d->file) != e->length ||
        memcmp(name, e->name, e->length) != 0)
        return refuse(d->fault, "its array is not where the directory says");
    const uint64_t first = e->at + sizeof head + e->length + two(head + 28);
    if (first > d->start || d->start - first < e->packed)
        return refuse(d->fault, "its array ends beyond the directory");
    if (e->method == STORED ? e->size != e->packed : e->size / DEFLATE_MOST > e->packed)
        return refuse(d->fault, "its array says to be larger than what is packed there can be");
    return fseeko(d->file, (off_t)first, SEEK_SET) == 0
               ? IMP_SUCCESS
               : refuse(d->fault, "its array cannot be read");
}

/* --- Deflated members ------------------------------------------------------------------------- */

#ifdef HAVE_ZLIB

struct inflater {
    z_stream z;
    unsigned char packed[1 << 13];
};

static imp_code begin_inflating(zip_member *m, zip_fault *fault)
{
    (void)fault;
    m->state = calloc(1, sizeof *m->state);
    if (m->state != NULL && inflateInit2(&m->state->z, -MAX_WBITS) == Z_OK) return IMP_SUCCESS;
    free(m->state);
    return IMP_ERROR_MEMORY;
}

static void end_inflating(zip_member *m)
{
    if (m->state != NULL) inflateEnd(&m->state->z);
    free(m->state);
}

/* Inflates until so many bytes are there or nothing more comes; returns zlib's last answer. */
static int inflate_into(zip_member *m, void *to, size_t *bytes)
{
    struct inflater *i = m->state;
    int answer = Z_OK;
    i->z.next_out = to, i->z.avail_out = (uInt)*bytes;
    while (i->z.avail_out > 0 && answer == Z_OK) {
        if (i->z.avail_in == 0) {
            const size_t some = m->packed < sizeof i->packed ? m->packed : sizeof i->packed;
            i->z.next_in = i->packed;
            i->z.avail_in = (uInt)fread(i->packed, 1, some, m->file);
            m->packed -= i->z.avail_in;
        }
        answer = inflate(&i->z, Z_NO_FLUSH);
    }
    *bytes -= i->z.avail_out;
    return answer;
}

static size_t read_deflated(zip_member *m, void *to, size_t bytes)
{
    if (inflate_into(m, to, &bytes) == Z_MEM_ERROR) m->lacks_memory = true;
    return bytes;
}

static bool has_ended(zip_member *m)
{
    unsigned char more;
    size_t bytes = 1;
    return inflate_into(m, &more, &bytes) == Z_STREAM_END && bytes == 0 &&
           m->state->z.avail_in == 0;
}

#else

static imp_code begin_inflating(zip_member *m, zip_fault *fault)
{
    (void)m;
    return refuse(fault, "its array is compressed, which Impinge built without zlib does not read; "
                         "write it by numpy.savez, not numpy.savez_compressed, or build Impinge "
                         "where configure finds zlib");
}

static void end_inflating(zip_member *m) { (void)m; }

static size_t read_deflated(zip_member *m, void *to, size_t bytes)
{
    (void)m, (void)to, (void)bytes;
    return 0;
}

static bool has_ended(zip_member *m)
{
    (void)m;
    return false;
}

#endif

/* --- Any member ------------------------------------------------------------------------------- */

imp_code zip_member_open(zip_member *m, FILE *file, uint64_t file_size, const char *name,
                         zip_fault *fault)
{
    directory d = {.file = file, .fault = fault};
    entry e;
    imp_code code = find_directory(&d, file_size);
    if (code == IMP_SUCCESS) code = find_entry(&d, name, &e);
    if (code == IMP_SUCCESS) code = go_to(&d, &e);
    if (code != IMP_SUCCESS) return code;
    *m = (zip_member){
        .file = file, .size = e.size, .packed = e.packed, .sum = UINT32_MAX, .said = e.sum};
    if (e.method == STORED) return IMP_SUCCESS;
    if (e.method == DEFLATED) return begin_inflating(m, fault);
    return refuse(fault, "its array is compressed by another method than deflate");
}

/* CRC-32 of ISO 3309, by halves of a byte: row k is k times the polynomial, shifted. */
static uint32_t sum_on(uint32_t sum, const unsigned char *at, size_t bytes)
{
    static const uint32_t row[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac,
                                     0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
                                     0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                     0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    for (size_t k = 0; k < bytes; ++k) {
        sum = (sum >> 4) ^ row[(sum ^ at[k]) & 15];
        sum = (sum >> 4) ^ row[(sum ^ (at[k] >> 4)) & 15];
    }
    return sum;
}

size_t zip_member_read(zip_member *m, void *to, size_t bytes)
{
    size_t got;
    if (m->state != NULL) {
        got = read_deflated(m, to, bytes);
    } else {
        got = fread(to, 1, m->packed < bytes ? m->packed : bytes, m->file);
        m->packed -= got;
    }
    m->sum = sum_on(m->sum, to, got);
    return got;
}

bool zip_member_ends_well(zip_member *m)
{
    return (m->state == NULL || has_ended(m)) && m->packed == 0 && (m->sum ^ UINT32_MAX) == m->said;
}

void zip_member_close(zip_member *m) { end_inflating(m); }
