/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/file.h"

#include <dlfcn.h>
#include <elf.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <impinge/surface.h>

/* --- Exports ---------------------------------------------------------------------------------- */

/* The file in memory. Its offsets and sizes are checked against its length. */
typedef struct image {
    unsigned char *byte;
    size_t size;
} image;

static bool image_read(image *m, const char *file)
{
    struct stat facts;
    const int fd = open(file, O_RDONLY | O_CLOEXEC);
    *m = (image){NULL, 0};
    if (fd >= 0 && fstat(fd, &facts) == 0 && facts.st_size > 0) {
        m->byte = malloc((size_t)facts.st_size);
        while (m->byte != NULL && m->size < (size_t)facts.st_size) {
            const ssize_t got = read(fd, m->byte + m->size, (size_t)facts.st_size - m->size);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) break;
            m->size += (size_t)got;
        }
    }
    if (fd >= 0) close(fd);
    return m->byte != NULL;
}

/* Copies from the image, because its content may be unaligned. */
static bool image_get(const image *m, uint64_t offset, void *to, size_t size)
{
    if (offset > m->size || size > m->size - offset) return false;
    memcpy(to, m->byte + offset, size);
    return true;
}

static bool section(const image *m, const Elf64_Ehdr *head, uint64_t index, Elf64_Shdr *found)
{
    return index < head->e_shnum &&
           image_get(m, head->e_shoff + index * sizeof *found, found, sizeof *found);
}

/* Returns a name in a string table, NUL included, or NULL. */
static const char *name_at(const image *m, const Elf64_Shdr *strings, uint64_t offset)
{
    if (strings->sh_offset > m->size || strings->sh_size > m->size - strings->sh_offset)
        return NULL;
    if (offset >= strings->sh_size) return NULL;
    const char *name = (const char *)m->byte + strings->sh_offset + offset;
    return memchr(name, '\0', strings->sh_size - offset) != NULL ? name : NULL;
}

static bool is_exported(const Elf64_Sym *symbol)
{
    const unsigned bind = ELF64_ST_BIND(symbol->st_info);
    const unsigned visibility = ELF64_ST_VISIBILITY(symbol->st_other);
    return symbol->st_shndx != SHN_UNDEF && (bind == STB_GLOBAL || bind == STB_WEAK) &&
           (visibility == STV_DEFAULT || visibility == STV_PROTECTED);
}

/* A name with a dot cannot come from C source: compilers create such names, as sanitizers do for
 * impinge_plugin. */
static bool is_of_compiler(const char *name) { return strchr(name, '.') != NULL; }

static bool judge_symbols(const image *m, const Elf64_Shdr *table, const Elf64_Shdr *strings,
                          check_answer *answer)
{
    bool entry = false;
    for (uint64_t k = 0; k < table->sh_size / sizeof(Elf64_Sym); ++k) {
        Elf64_Sym symbol;
        if (!image_get(m, table->sh_offset + k * sizeof symbol, &symbol, sizeof symbol))
            return answer_fail(answer,
                               "the table of dynamic symbols reaches past the end of the file");
        const char *name = is_exported(&symbol) ? name_at(m, strings, symbol.st_name) : NULL;
        if (name == NULL || is_of_compiler(name)) continue;
        ++answer->tests;
        if (strcmp(name, "impinge_plugin") != 0)
            return answer_fail(answer,
                               "exports '%.200s' beside impinge_plugin; compile with "
                               "-fvisibility=hidden",
                               name);
        entry = true;
    }
    return entry || answer_fail(answer, "does not export impinge_plugin");
}

static void judge_image(const image *m, check_answer *answer)
{
    Elf64_Ehdr head;
    Elf64_Shdr table, strings;
    if (!image_get(m, 0, &head, sizeof head)) return;
    for (uint64_t k = 0; section(m, &head, k, &table); ++k) {
        if (table.sh_type != SHT_DYNSYM || !section(m, &head, table.sh_link, &strings)) continue;
        if (judge_symbols(m, &table, &strings, answer))
            answer_pass(answer, "impinge_plugin and nothing else");
        return;
    }
    answer_skip(answer, "the file has no section of dynamic symbols to read");
}

void exports_check(const char *file, check_answer *answer)
{
    image m;
    if (image_read(&m, file))
        judge_image(&m, answer);
    else
        answer_fail(answer, "cannot be read: %s", strerror(errno));
    free(m.byte);
}

/* --- How it was compiled ---------------------------------------------------------------------- */

void build_check(const char *file, check_answer *answer)
{
    void *handle = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    const imp_plugin *entry = handle != NULL ? dlsym(handle, "impinge_plugin") : NULL;
    if (entry == NULL) {
        answer_fail(answer, "cannot be loaded: %s", dlerror());
        return;
    }
    answer->call.name = "get_factory";
    const imp_build *build = entry->get_factory(IMP_BUILD_FACTORY);
    answer->call.name = NULL;
    ++answer->tests;
    if (build == NULL || build->struct_size < sizeof *build)
        answer_skip(answer, "the plugin does not say how it was compiled");
    else if (build->is_contracted)
        answer_note(answer,
                    "compiled so that a * b + c is rounded once: bounds written by hand that count "
                    "two roundings, or compare such sums, may fail; add -ffp-contract=off, as "
                    "`pkg-config --cflags impinge-sdk` does");
    else
        answer_pass(answer, "a * b + c is rounded twice, as written");
}

/* --- Factories -------------------------------------------------------------------------------- */

void factories_check(const char *file, check_answer *answer)
{
    static const char *const unknown[] = {"",
                                          "x",
                                          "impinge",
                                          "impinge.surface",
                                          "impinge.surface/",
                                          "impinge.surface/0",
                                          "impinge.surface/2",
                                          "impinge.surface/10",
                                          "impinge.map/11",
                                          "impinge.map/1 ",
                                          "IMPINGE.MAP/1",
                                          "impinge.volume/1"};
    const size_t count = sizeof unknown / sizeof *unknown;
    void *handle = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    const imp_plugin *entry = handle != NULL ? dlsym(handle, "impinge_plugin") : NULL;
    if (entry == NULL) {
        answer_fail(answer, "cannot be loaded: %s", dlerror());
        return;
    }
    answer->call.name = "get_factory";
    for (size_t k = 0; k < count; ++k) {
        ++answer->tests;
        if (entry->get_factory(unknown[k]) != NULL)
            answer_fail(answer, "get_factory returns a factory for \"%s\", which it cannot know",
                        unknown[k]);
    }
    answer->call.name = NULL;
    answer_pass(answer, "%zu unknown ids have no factory", count);
}
