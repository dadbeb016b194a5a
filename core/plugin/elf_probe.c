/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/system_error.h"
#include "core/plugin/elf_file.h"
#include "core/plugin/elf_probe.h"
#include "core/plugin/elf_segments.h"
#include "core/plugin/elf_tables.h"
#include "core/plugin/open_file.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <impinge/surface.h>

#define CUT_SHORT "the file is damaged or cut short; build or copy it again"

/* The header of the object this code is linked into, put there by the linker: its class, byte
 * order and machine are the host's. */
extern const Elf64_Ehdr __ehdr_start __attribute__((visibility("hidden")));

__attribute__((format(printf, 3, 4))) static bool answer(elf_check *check, bool passed,
                                                         const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(check->text, sizeof check->text, format, arguments);
    va_end(arguments);
    text_clean(check->text);
    return passed;
}

static elf_identity identity_of(const struct stat *facts)
{
    return (elf_identity){.device = (uint64_t)facts->st_dev,
                          .inode = (uint64_t)facts->st_ino,
                          .size = (uint64_t)facts->st_size,
                          .modified_s = (int64_t)facts->st_mtim.tv_sec,
                          .modified_ns = (int64_t)facts->st_mtim.tv_nsec,
                          .changed_s = (int64_t)facts->st_ctim.tv_sec,
                          .changed_ns = (int64_t)facts->st_ctim.tv_nsec};
}

bool elf_identity_is_same(elf_identity a, elf_identity b)
{
    return a.device == b.device && a.inode == b.inode && a.size == b.size &&
           a.modified_s == b.modified_s && a.modified_ns == b.modified_ns &&
           a.changed_s == b.changed_s && a.changed_ns == b.changed_ns;
}

bool elf_identity_is_at(elf_identity file, const char *path)
{
    struct stat facts;
    return stat(path, &facts) == 0 && elf_identity_is_same(identity_of(&facts), file);
}

/* --- The checks, in order --------------------------------------------------------------------- */

static bool check_file(elf_file *file, elf_probe *probe, elf_check *check)
{
    struct stat facts;
    if (file->fd < 0)
        return answer(check, false, "cannot be opened: %s%s", system_error_text(errno),
                      errno == ENOENT ? "; `impinge info TYPE` names the file of a type" : "");
    if (fstat(file->fd, &facts) != 0)
        return answer(check, false, "cannot be examined: %s", system_error_text(errno));
    if (!S_ISREG(facts.st_mode))
        return answer(check, false, "%s; a plugin is a regular file",
                      S_ISDIR(facts.st_mode) ? "is a directory" : "is a device, pipe or socket");
    file->size = (uint64_t)facts.st_size;
    probe->file = identity_of(&facts);
    return answer(check, true, "%llu bytes", (unsigned long long)file->size);
}

static bool check_format(elf_file *file, elf_probe *probe, elf_check *check)
{
    (void)probe;
    unsigned char magic[SELFMAG];
    if (!elf_file_read(file, 0, magic, sizeof magic) || memcmp(magic, ELFMAG, SELFMAG) != 0)
        return answer(check, false,
                      "is not an ELF file; a plugin is a shared object, as `cc "
                      "-shared -fPIC` makes");
    if (!elf_file_read(file, 0, &file->header, sizeof file->header))
        return answer(check, false, "ends within its ELF header; " CUT_SHORT);
    return answer(check, true, "ELF");
}

static bool check_class(elf_file *file, elf_probe *probe, elf_check *check)
{
    (void)probe;
    const unsigned char *is = file->header.e_ident, *host = __ehdr_start.e_ident;
    if (is[EI_CLASS] != host[EI_CLASS])
        return answer(check, false, "is %s, the host is %s; build the plugin for this machine",
                      elf_class_name(is[EI_CLASS]), elf_class_name(host[EI_CLASS]));
    if (is[EI_DATA] != host[EI_DATA])
        return answer(check, false, "is %s, the host is %s; build the plugin for this machine",
                      elf_order_name(is[EI_DATA]), elf_order_name(host[EI_DATA]));
    if (is[EI_VERSION] != EV_CURRENT)
        return answer(check, false, "has ELF version %d, known is %d; " CUT_SHORT, is[EI_VERSION],
                      EV_CURRENT);
    return answer(check, true, "%s, %s", elf_class_name(is[EI_CLASS]), elf_order_name(is[EI_DATA]));
}

