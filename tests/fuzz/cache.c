/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/plugin/load_probe.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_mutate.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Whatever the user's cache of first loads holds, it is read; what was found in it, and what is
 * added, is found again after it was written back, and nothing of another file. The input is the
 * cache from its second line on, since one with another first line is not read; or, with a first
 * byte below 0x09, which is left out, all of it. */

const char fuzz_target[] = "cache";

FUZZ_MUTATE_TEXT

static char folder[] = "/tmp/impinge-fuzz-XXXXXX";

static void path_of(char path[300], const char *name)
{
    snprintf(path, 300, "%s/%s", folder, name);
}

static void remove_all(void)
{
    static const char *const left[] = {"impinge/trials", "impinge", "plugin.so", "other.so", ""};
    char path[300];
    for (size_t k = 0; k < sizeof left / sizeof *left; ++k) {
        path_of(path, left[k]);
        remove(path);
    }
}

static elf_probe probe_of(const char *path)
{
    elf_probe probe;
    elf_probe_file(path, false, &probe); /* refused: the files are empty, but known */
    return probe;
}

static void make_file(const char *name)
{
    char path[300];
    path_of(path, name);
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file != NULL);
    fclose(file);
}

/* The first line that the cache is written with. */
static void read_first_line(char *line, size_t size)
{
    char path[300];
    path_of(path, "plugin.so");
    const elf_probe probe = probe_of(path);
    load_cache *cache = load_cache_read();
    FUZZ_REQUIRE(cache != NULL && load_cache_add(cache, path, &probe, IMP_SUCCESS, ""));
    load_cache_close(cache);
    path_of(path, "impinge/trials");
    FILE *in = fopen(path, "rb");
    FUZZ_REQUIRE(in != NULL && fgets(line, (int)size, in) != NULL);
    fclose(in);
}

static const char *prepare(void)
{
    static char first_line[100];
    if (first_line[0] != '\0') return first_line;
    FUZZ_REQUIRE(mkdtemp(folder) != NULL);
    atexit(remove_all);
    setenv("XDG_CACHE_HOME", folder, 1);
    make_file("plugin.so");
    make_file("other.so");
    read_first_line(first_line, sizeof first_line);
    return first_line;
}

static void write_cache(const char *first_line, const unsigned char *bytes, size_t length)
{
    char path[300];
    path_of(path, "impinge/trials");
    const bool whole = length > 0 && bytes[0] < 9;
    FILE *out = fopen(path, "wb");
    FUZZ_REQUIRE(out != NULL);
    if (!whole) fputs(first_line, out);
    FUZZ_REQUIRE(fwrite(bytes + whole, 1, length - whole, out) == length - whole);
    FUZZ_REQUIRE(fclose(out) == 0);
}

typedef struct answer {
    bool known;
    imp_code code;
    char text[5000];
} answer;

static answer ask(const load_cache *cache, const char *path, const elf_probe *file)
{
    answer a = {.known = false};
    const char *text;
    a.known = load_cache_find(cache, path, file, &a.code, &text);
    if (!a.known) return a;
    FUZZ_REQUIRE(a.code == IMP_SUCCESS || a.code == IMP_ERROR_PLUGIN);
    FUZZ_REQUIRE(strchr(text, '\n') == NULL);
    snprintf(a.text, sizeof a.text, "%s", text);
    return a;
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    char path[300], other[300];
    write_cache(prepare(), bytes, length);
    path_of(path, "plugin.so");
    path_of(other, "other.so");
    const elf_probe file = probe_of(path), file_of_other = probe_of(other);
    load_cache *cache = load_cache_read();
    FUZZ_REQUIRE(cache != NULL);
    FUZZ_REQUIRE(!ask(cache, path, &file_of_other).known); /* the identity has the inode */
    const answer before = ask(cache, other, &file_of_other);
    /* a reason is any text that a check may have made of a plugin's strings */
    char reason[64];
    snprintf(reason, sizeof reason, "%.*s", (int)(length < 40 ? length : 40), (const char *)bytes);
    FUZZ_REQUIRE(load_cache_add(cache, path, &file, IMP_ERROR_PLUGIN, reason));
    load_cache_close(cache);

    cache = load_cache_read();
    FUZZ_REQUIRE(cache != NULL);
    const answer after = ask(cache, other, &file_of_other), added = ask(cache, path, &file);
    FUZZ_REQUIRE(added.known && added.code == IMP_ERROR_PLUGIN);
    for (char *c = reason; *c != '\0'; ++c)
        if (*c == '\n') *c = ' ';
    FUZZ_REQUIRE(strcmp(added.text, reason) == 0);
    FUZZ_REQUIRE(after.known == before.known);
    FUZZ_REQUIRE(!after.known ||
                 (after.code == before.code && strcmp(after.text, before.text) == 0));
    load_cache_close(cache);
    return 0;
}
