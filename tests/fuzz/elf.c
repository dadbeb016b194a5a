/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_probe.h"
#include "core/plugin/registry.h"
#include "tests/fuzz/fuzz.h"

#include <string.h>
#include <unistd.h>

/* A plugin file with some of its bytes changed, beside a good one. It is refused or taken; if the
 * probe passes it, a registry of both still has the good one's type. The input is a list of changes,
 * five bytes each (offset, four bytes, lowest first; value), or, from 0x7f on, a whole file. */

const char fuzz_target[] = "elf";

typedef struct content {
    unsigned char *at;
    size_t length;
} content;

static content read_plugin(const char *name)
{
    char below[128], path[4096];
    snprintf(below, sizeof below, "plugins/.libs/%s.so", name);
    fuzz_path(path, sizeof path, "top_builddir", below);
    content c = {malloc(1 << 22), 0};
    FILE *file = fopen(path, "rb");
    if (file == NULL || c.at == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    c.length = fread(c.at, 1, 1 << 22, file);
    fclose(file);
    return c;
}

static void write_file(const char *folder, const char *name, content c)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file != NULL && fwrite(c.at, 1, c.length, file) == c.length);
    fclose(file);
}

static content changed(content plugin, const unsigned char *bytes, size_t length)
{
    content c = {malloc(plugin.length), plugin.length};
    FUZZ_REQUIRE(c.at != NULL);
    memcpy(c.at, plugin.at, plugin.length);
    for (size_t k = 0; k + 5 <= length; k += 5) {
        const size_t offset = bytes[k] | (size_t)bytes[k + 1] << 8 | (size_t)bytes[k + 2] << 16;
        c.at[offset % c.length] = bytes[k + 4];
    }
    return c;
}

static void scan(const char *folder)
{
    search_path path = {.count = 0};
    imp_registry *registry = search_path_add(&path, folder, false) ? registry_scan(&path, 0) : NULL;
    search_path_clear(&path);
    FUZZ_REQUIRE(registry != NULL && registry_find_surface(registry, "torus") != NULL);
    imp_registry_free(registry);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    static content plugin, neighbour;
    static char folder[] = "/tmp/impinge-fuzz-XXXXXX";
    static bool prepared;
    if (!prepared) {
        plugin = read_plugin("sphere"), neighbour = read_plugin("torus");
        prepared = mkdtemp(folder) != NULL;
        FUZZ_REQUIRE(prepared);
        setenv("XDG_CACHE_HOME", folder, 1);
    }
    const bool whole = length > 0 && bytes[0] >= 0x7f;
    const content c =
        whole ? (content){(unsigned char *)(size_t)bytes, length} : changed(plugin, bytes, length);
    char path[256], other[256];
    snprintf(path, sizeof path, "%s/a.so", folder);
    snprintf(other, sizeof other, "%s/b.so", folder);
    write_file(folder, "a.so", c);
    write_file(folder, "b.so", neighbour);
    elf_probe probe;
    const bool first = elf_probe_file(path, false, &probe);
    FUZZ_REQUIRE(first == (elf_probe_refusal(&probe) == NULL));
    FUZZ_REQUIRE(elf_probe_file(path, true, &probe) == first);
    if (first) scan(folder);
    unlink(path);
    unlink(other);
    if (!whole) free(c.at);
    return 0;
}
