/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <impinge/impinge.h>

#include "core/scene/scene.h"
#include "tests/support/alloc_failure.h"
#include "tests/support/built_plugins.h"
#include "tests/support/made_certificate.h"

/* Whatever allocation fails, what keeps or writes a certificate says so, and nothing leaks. */

#define ATTEMPTS 10000 /* more than any of these allocate: the loops end by themselves */

static imp_registry *registry;
static imp_error error;

static void open_registry(void) { registry = built_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

/* Blocks that live, but for those that the store of the registry keeps. NULL: it keeps none. */
static size_t live_blocks(const arena_store *store)
{
    return alloc_failure_live() - (store != NULL ? arena_store_count(store) : 0);
}

static void assert_nothing_left(const arena_store *store, size_t before, size_t n)
{
    const size_t live = live_blocks(store);
    ck_assert_msg(live == before, "failing allocation %zu leaves %zd blocks", n,
                  (ssize_t)(live - before));
}

/* The bytes of a certificate. */
typedef struct written {
    size_t size;
    uint8_t bytes[1 << 18];
} written;

static void put(void *context, const void *bytes, size_t size)
{
    written *w = context;
    const bool fits = w->size + size <= sizeof w->bytes; /* else it is no certificate */
    if (fits) memcpy(w->bytes + w->size, bytes, size);
    w->size += fits ? size : 0;
}

/* Requires that the certificate holds: it may be another than where nothing fails. */
static void require_holds(const written *w, size_t n)
{
    statement s;
    char fault[1400];
    bool assumes;
    const bool good = verify_bytes(w->bytes, w->size, 20000, &s, fault, &assumes);
    ck_assert_msg(good && !assumes, "failing allocation %zu: %s", n, fault);
    statement_free(&s);
}

/* Two boxes, of six pieces each, near which one turns: by time, or by a parameter. */
#define BOXES(PARAMETERS, CLOCK)                                                                   \
    "{" PARAMETERS "\"bodies\":[{\"surfaces\":[{\"type\":\"box\",\"size\":[2,1,1]}],\"maps\":["    \
    "{\"type\":\"rotate\",\"axis\":[1,2,3],\"rate\":1" CLOCK "}]},{\"surfaces\":[{\"type\":"       \
    "\"box\",\"size\":[1,1,1],\"center\":[0,0,2.2]}]}]}"

static const char moving[] = BOXES("", "");
static const char turned[] = BOXES("\"parameters\":{\"q\":[0,0.5]},", ",\"clock\":\"q\"");

static imp_scene *scene_of(const char *text)
{
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "s", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

typedef imp_code proving(imp_scene *scene, const imp_options *options, imp_verdict *verdict,
                         written *to);

static imp_code prove_query(imp_scene *scene, const imp_options *options, imp_verdict *verdict,
                            written *to)
{
    imp_query *query = imp_query_new(scene, options, &error);
    if (query == NULL) return error.code;
    imp_code code = imp_query_keep_proof(query, &error);
    if (code == IMP_SUCCESS) code = imp_query_step(query, 0, &error);
    if (code == IMP_SUCCESS) {
        *verdict = imp_query_result(query).verdict;
        code = imp_query_write_proof(query, NULL, put, to, &error);
    }
    imp_query_free(query);
    return code;
}

static imp_code prove_survey(imp_scene *scene, const imp_options *options, imp_verdict *verdict,
                             written *to)
{
    imp_result result = {.struct_size = (uint32_t)sizeof result};
    imp_survey *survey = imp_survey_new(scene, options, NULL, NULL, &error);
    if (survey == NULL) return error.code;
    imp_code code = imp_survey_keep_proof(survey, &error);
    if (code == IMP_SUCCESS) code = imp_survey_step(survey, 0, &error);
    if (code == IMP_SUCCESS) code = imp_survey_get_result(survey, &result, &error);
    if (code == IMP_SUCCESS) {
        *verdict = result.verdict;
        code = imp_survey_write_proof(survey, NULL, put, to, &error);
    }
    imp_survey_free(survey);
    return code;
}

/* A certificate that is written in spite of a failure holds. */
static void fail_proofs(const char *text, proving *prove)
{
    imp_scene *scene = scene_of(text);
    const arena_store *store = scene_store(scene);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-2;
    imp_verdict verdict = IMP_VERDICT_UNDECIDED;
    static written some;
    some.size = 0;
    ck_assert_msg(prove(scene, &options, &verdict, &some) == IMP_SUCCESS, "%s", error.text);
    require_holds(&some, 0);
    ck_assert_int_eq(verdict, IMP_VERDICT_CLEAR);
    imp_scene_free(scene);
    const size_t before = live_blocks(store);
    size_t n = 0, refused = 0;
    for (bool failed = true; failed && n < ATTEMPTS;) {
        some.size = 0;
        scene = scene_of(text);
        alloc_failure_begin(++n);
        const imp_code code = prove(scene, &options, &verdict, &some);
        failed = alloc_failure_end();
        ck_assert_msg(code == IMP_SUCCESS || (failed && code == IMP_ERROR_MEMORY),
                      "failing allocation %zu: %d: %s", n, (int)code, error.text);
        refused += code != IMP_SUCCESS;
        if (code == IMP_SUCCESS) require_holds(&some, n);
        imp_scene_free(scene);
        assert_nothing_left(store, before, n);
    }
    ck_assert_uint_gt(n, 50);
    ck_assert_uint_gt(refused, 10);
}

START_TEST(a_query_s_proof_is_whole_or_not_there) { fail_proofs(moving, prove_query); }
END_TEST

START_TEST(a_survey_s_proof_is_whole_or_not_there) { fail_proofs(turned, prove_survey); }
END_TEST

/* --- Files ------------------------------------------------------------------------------------ */

/* A scene that names a file, and what certificates say of its sources. */
static char *sources_of(const char *text, const char *lost)
{
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "s", &error);
    if (scene == NULL) return NULL;
    if (lost != NULL) ck_assert_int_eq(unlink(lost), 0);
    char *sources = imp_scene_sources(scene, &error);
    imp_scene_free(scene);
    return sources;
}

START_TEST(files_that_a_scene_names_are_listed_whatever_fails)
{
    char path[] = "/tmp/impinge.XXXXXX.obj", text[300], line[80];
    const int fd = mkstemps(path, 4);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(dprintf(fd, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), 32);
    close(fd);
    snprintf(text, sizeof text,
             "{\"bodies\":[{\"surfaces\":[{\"type\":\"mesh\",\"file\":\"%s\"},"
             "{\"type\":\"mesh\",\"file\":\"%s\",\"scale\":2}]}]}",
             path, path);
    char *whole = sources_of(text, NULL);
    ck_assert_ptr_nonnull(whole);
    const char *file = strstr(whole, "\nfile ");
    ck_assert(file != NULL && strstr(file + 1, "\nfile ") == NULL && strstr(file, path) != NULL);
    size_t before = alloc_failure_live(), n = 0;
    for (bool failed = true; failed && n < ATTEMPTS;) {
        /* Instances of a file are kept, and their blocks, once it has been as it is for seconds. */
        ck_assert_int_eq(utimensat(AT_FDCWD, path, NULL, 0), 0);
        alloc_failure_begin(++n);
        char *some = sources_of(text, NULL);
        failed = alloc_failure_end();
        if (some == NULL) ck_assert_int_eq(error.code, IMP_ERROR_MEMORY);
        ck_assert_msg(some == NULL ? failed : strcmp(some, whole) == 0, "failing allocation %zu",
                      n);
        free(some);
        if (some == NULL) assert_nothing_left(NULL, before, n);
    }
    ck_assert_uint_gt(n, 20);
    free(whole);
    whole = sources_of(text, path);
    snprintf(line, sizeof line, "\nfile - %s\n", path);
    ck_assert_msg(whole != NULL && strstr(whole, line) != NULL, "%s", whole);
    free(whole);
}
END_TEST

START_TEST(a_clearance_that_goes_on_proves_its_bracket_so_far)
{
    imp_scene *scene = scene_of(moving);
    const imp_options options = imp_options_default(scene);
    const imp_clearance_options asked = imp_clearance_options_default();
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    int proved = 0;
    ck_assert_int_eq(imp_query_keep_proof(query, &error), IMP_SUCCESS);
    while (imp_query_result(query).reason == IMP_REASON_RUNNING) {
        static written w;
        w.size = 0;
        ck_assert_int_eq(imp_query_step(query, 3, &error), IMP_SUCCESS);
        ck_assert_msg(imp_query_write_proof(query, NULL, put, &w, &error) == IMP_SUCCESS, "%s",
                      error.text);
        require_holds(&w, 0);
        proved += 1;
    }
    ck_assert_int_gt(proved, 3);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_query_s_proof_is_whole_or_not_there,
                                  a_survey_s_proof_is_whole_or_not_there,
                                  files_that_a_scene_names_are_listed_whatever_fails,
                                  a_clearance_that_goes_on_proves_its_bracket_so_far};
    return suite_main_with("proof_memory", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
