/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/progress.h"

#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <unistd.h>

#include "core/common/clock.h"
#include "tools/cli/output.h"

/* Progress has no owner but the process: one line on its standard error. */
static double begun;
static progress_mode mode;
static atomic_bool shown;
static atomic_llong next_show; /* ns since the command began */
static struct {
    uint64_t before, total;
    double since; /* seconds */
    const char *noun;
    atomic_ullong done, reported;
} count;

void progress_begin(void) { begun = clock_seconds(); }

void progress_choose(progress_mode chosen) { mode = chosen; }

/* Asks the system once: counts of fast searches look a million times a second. */
static bool is_terminal(void)
{
    static atomic_int known; /* 1 or 2: no or yes */
    if (atomic_load(&known) == 0) atomic_store(&known, 1 + isatty(STDERR_FILENO));
    return atomic_load(&known) == 2;
}

bool progress_is_wanted(void)
{
    return mode == PROGRESS_JSON || (mode == PROGRESS_AUTO && is_terminal());
}

double progress_seconds(void) { return clock_seconds() - begun; }

/* Whether it is time to show something; true for only one of several threads that call it at
 * once. */
static bool is_due(double seconds)
{
    const double interval = mode == PROGRESS_JSON ? 0.5 : 0.1, first = 1;
    if ((mode == PROGRESS_AUTO && seconds < first) || !progress_is_wanted()) return false;
    const long long now = (long long)(1e9 * seconds);
    long long due = atomic_load(&next_show);
    return now >= due &&
           atomic_compare_exchange_strong(&next_show, &due, now + (long long)(1e9 * interval));
}

/* --- For people ------------------------------------------------------------------------------- */

enum { LINE = 80 }; /* a line that wraps could not be wiped */

static void show_line(double seconds, const char *text)
{
    atomic_store(&shown, true);
    fprintf(stderr, "\r%.0f s: %.68s\033[K", seconds, text);
}

void progress_show(const char *format, ...)
{
    char text[LINE];
    va_list list;
    const double seconds = progress_seconds();
    if (mode != PROGRESS_AUTO || !is_due(seconds)) return;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    show_line(seconds, text);
}

static void describe_search(char *text, size_t size, const imp_progress *p)
{
    const uintmax_t pairs = p->pairs, waiting = p->heap;
    if (!isnan(p->upper))
        snprintf(text, size, "%ju pairs, %ju wait, distance from %.6g to %.6g", pairs, waiting,
                 p->lower, p->upper);
    else if (isnan(p->t_lower))
        snprintf(text, size, "%ju pairs, %ju wait", pairs, waiting);
    else if (isnan(p->gap))
        snprintf(text, size, "%ju pairs, %ju wait, clear until t = %s", pairs, waiting,
                 output_number_lower(p->t_lower).text);
    else
        snprintf(text, size, "%ju pairs, %ju wait, clear until t = %s, gap %.3g", pairs, waiting,
                 output_number_lower(p->t_lower).text, p->gap);
}

/* --- For programs ----------------------------------------------------------------------------- */

/* Returns a JSON number, or null. */
static number_text json_number(double number)
{
    number_text n = {"null"};
    if (isfinite(number)) snprintf(n.text, sizeof n.text, "%.17g", number);
    return n;
}

static void print_search(double seconds, const imp_progress *p)
{
    fprintf(stderr,
            "{\"seconds\":%.3f,\"pairs\":%ju,\"heap\":%ju,\"t_lower\":%s,\"gap\":%s,\"lower\":%s,"
            "\"upper\":%s}\n",
            seconds, (uintmax_t)p->pairs, (uintmax_t)p->heap, json_number(p->t_lower).text,
            json_number(p->gap).text, json_number(p->lower).text, json_number(p->upper).text);
}

static void print_count(double seconds, uint64_t done, double rate, double left)
{
    const double total = count.total > 0 ? (double)count.total : NAN;
    atomic_store(&count.reported, done + 1);
    fprintf(stderr,
            "{\"seconds\":%.3f,\"of\":\"%s\",\"done\":%ju,\"total\":%s,\"rate\":%s,\"left\":%s}\n",
            seconds, count.noun, (uintmax_t)done, json_number(total).text, json_number(rate).text,
            json_number(left).text);
}

/* --- Either ----------------------------------------------------------------------------------- */

void progress_search(const imp_progress *p)
{
    char text[LINE];
    const double seconds = progress_seconds();
    if (count.noun != NULL || !is_due(seconds)) return;
    if (mode == PROGRESS_JSON) {
        print_search(seconds, p);
    } else {
        describe_search(text, sizeof text, p);
        show_line(seconds, text);
    }
}

static void show_count(double seconds, uint64_t done)
{
    char text[LINE];
    const uint64_t rest = count.total > done ? count.total - done : 0;
    const double rate = (double)(done - count.before) / (seconds - count.since);
    const double left = count.total > 0 ? (double)rest / rate : NAN;
    if (mode == PROGRESS_JSON) {
        print_count(seconds, done, rate, left);
        return;
    }
    if (count.total > 0)
        snprintf(text, sizeof text, "%ju of %ju %s, %.3g a second, %.0f s left", (uintmax_t)done,
                 (uintmax_t)count.total, count.noun, rate, left);
    else
        snprintf(text, sizeof text, "%ju %s, %.3g a second", (uintmax_t)done, count.noun, rate);
    show_line(seconds, text);
}

void progress_count_from(uint64_t done, uint64_t total, const char *noun)
{
    count.before = done;
    count.total = total;
    count.since = progress_seconds();
    count.noun = noun;
    progress_count(done);
}

void progress_count(uint64_t done)
{
    const double seconds = progress_seconds();
    atomic_store(&count.done, done);
    if (is_due(seconds)) show_count(seconds, done);
}

void progress_wipe(void)
{
    if (atomic_exchange(&shown, false)) fputs("\r\033[K", stderr);
}

void progress_end(void)
{
    const uint64_t done = atomic_load(&count.done);
    if (mode == PROGRESS_JSON && count.noun != NULL && atomic_load(&count.reported) != done + 1)
        show_count(progress_seconds(), done);
    progress_wipe();
}
