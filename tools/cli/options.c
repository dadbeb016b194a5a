/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/spelling.h"
#include "tools/cli/options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const option options_always[] = {
    {.name = "help", .help = "print this help"},
    {.name = "version", .help = "print the version"},
    {.name = "no-color", .help = "print without colours, as where there is no terminal"},
    {.name = NULL},
};

const option options_registry[] = {
    {.name = "json", .help = "print one JSON object on one line"},
    {.name = "plugin-path",
     .kind = OPTION_TEXT,
     .argument = "DIR[:DIR]",
     .help = "look for plugins here before anywhere else"},
    {.name = "isolate",
     .kind = OPTION_TEXT,
     .argument = "TYPE[,TYPE]",
     .help = "run these types in processes of their own; all: every type"},
    {.name = "secure", .help = "refuse plugins that others could change or replace"},
    {.name = NULL},
};

static const char *const methods[] = {"models", "paper", NULL};
static const char *const bounds[] = {"box", "sphere", NULL};
static const char *const rates[] = {"full", "column", "constant", NULL};

static const char *const progress[] = {"auto", "json", "none", NULL}; /* progress_mode */

const option options_search[] = {
    {.name = "time",
     .kind = OPTION_INTERVAL,
     .argument = "T0,T1",
     .help = "the interval to search (the span that the tables share, else 0,1)"},
    {.name = "gamma",
     .kind = OPTION_NUMBER,
     .argument = "LENGTH",
     .min_open = true,
     .help = "a contact's two points are at most this far apart (1e-6)"},
    {.name = "max-pairs",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "test at most N pairs of regions (K, M, G: thousands); 0: no limit (0)"},
    {.name = "max-seconds",
     .kind = OPTION_NUMBER,
     .argument = "S",
     .help = "read and search at most S seconds; 0: no limit (0)"},
    {.name = "max-bytes",
     .kind = OPTION_BYTES,
     .argument = "N",
     .help = "use at most N bytes (K, M, G: times 1024); 0: no limit (1G)"},
    {.name = "progress",
     .kind = OPTION_CHOICE,
     .argument = "HOW",
     .choices = progress,
     .help = "report progress on standard error: auto (terminals only), json, none"},
    {.name = "audit", .help = "hold the bounds of every region against points of it; slower"},
    {.name = NULL},
};

const option options_query[] = {
    {.name = "gamma-clear",
     .kind = OPTION_NUMBER,
     .argument = "LENGTH",
     .help = "nothing nearer than this is ever missed; less than gamma (gamma/2)"},
    {.name = "method",
     .kind = OPTION_CHOICE,
     .argument = "NAME",
     .choices = methods,
     .help = "models (default), or the 1990 paper's algorithm"},
    {.name = "bounds",
     .kind = OPTION_CHOICE,
     .argument = "SHAPE",
     .choices = bounds,
     .help = "with --method paper: bounding volumes (box)"},
    {.name = "rates",
     .kind = OPTION_CHOICE,
     .argument = "FORM",
     .choices = rates,
     .help = "with --method paper: rate bounds (full)"},
    {.name = "exit-code", .help = "exit 1 on contact, 0 on clear"},
    {.name = NULL},
};

const option options_explain[] = {
    {.name = "explain",
     .help = "tell where the pairs went, by surface and by what held them together"},
    {.name = NULL},
};

const option *option_find(const option *const *tables, const char *name, size_t length)
{
    for (; *tables != NULL; ++tables)
        for (const option *row = *tables; row->name != NULL; ++row)
            if (strlen(row->name) == length && memcmp(row->name, name, length) == 0) return row;
    return NULL;
}

/* Reads a finite number that starts at `text`; *end points past it. strtod also accepts "inf",
 * "nan" and hexadecimal: the first two are refused here, the last is harmless. */
static bool read_number(const char *text, char **end, double *number)
{
    if (*text == '\0' || strchr(" \t\n\v\f\r", *text) != NULL) return false;
    *number = strtod(text, end);
    return *end != text && isfinite(*number);
}

