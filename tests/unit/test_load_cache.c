/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/load_probe.h"
#include "tests/support/sandbox.h"
#include "tests/support/suite.h"

/* The cache of first loads, in a folder of one's own. */

static sandbox box;

static void open_box(void)
{
    box = sandbox_new();
    setenv("XDG_CACHE_HOME", box.path, 1);
}

static void close_box(void)
{
    remove(sandbox_file(&box, "impinge/trials").at);
    remove(sandbox_file(&box, "impinge").at);
    sandbox_remove(&box);
}

/* A file that does not exist. */
static sandbox_path numbered(int k)
{
    char name[20];
    snprintf(name, sizeof name, "%d.so", k);
    return sandbox_file(&box, name);
}

static elf_probe identity_of(uint64_t inode)
{
    return (elf_probe){.file = {.device = 1, .inode = inode, .size = 3}};
}

static load_cache *read_cache(void)
{
    load_cache *cache = load_cache_read();
    ck_assert_ptr_nonnull(cache);
    return cache;
}

static void add(load_cache *cache, const char *path, uint64_t inode, imp_code code,
                const char *text)
{
    const elf_probe file = identity_of(inode);
    ck_assert(load_cache_add(cache, path, &file, code, text));
}

static bool finds(const load_cache *cache, const char *path, uint64_t inode, const char *expected)
{
    const elf_probe file = identity_of(inode);
    imp_code code;
    const char *text;
    if (!load_cache_find(cache, path, &file, &code, &text)) return false;
    ck_assert_int_eq(code, expected[0] != '\0' ? IMP_ERROR_PLUGIN : IMP_SUCCESS);
    ck_assert_str_eq(text, expected);
    return true;
}

START_TEST(what_is_known_of_a_path_is_replaced)
{
    load_cache *cache = read_cache();
    add(cache, "/bin/sh", 7, IMP_ERROR_PLUGIN, "loading it crashes:\nsignal 11");
    ck_assert(finds(cache, "/bin/sh", 7, "loading it crashes: signal 11"));
    add(cache, "/bin/sh", 8, IMP_SUCCESS, "");
    ck_assert(!finds(cache, "/bin/sh", 7, ""));
    load_cache_close(cache);
    cache = read_cache();
    ck_assert(finds(cache, "/bin/sh", 8, ""));
    ck_assert(!finds(cache, "/bin/sh", 7, ""));
    load_cache_close(cache);
}
END_TEST

START_TEST(the_oldest_of_more_than_4096_are_forgotten)
{
    load_cache *cache = read_cache();
    for (int k = 0; k < 4098; ++k) add(cache, numbered(k).at, (uint64_t)k, IMP_SUCCESS, "");
    ck_assert(!finds(cache, numbered(0).at, 0, "") && !finds(cache, numbered(1).at, 1, ""));
    ck_assert(finds(cache, numbered(2).at, 2, "") && finds(cache, numbered(4097).at, 4097, ""));
    load_cache_close(cache);
}
END_TEST

START_TEST(what_has_gone_is_forgotten_when_the_cache_is_written)
{
    load_cache *cache = read_cache();
    add(cache, "/bin/sh", 1, IMP_SUCCESS, "");
    add(cache, numbered(0).at, 2, IMP_SUCCESS, "");
    load_cache_close(cache);
    cache = read_cache();
    ck_assert(finds(cache, "/bin/sh", 1, "") && !finds(cache, numbered(0).at, 2, ""));
    load_cache_close(cache);
}
END_TEST

START_TEST(a_path_that_would_break_a_line_is_tried_every_time)
{
    load_cache *cache = read_cache();
    add(cache, "/tmp/a\nb", 1, IMP_SUCCESS, "");
    add(cache, "/tmp/a\tb", 1, IMP_SUCCESS, "");
    ck_assert(!finds(cache, "/tmp/a\nb", 1, "") && !finds(cache, "/tmp/a\tb", 1, ""));
    load_cache_close(cache);
}
END_TEST

START_TEST(a_cache_that_is_no_regular_file_is_not_read)
{
    ck_assert_int_eq(mkdir(sandbox_file(&box, "impinge").at, 0700), 0);
    ck_assert_int_eq(mkfifo(sandbox_file(&box, "impinge/trials").at, 0600), 0);
    load_cache *cache = read_cache(); /* does not block */
    ck_assert(!finds(cache, "/bin/sh", 1, ""));
    add(cache, "/bin/sh", 1, IMP_SUCCESS, "");
    load_cache_close(cache);
    cache = read_cache();
    ck_assert(finds(cache, "/bin/sh", 1, ""));
    load_cache_close(cache);
}
END_TEST

START_TEST(without_a_folder_of_caches_it_is_below_home_and_without_home_nowhere)
{
    unsetenv("XDG_CACHE_HOME");
    setenv("HOME", box.path, 1);
    load_cache *cache = read_cache();
    add(cache, "/bin/sh", 1, IMP_SUCCESS, "");
    load_cache_close(cache);
    const char *const made[] = {".cache/impinge/trials", ".cache/impinge", ".cache"};
    for (size_t k = 0; k < sizeof made / sizeof *made; ++k)
        ck_assert_int_eq(remove(sandbox_file(&box, made[k]).at), 0);
    unsetenv("HOME");
    cache = read_cache();
    add(cache, "/bin/sh", 1, IMP_SUCCESS, "");
    load_cache_close(cache);
    cache = read_cache();
    ck_assert(!finds(cache, "/bin/sh", 1, ""));
    load_cache_close(cache);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        what_is_known_of_a_path_is_replaced,
        the_oldest_of_more_than_4096_are_forgotten,
        what_has_gone_is_forgotten_when_the_cache_is_written,
        a_path_that_would_break_a_line_is_tried_every_time,
        a_cache_that_is_no_regular_file_is_not_read,
        without_a_folder_of_caches_it_is_below_home_and_without_home_nowhere,
    };
    return suite_main_with("load_cache", tests, sizeof tests / sizeof *tests, open_box, close_box);
}
