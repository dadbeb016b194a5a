/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_OUTPUT_H
#define TOOLS_CLI_OUTPUT_H

#include <jansson.h>

#include "tools/cli/message.h"

/* Standard output, with every write error reported
 * ================================================
 * A full disk is an error that is reported; a closed pipe ends the command quietly. Print
 * with stdio as usual; call output_finish before exit, or output_flush after each line of a
 * stream. */

/* Call it first of all: it opens closed standard streams, so that no file of ours gets their
 * numbers while writing to them still fails, and makes a closed pipe an error, not a signal. False,
 * and it complains: no memory. */
bool output_prepare(void);

/* Complain on behalf of `verb` and return EXIT_DATA if anything could not be written. */
exit_status output_flush(const char *verb);
exit_status output_finish(const char *verb);

/* With --json: prints the first complaint about an error, if any, as {"error": text}, for programs
 * that read standard output. Call it before output_finish. */
void output_error_object(void);

/* Switches colour on if it is wanted, standard output is a terminal with colours, and NO_COLOR is
 * not in the environment. */
void output_choose_colour(bool wanted);

/* The codes that begin a tint, or end all (PLAIN); "" without colour. */
typedef enum output_tint {
    OUTPUT_PLAIN,
    OUTPUT_BOLD,
    OUTPUT_RED,
    OUTPUT_GREEN,
    OUTPUT_YELLOW
} output_tint;
const char *output_colour(output_tint tint);

/* Prints the object on one line, numbers with 17 digits and all control characters escaped, and
 * drops the reference. NULL: memory ran out when it was made. */
exit_status output_json(json_t *object, const char *verb);

/* Returns the line that output_json prints, as text, which the caller frees; [any thread]. NULL: no
 * memory. */
char *output_json_line(json_t *object);

/* Prints such a line and frees it. NULL: memory ran out when it was made. */
exit_status output_line(char *text, const char *verb);

/* Returns a JSON string of a text that should be UTF-8; other bytes become '?'. NULL text: null. */
json_t *output_json_text(const char *text);

/* Returns a JSON number, or null for NaN and infinities. */
json_t *output_json_number(double number);

/* Returns the text as one word of a shell command line, quoted if necessary, with control
 * characters escaped. Free it. NULL: no memory. */
char *output_shell_word(const char *text);

/* A decimal of about 10 digits that is not above (lower) or not below (upper) the number, so that
 * what is printed claims no more than what is proved. */
typedef struct number_text {
    char text[32];
} number_text;
number_text output_number_lower(double number);
/* The fewest digits that read back exactly. */
number_text output_number_exact(double number);
number_text output_number_upper(double number);

#endif
