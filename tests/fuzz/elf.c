/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/plugin/elf_probe.h"
#include "core/plugin/registry.h"
#include "tests/fuzz/elf_changes.h"
#include "tests/fuzz/fuzz.h"

#include <dlfcn.h>
#include <pthread.h>
#include <string.h>
#include <unistd.h>

#include <impinge/examine.h>

/* Plugin files with some of their fields changed, before and behind a good one in one folder. Each
 * is refused with a reason or taken, by all that read it alike; a registry of the folder still has
 * the good one's type, and the host is alive. The input is a list of changes (elf_changes.h), or,
 * from 0x7f on, the first file itself. */

const char fuzz_target[] = "elf";

static const char *const names[] = {"a.so", "c.so", "b.so"};
enum { GOOD = CHANGED_FILES }; /* its index in names */

static char folder[] = "/tmp/impinge-fuzz-XXXXXX";

static void path_of(char path[256], const char *name)
{
    snprintf(path, 256, "%s/%s", folder, name);
}

/* Plugins without the instrumentation of a search, which they do not survive being unloaded
 * with. */
static elf_image read_plugin(const char *name)
{
    char below[128], path[4096];
    const char *plain = getenv("IMPINGE_FUZZ_PLUGINS");
    snprintf(below, sizeof below, "plugins/.libs/%s.so", name);
    fuzz_path(path, sizeof path, "top_builddir", below);
    if (plain != NULL) snprintf(path, sizeof path, "%s/%s.so", plain, name);
    elf_image image = {malloc(1 << 22), 0};
    FILE *file = fopen(path, "rb");
    if (file == NULL || image.at == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    image.length = fread(image.at, 1, 1 << 22, file);
    fclose(file);
    return image;
}

static void write_file(const char *name, elf_image image)
{
    char path[256];
    path_of(path, name);
    unlink(path); /* a new file: an old one may still be mapped */
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file != NULL && fwrite(image.at, 1, image.length, file) == image.length);
    fclose(file);
}

static void remove_all(void)
{
    char path[256];
    static const char *const left[] = {"a.so", "c.so", "b.so", "impinge/trials", "impinge", ""};
    for (size_t k = 0; k < sizeof left / sizeof *left; ++k) {
        path_of(path, left[k]);
        remove(path);
    }
}

/* In a search, what a sanitizer finds in a child, which loads what is damaged, is no finding. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define HAS_DEATH_CALLBACK
#endif
#endif
#ifdef HAS_DEATH_CALLBACK
void __sanitizer_set_death_callback(void (*callback)(void));
static void forget_callback(void) { __sanitizer_set_death_callback(NULL); }
static void prepare_children(void) { pthread_atfork(NULL, NULL, forget_callback); }
#else
static void prepare_children(void) {}
#endif

/* What a damaged file allocates while it is loaded or unloaded is not the host's to free; so
 * LeakSanitizer, where there is one, looks away. */
void __lsan_disable(void) __attribute__((weak));
void __lsan_enable(void) __attribute__((weak));
static void allow_leaks(bool allow)
{
    void (*change)(void) = allow ? __lsan_disable : __lsan_enable;
    if (change != NULL) change();
}

/* A file whose handle is lost asks for the exit handlers of the whole program when it is unloaded.
 * The command then ends and names the file; a search goes on. */
__attribute__((visibility("default"))) void __cxa_finalize(void *handle);
void __cxa_finalize(void *handle)
{
    void (*finalize)(void *);
    *(void **)&finalize = dlsym(RTLD_NEXT, "__cxa_finalize");
    if (handle != NULL && finalize != NULL) finalize(handle);
}

/* The unchanged files: two of a kind, and the good one of another. */
static const elf_image *prepare(void)
{
    static elf_image images[GOOD + 1];
    if (images[GOOD].at != NULL) return images;
    images[0] = images[1] = read_plugin("sphere");
    images[GOOD] = read_plugin("torus");
    FUZZ_REQUIRE(mkdtemp(folder) != NULL);
    atexit(remove_all);
    prepare_children();
    setenv("XDG_CACHE_HOME", folder, 1);
    write_file(names[GOOD], images[GOOD]);
    return images;
}

static void hear(void *context, const char *check, imp_finding finding, const char *text)
{
    bool *refused = context;
    FUZZ_REQUIRE(text_is_line(check));
    if (finding == IMP_FINDING_NOT_REACHED) return;
    FUZZ_REQUIRE(text_is_line(text) && text[0] != '\0');
    *refused = *refused || finding == IMP_FINDING_REFUSED;
}

/* Whether the probe passes it: the same with all checks and up to the first refusal. */
static bool probe(const char *name)
{
    char path[256];
    elf_probe facts;
    path_of(path, name);
    const bool passed = elf_probe_file(path, false, &facts);
    FUZZ_REQUIRE(passed == (elf_probe_refusal(&facts) == NULL));
    FUZZ_REQUIRE(elf_probe_file(path, true, &facts) == passed);
    bool refused = false;
    if (!passed) FUZZ_REQUIRE(!imp_plugin_examine(path, hear, &refused) && refused);
    return passed;
}

/* The registry of the folder, twice: what was remembered makes no difference. */
static void scan(void)
{
    size_t found[2] = {0, 0};
    for (int k = 0; k < 2; ++k) {
        search_path path = {.count = 0};
        imp_registry *r = search_path_add(&path, folder, false) ? registry_scan(&path, 0) : NULL;
        search_path_clear(&path);
        FUZZ_REQUIRE(r != NULL && registry_find_surface(r, "torus") != NULL);
        imp_type_info info;
        while (imp_registry_type(r, found[k], &info)) {
            FUZZ_REQUIRE(text_is_name(info.name, "_-") && text_is_line(info.summary));
            ++found[k];
        }
        imp_plugin_refusal refusal;
        for (size_t i = 0; imp_registry_refusal(r, i, &refusal); ++i)
            FUZZ_REQUIRE(text_is_line(refusal.reason) && refusal.reason[0] != '\0');
        imp_registry_free(r);
    }
    FUZZ_REQUIRE(found[0] == found[1]);
}

#ifdef IMP_FUZZ_SEARCH
size_t LLVMFuzzerCustomMutator(unsigned char *bytes, size_t length, size_t max_length,
                               unsigned seed);
size_t LLVMFuzzerCustomMutator(unsigned char *bytes, size_t length, size_t max_length,
                               unsigned seed)
{
    return elf_mutate(bytes, length, max_length, seed);
}
#endif

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    const elf_image *original = prepare();
    const bool whole = length > 0 && bytes[0] >= 0x7f;
    bool passed = false;
    for (unsigned file = 0; file < CHANGED_FILES; ++file) {
        elf_image image =
            whole && file == 0
                ? elf_changed((elf_image){(unsigned char *)(size_t)bytes, length}, 0, NULL, 0)
                : elf_changed(original[file], file, bytes, whole ? 0 : length);
        write_file(names[file], image);
        free(image.at);
        passed = probe(names[file]) || passed;
    }
    allow_leaks(true);
    if (passed) scan();
    allow_leaks(false);
    return 0;
}