static bool check_machine(elf_file *file, elf_probe *probe, elf_check *check)
{
    (void)probe;
    Elf64_Half is = file->header.e_machine, host = __ehdr_start.e_machine;
    if (is != host)
        return answer(check, false,
                      "is for %s (ELF machine %u), the host is %s (%u); build it "
                      "for this machine",
                      elf_machine_name(is), is, elf_machine_name(host), host);
    return answer(check, true, "%s", elf_machine_name(is));
}

static bool check_kind(elf_file *file, elf_probe *probe, elf_check *check)
{
    (void)probe;
    Elf64_Half is = file->header.e_type;
    if (is == ET_DYN) return answer(check, true, "shared object");
    const char *name = is == ET_REL    ? "an object file that is not linked yet"
                       : is == ET_EXEC ? "a program"
                       : is == ET_CORE ? "a core dump"
                                       : "of unknown kind";
    return answer(check, false, "is %s; link it with -shared", name);
}

/* A position-independent program is of the kind of shared objects, but has an interpreter. */
static bool names_interpreter(elf_file *file)
{
    Elf64_Phdr part;
    for (Elf64_Half k = 0; k < file->header.e_phnum; ++k)
        if (elf_file_segment(file, k, &part) && part.p_type == PT_INTERP) return true;
    return false;
}

static bool check_headers(elf_file *file, elf_probe *probe, elf_check *check)
{
    (void)probe;
    const Elf64_Ehdr *h = &file->header;
    if (h->e_phentsize != sizeof(Elf64_Phdr) || h->e_phnum == 0 || h->e_phnum == PN_XNUM)
        return answer(check, false,
                      "has %u program headers of %u bytes, expected some of %zu; " CUT_SHORT,
                      h->e_phnum, h->e_phentsize, sizeof(Elf64_Phdr));
    if (!elf_file_has(file, h->e_phoff, (uint64_t)h->e_phnum * h->e_phentsize))
        return answer(check, false, "its program headers lie beyond its end; " CUT_SHORT);
    if (!elf_file_has(file, h->e_shoff, (uint64_t)h->e_shnum * h->e_shentsize))
        return answer(check, false, "its section headers lie beyond its end; " CUT_SHORT);
    if (names_interpreter(file))
        return answer(check, false, "is a program, with an interpreter; link it with -shared");
    return answer(check, true, "%u program headers", h->e_phnum);
}

static bool check_segments(elf_file *file, elf_probe *probe, elf_check *check)
{
    (void)probe;
    elf_loads loads;
    char text[200];
    const bool good = elf_segments_check(file, &loads, text, sizeof text);
    return answer(check, good, "%s%s", text, good ? "" : "; " CUT_SHORT);
}

static bool check_tables(elf_file *file, elf_probe *probe, elf_check *check)
{
    elf_loads loads;
    char text[200];
    const bool good = elf_segments_check(file, &loads, text, sizeof text) &&
                      (probe->is_tried || elf_tables_check(file, &loads, text, sizeof text));
    if (good)
        snprintf(probe->sanitizer, sizeof probe->sanitizer, "%s",
                 elf_tables_runtime(file, &loads).name);
    return answer(check, good, "%s%s", text, good ? "" : "; " CUT_SHORT);
}

/* --- The note --------------------------------------------------------------------------------- */

#define NOTE_HEAD 8u /* bytes before the strings: abi_major, abi_minor */
#define NOTE_SIZE (NOTE_HEAD + 2 * (TEXT_NAME_MAX + 1u))

/* Copies a name or version from the `length` bytes at `from`; returns the bytes
 * used with the NUL, or 0 if it is empty, too long, or not a line of text. */
static size_t take_string(const char *from, size_t length, char to[TEXT_NAME_MAX + 1])
{
    size_t n = strnlen(from, length);
    if (n == 0 || n == length || n > TEXT_NAME_MAX) return 0;
    memcpy(to, from, n + 1);
    return text_is_line(to) ? n + 1 : 0;
}

static bool check_note(elf_file *file, elf_probe *probe, elf_check *check)
{
    elf_span note = elf_file_find_note(file, IMP_NOTE_OWNER, IMP_NOTE_TYPE);
    if (note.length == 0)
        return answer(check, false,
                      "has no Impinge note: it is not a plugin, or was built without the macro "
                      "IMPINGE_PLUGIN, or the linker dropped .note.impinge");
    char bytes[NOTE_SIZE];
    size_t length = note.length < NOTE_SIZE ? (size_t)note.length : NOTE_SIZE;
    if (length < NOTE_HEAD || !elf_file_read(file, note.offset, bytes, length))
        return answer(check, false, "its Impinge note has %zu bytes, needed are %u; " CUT_SHORT,
                      length, NOTE_HEAD);
    memcpy(&probe->abi_major, bytes, 4);
    memcpy(&probe->abi_minor, bytes + 4, 4);
    size_t name = take_string(bytes + NOTE_HEAD, length - NOTE_HEAD, probe->name);
    size_t used = NOTE_HEAD + name;
    if (name == 0 || take_string(bytes + used, length - used, probe->version) == 0)
        return answer(check, false,
                      "its Impinge note has no legal %s: 1 to %d bytes of text, "
                      "NUL-terminated",
                      name == 0 ? "name" : "version", TEXT_NAME_MAX);
    return answer(check, true, "%s %s", probe->name, probe->version);
}

