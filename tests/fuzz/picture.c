/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_mutate.h"
#include "tools/cli/verbs.h"

#include <jansson.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* `impinge view` of whatever bytes: the first one chooses the format, the rest is a scene, or the
 * result of a search. The verb ends with a status of its own. Where it answers there is a file that
 * is whole, and no name of the scene has become markup; else there is none. */

const char fuzz_target[] = "picture";

FUZZ_MUTATE_TEXT

static const char *const formats[] = {"svg", "html", "obj", "vtu", "glb", "png"};
enum { FORMATS = sizeof formats / sizeof *formats }; /* '0' chooses the first */

typedef struct bytes {
    char *at; /* ends with 0 beyond its length; NULL: no such file */
    size_t length;
} bytes;

static bytes read_file(const char *path)
{
    bytes b = {NULL, 0};
    FILE *file = fopen(path, "rb");
    if (file == NULL) return b;
    FUZZ_REQUIRE(fseek(file, 0, SEEK_END) == 0);
    b.length = (size_t)ftell(file);
    b.at = calloc(b.length + 1, 1);
    rewind(file);
    FUZZ_REQUIRE(b.at != NULL && fread(b.at, 1, b.length, file) == b.length);
    fclose(file);
    return b;
}

static void write_file(const char *path, const unsigned char *at, size_t length)
{
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file != NULL && fwrite(at, 1, length, file) == length && fclose(file) == 0);
}

static size_t occurrences(const bytes *b, const char *word)
{
    size_t count = 0;
    for (const char *at = b->at; (at = strstr(at, word)) != NULL; at += strlen(word)) ++count;
    return count;
}

static bool ends_with(const bytes *b, const char *end, size_t length)
{
    return b->length >= length && memcmp(b->at + b->length - length, end, length) == 0;
}

/* Texts hold no 0. Scripts of a page are those that any page has. */
static void judge_text(const bytes *b, const char *format)
{
    static size_t scripts; /* of the first page */
    FUZZ_REQUIRE(strlen(b->at) == b->length);
    if (strcmp(format, "svg") == 0) {
        FUZZ_REQUIRE(ends_with(b, "</svg>\n", 7) && occurrences(b, "<svg") == 1);
        FUZZ_REQUIRE(occurrences(b, "<script") == 0 && occurrences(b, "]]>") == 0);
    }
    if (strcmp(format, "vtu") == 0) FUZZ_REQUIRE(ends_with(b, "</VTKFile>\n", 11));
    if (strcmp(format, "html") != 0) return;
    FUZZ_REQUIRE(ends_with(b, "</html>\n", 8));
    const size_t count = occurrences(b, "<script") + occurrences(b, "<!--");
    if (scripts == 0) scripts = count;
    FUZZ_REQUIRE(count == scripts && count > 0);
}

static size_t word_at(const char *at)
{
    const unsigned char *b = (const unsigned char *)at;
    return b[0] | (size_t)b[1] << 8 | (size_t)b[2] << 16 | (size_t)b[3] << 24;
}

static void judge_glb(const bytes *b)
{
    FUZZ_REQUIRE(b->length >= 20 && memcmp(b->at, "glTF", 4) == 0 &&
                 word_at(b->at + 8) == b->length);
    const size_t length = word_at(b->at + 12);
    FUZZ_REQUIRE(length <= b->length - 20);
    json_t *head = json_loadb(b->at + 20, length, 0, NULL);
    FUZZ_REQUIRE(head != NULL);
    json_decref(head);
}

static void judge(const bytes *b, const char *format)
{
    FUZZ_REQUIRE(b->at != NULL && b->length > 0);
    if (strcmp(format, "glb") == 0)
        judge_glb(b);
    else if (strcmp(format, "png") == 0)
        FUZZ_REQUIRE(ends_with(b, "IEND\xae\x42\x60\x82", 8));
    else
        judge_text(b, format);
}

/* The linker puts this in place of build_tree_data (--wrap), which looks for the command itself. */
const char *__wrap_build_tree_data(void);
const char *__wrap_build_tree_data(void)
{
    static char path[4096];
    fuzz_path(path, sizeof path, "top_builddir", "tools/built-data");
    return path;
}

static char folder[] = "/tmp/impinge-fuzz-picture-XXXXXX";

/* Types of the seeds: all types would be looked for and read again for each input. */
static const char *const types[] = {"formula", "plane",     "rotate",  "sphere",
                                    "torus",   "translate", "triangle"};
enum { TYPES = sizeof types / sizeof *types };

static void remove_folder(void)
{
    char path[128];
    for (int k = 0; k < TYPES; ++k) {
        snprintf(path, sizeof path, "%s/plugins/%s.so", folder, types[k]);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/plugins", folder);
    rmdir(path);
    rmdir(folder);
}

/* Makes the folder of this process, with links to plugins of the build. They stay loaded: libFuzzer
 * does not survive that their counters are unloaded with them. */
static void prepare(void)
{
    static imp_registry *kept;
    imp_type_info last;
    char from[4096], to[128], below[64];
    if (kept != NULL) return;
    FUZZ_REQUIRE(mkdtemp(folder) != NULL && atexit(remove_folder) == 0);
    snprintf(to, sizeof to, "%s/plugins", folder);
    FUZZ_REQUIRE(mkdir(to, 0700) == 0 && setenv("IMPINGE_PLUGIN_PATH", to, 1) == 0);
    for (int k = 0; k < TYPES; ++k) {
        snprintf(below, sizeof below, "plugins/.libs/%s.so", types[k]);
        fuzz_path(from, sizeof from, "top_builddir", below);
        snprintf(to, sizeof to, "%s/plugins/%s.so", folder, types[k]);
        FUZZ_REQUIRE(symlink(from, to) == 0);
    }
    kept = imp_registry_new(NULL);
    FUZZ_REQUIRE(kept != NULL && imp_registry_type(kept, TYPES - 1, &last));
}

static exit_status view(const char *scene, const char *picture)
{
    const char *const words[] = {"impinge", "view",        scene,  "-o",
                                 picture,   "--width",     "64",   "--height",
                                 "64",      "--frames",    "3",    "--max-pairs",
                                 "300",     "--max-bytes", "32M",  "--max-seconds",
                                 "5",       "--progress",  "none", NULL};
    arguments args;
    FUZZ_REQUIRE(arguments_read(&args, sizeof words / sizeof *words - 1, words) == EXIT_ANSWERED);
    const exit_status status = args.verb->run(&args);
    arguments_free(&args);
    return status;
}

int LLVMFuzzerTestOneInput(const unsigned char *input, size_t length)
{
    char scene[64], picture[64];
    if (length == 0) return 0;
    const char *format = formats[input[0] % FORMATS];
    prepare();
    snprintf(scene, sizeof scene, "%s/scene.json", folder);
    snprintf(picture, sizeof picture, "%s/picture.%s", folder, format);
    write_file(scene, input + 1, length - 1);
    const exit_status status = view(scene, picture);
    bytes made = read_file(picture);
    FUZZ_REQUIRE(status == EXIT_ANSWERED || status == EXIT_USAGE || status == EXIT_UNDECIDED ||
                 status == EXIT_DATA || status == EXIT_PLUGIN);
    if (status == EXIT_ANSWERED)
        judge(&made, format);
    else
        FUZZ_REQUIRE(made.at == NULL);
    free(made.at);
    remove(picture);
    remove(scene);
    return 0;
}
