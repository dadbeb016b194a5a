/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/environment.h"

#include <errno.h>
#include <fenv.h>
#include <inttypes.h>
#include <limits.h>
#include <locale.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/common/clock.h"
#include "core/common/fp_control.h"
#include "tools/check/calls.h"

/* --- What is compared ------------------------------------------------------------------------- */

typedef struct environment {
    int error, rounding;
    fp_mode mode;
    off_t printed; /* bytes on standard output */
    char folder[PATH_MAX];
    mode_t mask;
    sigset_t blocked;
    locale_t locale;   /* of the thread */
    char locales[400]; /* of the process */
    long threads;
} environment;

/* A folder of /proc has two links and one for each folder in it. */
static long count_threads(void)
{
    struct stat facts;
    return stat("/proc/self/task", &facts) == 0 ? (long)facts.st_nlink - 2 : 0;
}

static environment read_environment(int output)
{
    environment e = {.error = errno, .rounding = fegetround(), .mode = fp_mode_read()};
    e.printed = lseek(output, 0, SEEK_CUR);
    if (getcwd(e.folder, sizeof e.folder) == NULL) e.folder[0] = '\0';
    e.mask = umask(0);
    umask(e.mask);
    pthread_sigmask(SIG_BLOCK, NULL, &e.blocked);
    e.locale = uselocale((locale_t)0);
    snprintf(e.locales, sizeof e.locales, "%s", setlocale(LC_ALL, NULL));
    e.threads = count_threads();
    return e;
}

static int first_difference(const sigset_t *a, const sigset_t *b)
{
    for (int number = 1; number < NSIG; ++number)
        if (sigismember(a, number) != sigismember(b, number)) return number;
    return 0;
}

/* A thread that was joined may be listed for a moment longer. */
static bool threads_end(long before)
{
    const double deadline = clock_seconds() + 5;
    while (count_threads() > before) {
        if (clock_seconds() > deadline) return false;
        poll(NULL, 0, 1);
    }
    return true;
}

static bool arithmetic_is_kept(check_answer *answer, const environment *before,
                               const environment *now, const char *call)
{
    if (now->rounding != before->rounding)
        return answer_fail(answer, "%s changes the rounding mode", call);
    if (now->mode != before->mode)
        return answer_fail(
            answer,
            "%s changes how subnormal numbers are treated, which exceptions trap, or "
            "the precision of the x87 unit (control words %#" PRIx64 ", before %#" PRIx64 ")",
            call, now->mode, before->mode);
    if (now->error != before->error)
        return answer_fail(answer, "%s sets errno to %d", call, now->error);
    return true;
}

static bool process_is_kept(check_answer *answer, const environment *before, const environment *now,
                            const char *call)
{
    const int number = first_difference(&before->blocked, &now->blocked);
    if (now->printed != before->printed)
        return answer_fail(
            answer,
            "%s writes to standard output, which belongs to the host: return texts in "
            "imp_create_error",
            call);
    if (strcmp(now->folder, before->folder) != 0)
        return answer_fail(answer, "%s changes the working directory to '%.200s'", call,
                           now->folder);
    if (now->mask != before->mask)
        return answer_fail(answer, "%s changes the umask to %03o, before %03o", call,
                           (unsigned)now->mask, (unsigned)before->mask);
    if (number != 0)
        return answer_fail(answer, "%s changes the signal mask: signal %d (%s) is %s", call, number,
                           strsignal(number),
                           sigismember(&now->blocked, number) ? "blocked" : "no longer blocked");
    if (strcmp(now->locales, before->locales) != 0 || now->locale != before->locale)
        return answer_fail(answer, "%s changes the locale, which belongs to the host", call);
    if (now->threads > before->threads && !threads_end(before->threads))
        return answer_fail(answer,
                           "%s leaves a thread behind, which may run after the plugin is "
                           "unloaded; join it",
                           call);
    return true;
}

typedef struct watch {
    check_answer *answer;
    environment before;
    int output;
} watch;

/* Numbers of the message are written in the mode that was before. */
static bool is_kept(const watch *w, const char *call)
{
    const environment now = read_environment(w->output);
    fp_mode_kept(w->before.mode);
    ++w->answer->tests;
    return arithmetic_is_kept(w->answer, &w->before, &now, call) &&
           process_is_kept(w->answer, &w->before, &now, call);
}

/* --- Calls ------------------------------------------------------------------------------------ */

enum { ROUNDS = 96 };

static bool calls_keep(const watch *w, const subject *s)
{
    uint64_t random = draw_stream(1, "environment", "");
    for (int k = 0; k < ROUNDS; ++k)
        for (size_t which = 0; which < PURE_CALLS; ++which) {
            errno = w->before.error;
            pure_call(s, which, &random);
            if (!is_kept(w, pure_call_name(s, which))) return false;
        }
    return true;
}

/* The host itself sets errno on the way to create, and back from destroy. */
static bool host_keeps(const watch *w, const char *call)
{
    errno = w->before.error;
    return is_kept(w, call);
}

static void check_life(watch *w, imp_registry *registry, const imp_type_info *type,
                       const char *stage)
{
    imp_instance made;
    imp_error error;
    subject s;
    errno = 0;
    w->before = read_environment(w->output);
    if (subject_create(registry, type->kind, stage, &made, &error, w->answer) != IMP_SUCCESS) {
        answer_fail(w->answer, "'%.300s' does not work: %s", stage, error.text);
        return;
    }
    bool kept = host_keeps(w, "create");
    errno = w->before.error;
    kept = kept && subject_make(&s, &made, &made, 0, w->answer);
    kept = kept && is_kept(w, made.surface != NULL ? "domain" : "time_domain");
    kept = kept && calls_keep(w, &s);
    subject_destroy(&made, stage, w->answer);
    if (kept) host_keeps(w, "destroy");
}

/* Standard output becomes a file in memory, as a stream and as a descriptor: where that ends tells
 * whether anything was written. */
void environment_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                       check_answer *answer)
{
    watch w = {.answer = answer, .output = memfd_create("standard output", MFD_CLOEXEC)};
    FILE *stream = w.output >= 0 ? fdopen(w.output, "w") : NULL;
    const int before = dup(STDOUT_FILENO);
    if (stream == NULL || before < 0 || dup2(w.output, STDOUT_FILENO) < 0) {
        answer_skip(answer, "no file in memory could be made: %s", strerror(errno));
        return;
    }
    setvbuf(stream, NULL, _IONBF, 0);
    FILE *const usual = stdout;
    stdout = stream;
    check_life(&w, registry, type, stage);
    stdout = usual;
    dup2(before, STDOUT_FILENO);
    close(before);
    fclose(stream);
}
