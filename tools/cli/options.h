/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_OPTIONS_H
#define TOOLS_CLI_OPTIONS_H

#include "tools/cli/message.h"

/* Options of the command line
 * ===========================
 * An option is one row of a table: its name, the kind of its value, the allowed range, one line of
 * help. Parsing, range checks, complaints and help text all follow from the row, so they cannot
 * differ. A verb lists the tables it accepts. */

typedef enum option_kind {
    OPTION_FLAG,     /* takes nothing */
    OPTION_NUMBER,   /* finite number, at least `min` (greater, if min_open) */
    OPTION_COUNT,    /* whole number from 0; suffixes K, M, G: thousands */
    OPTION_BYTES,    /* whole number from 0; suffixes K, M, G: times 1024 */
    OPTION_INTERVAL, /* two finite numbers T0,T1 with T0 <= T1 */
    OPTION_CHOICE,   /* one of `choices` */
    OPTION_RANGE,    /* NAME=LO,HI: a name without '=', two finite numbers */
    OPTION_TEXT      /* anything */
} option_kind;

typedef struct option {
    const char *name; /* without the dashes; NULL ends a table */
    option_kind kind;
    const char *argument;       /* the value's name in help; NULL for flags */
    const char *help;           /* one line */
    const char *const *choices; /* OPTION_CHOICE: names, NULL-terminated */
    double min;                 /* OPTION_NUMBER */
    bool min_open;
} option;

typedef struct option_value {
    const option *row;
    const char *text; /* as written; NULL for flags */
    double number[2]; /* OPTION_NUMBER: [0]; OPTION_INTERVAL, OPTION_RANGE: both */
    uint64_t count;   /* OPTION_COUNT, OPTION_BYTES */
    size_t choice;    /* OPTION_CHOICE: index */
} option_value;

/* Returns the row of that name in NULL-terminated tables of rows, or NULL. The name has `length`
 * characters. */
const option *option_find(const option *const *tables, const char *name, size_t length);

/* Reads `text` (NULL for flags) as the row wants it. Complains on behalf of `verb`. */
exit_status option_read(const option *row, const char *text, const char *verb, option_value *value);

/* The tables that verbs choose from. */
extern const option options_always[];   /* help, version: every verb has these */
extern const option options_registry[]; /* json, plugin-path */
extern const option options_search[];   /* time, gamma, budgets: every search has these */
extern const option options_explain[];  /* explain: of one search for contact */
extern const option options_query[];    /* method, ...: of the search for contact */

#endif
