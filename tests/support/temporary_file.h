/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_TEMPORARY_FILE_H
#define TESTS_SUPPORT_TEMPORARY_FILE_H

#include <string.h>
#include <unistd.h>

#include "tests/support/query_helpers.h"

/* A registry, and a file of no content whose place is removed at a test's end. */
static imp_registry *registry;
static imp_error error;
static char path[] = "/tmp/impinge-test-XXXXXX";

static void temporary_file_begin(void)
{
    registry = query_registry();
    const int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    close(file);
}

static void temporary_file_end(void)
{
    unlink(path);
    memcpy(path + sizeof path - 7, "XXXXXX", 6);
    imp_registry_free(registry);
}

#endif