static bool read_bounded(const option *row, const char *text, double *number)
{
    char *end;
    if (!read_number(text, &end, number) || *end != '\0') return false;
    return row->min_open ? *number > row->min : *number >= row->min;
}

static bool read_two(const char *text, double number[2])
{
    char *end;
    if (!read_number(text, &end, &number[0]) || *end != ',') return false;
    return read_number(end + 1, &end, &number[1]) && *end == '\0';
}

/* Reads a whole number with an optional suffix; `unit` is the value of K. Refuses numbers that are
 * too large. */
static bool read_count(const char *text, uint64_t unit, uint64_t *count)
{
    char *end;
    if (*text < '0' || *text > '9') return false;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (errno != 0) return false;
    const char *suffix = *end != '\0' ? strchr("KMG", *end) : NULL;
    if (*end != '\0' && (suffix == NULL || end[1] != '\0')) return false;
    for (int power = suffix != NULL ? (int)(suffix - "KMG") + 1 : 0; power > 0; --power) {
        if (value > UINT64_MAX / unit) return false;
        value *= unit;
    }
    *count = value;
    return true;
}

static exit_status read_choice(const option *row, const char *text, const char *verb,
                               size_t *choice)
{
    spelling_search near = {.wanted = text};
    char allowed[256] = "";
    for (size_t i = 0; row->choices[i] != NULL; ++i) {
        *choice = i;
        if (strcmp(row->choices[i], text) == 0) return EXIT_ANSWERED;
        spelling_offer(&near, row->choices[i]);
        if (i > 0) strncat(allowed, ", ", sizeof allowed - strlen(allowed) - 1);
        strncat(allowed, row->choices[i], sizeof allowed - strlen(allowed) - 1);
    }
    if (near.best != NULL)
        return complain(EXIT_USAGE, verb, "--%s must be one of %s, not '%s'; did you mean '%s'?",
                        row->name, allowed, text, near.best);
    return complain(EXIT_USAGE, verb, "--%s must be one of %s, not '%s'", row->name, allowed, text);
}

static exit_status read_interval(const option *row, const char *text, const char *verb,
                                 double number[2])
{
    if (!read_two(text, number))
        return complain(EXIT_USAGE, verb,
                        "--%s must be two finite numbers, START,END, such as 0,1, not '%s'",
                        row->name, text);
    if (!(number[0] <= number[1]))
        return complain(EXIT_USAGE, verb, "--%s %s is an empty interval: START must not exceed END",
                        row->name, text);
    return EXIT_ANSWERED;
}

static exit_status read_range(const option *row, const char *text, const char *verb,
                              double number[2])
{
    const char *equals = strchr(text, '=');
    if (equals != NULL && equals > text && read_two(equals + 1, number)) return EXIT_ANSWERED;
    return complain(EXIT_USAGE, verb, "--%s must be NAME=LO,HI, such as angle=0,1.5, not '%s'",
                    row->name, text);
}

exit_status option_read(const option *row, const char *text, const char *verb, option_value *value)
{
    *value = (option_value){.row = row, .text = text};
    switch (row->kind) {
    case OPTION_FLAG:
    case OPTION_TEXT:
        return EXIT_ANSWERED;
    case OPTION_CHOICE:
        return read_choice(row, text, verb, &value->choice);
    case OPTION_RANGE:
        return read_range(row, text, verb, value->number);
    case OPTION_INTERVAL:
        return read_interval(row, text, verb, value->number);
    case OPTION_NUMBER:
        if (read_bounded(row, text, &value->number[0])) return EXIT_ANSWERED;
        return complain(EXIT_USAGE, verb, "--%s must be a finite number %s %g, not '%s'", row->name,
                        row->min_open ? "greater than" : "of at least", row->min, text);
    case OPTION_COUNT:
        if (read_count(text, 1000, &value->count)) return EXIT_ANSWERED;
        break;
    case OPTION_BYTES:
        if (read_count(text, 1024, &value->count)) return EXIT_ANSWERED;
        break;
    }
    return complain(EXIT_USAGE, verb,
                    "--%s must be a whole number below 2^64, with K, M or G after it if you like, "
                    "not '%s'",
                    row->name, text);
}