bool elf_probe_abi_fits(uint32_t major, uint32_t minor, char *text, size_t size)
{
    if (major != IMP_ABI_MAJOR) {
        snprintf(text, size,
                 "abi_major is %u, the host's is %u; rebuild the plugin with the "
                 "headers of this host%s",
                 major, IMP_ABI_MAJOR, major > IMP_ABI_MAJOR ? ", or use a newer host" : "");
        return false;
    }
    if (minor > IMP_ABI_MINOR) {
        snprintf(text, size,
                 "abi_minor is %u, the host's is %u and may not be less; use a newer "
                 "host, or rebuild the plugin with -DIMP_ABI_MINOR_TARGET=%u",
                 minor, IMP_ABI_MINOR, IMP_ABI_MINOR);
        return false;
    }
    snprintf(text, size, "%u.%u, the host speaks %u.%u", major, minor, IMP_ABI_MAJOR,
             IMP_ABI_MINOR);
    return true;
}

static bool check_abi(elf_file *file, elf_probe *probe, elf_check *check)
{
    (void)file;
    return elf_probe_abi_fits(probe->abi_major, probe->abi_minor, check->text, sizeof check->text);
}

/* --- Running them ----------------------------------------------------------------------------- */

typedef struct check_row {
    const char *name;
    elf_check_id needs; /* the last check it builds upon; itself: none */
    bool (*run)(elf_file *file, elf_probe *probe, elf_check *check);
} check_row;

static const check_row check_rows[PROBE_CHECKS] = {
    [PROBE_FILE] = {"file", PROBE_FILE, check_file},
    [PROBE_FORMAT] = {"format", PROBE_FILE, check_format},
    [PROBE_CLASS] = {"class", PROBE_FORMAT, check_class},
    [PROBE_MACHINE] = {"machine", PROBE_CLASS, check_machine},
    [PROBE_KIND] = {"kind", PROBE_CLASS, check_kind},
    [PROBE_HEADERS] = {"headers", PROBE_CLASS, check_headers},
    [PROBE_SEGMENTS] = {"segments", PROBE_HEADERS, check_segments},
    [PROBE_TABLES] = {"tables", PROBE_SEGMENTS, check_tables},
    [PROBE_NOTE] = {"note", PROBE_HEADERS, check_note},
    [PROBE_ABI] = {"abi", PROBE_NOTE, check_abi},
};

static bool is_reached(const elf_probe *probe, elf_check_id id)
{
    elf_check_id needs = check_rows[id].needs;
    return needs == id || probe->check[needs].verdict == PROBE_PASSED;
}

static bool run_checks(elf_file *file, bool all, elf_probe *probe)
{
    bool passed = true;
    for (elf_check_id id = 0; id < PROBE_CHECKS && (passed || all); ++id) {
        elf_check *check = &probe->check[id];
        if (!is_reached(probe, id)) continue;
        bool good = check_rows[id].run(file, probe, check);
        check->verdict = good ? PROBE_PASSED : PROBE_REFUSED;
        passed = passed && good;
    }
    return passed;
}

static bool probe_file(const char *path, bool all, elf_probe *probe)
{
    for (int id = 0; id < PROBE_CHECKS; ++id) probe->check[id].name = check_rows[id].name;
    elf_file file = {.fd = open_file(path)};
    bool passed = run_checks(&file, all, probe);
    probe->lacks_memory = file.lacks_memory;
    if (file.fd >= 0) close(file.fd);
    return passed;
}

bool elf_probe_file(const char *path, bool all, elf_probe *probe)
{
    *probe = (elf_probe){.is_tried = false};
    return probe_file(path, all, probe);
}

bool elf_probe_tried(const char *path, elf_probe *probe)
{
    *probe = (elf_probe){.is_tried = true};
    return probe_file(path, false, probe);
}

const elf_check *elf_probe_refusal(const elf_probe *probe)
{
    for (int id = 0; id < PROBE_CHECKS; ++id)
        if (probe->check[id].verdict == PROBE_REFUSED) return &probe->check[id];
    return NULL;
}
