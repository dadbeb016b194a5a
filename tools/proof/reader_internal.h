/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_READER_INTERNAL_H
#define TOOLS_PROOF_READER_INTERNAL_H

#include "tools/proof/steps.h"

/* Declarations that the files of the formula reader share: reader.c holds the grammar,
 * reader_names.c what names mean, reader_part.c the items before the coordinates of a part. */

enum { ARGUMENTS_MAX = 16, WORD_SIZE = 64 };

/* What a part of a text calls a name of its own. */
typedef struct defined_name {
    char text[WORD_SIZE];
    int step;
} defined_name;

typedef struct reader {
    const formula_scope *scope;
    formula *f;
    const char *text, *at;
    int depth;
    defined_name *defined;
    int defined_count, defined_capacity;
    char *fault; /* empty: none. Afterwards the text counts as ended. */
    size_t size;
} reader;

/* Notes the first fault, with its place, and ends the text. Returns 0, which stands for a step. */
int reader_fail(reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Each returns the index of a step of the formula, a new one or one that is there already. */
int reader_add_step(reader *r, step s);
int reader_join(reader *r, step_kind k, int a, int b);
int reader_number(reader *r, double value);

/* Returns the next character that is no space; '\0' at the end. */
char reader_peek(reader *r);

/* Returns whether the next character is this sign, which then is read. */
bool reader_take(reader *r, char sign);

/* Reads a word. False: there is no word here, or one that is too long. */
bool reader_take_word(reader *r, char word[WORD_SIZE]);

/* Reads a sum of products, and returns its step. */
int reader_sum(reader *r);

/* Makes the variables the first steps. */
void reader_add_variables(reader *r);

/* Returns the step that a name stands for, or that a function makes of its arguments. */
int reader_name(reader *r, const char *word);
int reader_apply(reader *r, const char *f, const int *a, int count);

bool reader_is_function(const char *word);

/* Returns the definition of that name in this text; NULL: there is none. */
const defined_name *reader_find_defined(const reader *r, const char *word);

#endif
