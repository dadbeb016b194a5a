/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/system_error.h"
#include "tools/cli/json_memory.h"
#include "tools/cli/output.h"
#include "tools/cli/standard_output.h"

#include <errno.h>
#include <fcntl.h>
#include <float.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool output_prepare(void)
{
    for (int fd = 0; fd <= 2; ++fd)
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF)
            (void)!open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a file that may grow no more is an error */
    json_memory_prepare();
    if (standard_output_prepare()) return true;
    complain_of_memory(NULL);
    return false;
}

static exit_status complain_of_output(const char *verb)
{
    const int error = errno;
    static bool complained;
    if (error == EPIPE || complained)
        return EXIT_DATA; /* EPIPE: nobody reads, as behind `| head` */
    complained = true;
    return complain(EXIT_DATA, verb, "standard output: %s", system_error_text(error));
}

/* Complains, once, instead of printing text made of damaged JSON (json_memory.h). */
static exit_status refuse_damaged(const char *verb)
{
    static bool complained;
    standard_output_discard();
    if (!complained) complain_of_memory(verb);
    complained = true;
    return EXIT_DATA;
}

exit_status output_flush(const char *verb)
{
    if (json_memory_failed()) return refuse_damaged(verb);
    return standard_output_flush() ? EXIT_ANSWERED : complain_of_output(verb);
}

exit_status output_finish(const char *verb)
{
    if (json_memory_failed()) return refuse_damaged(verb);
    return standard_output_close() ? EXIT_ANSWERED : complain_of_output(verb);
}

void output_error_object(void)
{
    const char *text = complain_first();
    if (text == NULL || standard_output_is_replaced()) return;
    char *line = output_json_line(json_pack("{s:o}", "error", output_json_text(text)));
    if (line != NULL) puts(line);
    free(line);
}

static bool coloured;

void output_choose_colour(bool wanted)
{
    const char *refused = getenv("NO_COLOR"), *terminal = getenv("TERM");
    coloured = wanted && (refused == NULL || refused[0] == '\0') && standard_output_is_terminal() &&
               terminal != NULL && strcmp(terminal, "dumb") != 0;
}

const char *output_colour(output_tint tint)
{
    static const char *const sequences[] = {"\033[0m", "\033[1m", "\033[1;31m", "\033[1;32m",
                                            "\033[1;33m"};
    return coloured ? sequences[tint] : "";
}

exit_status output_line(char *text, const char *verb)
{
    if (text == NULL) return json_memory_failed() ? refuse_damaged(verb) : complain_of_memory(verb);
    puts(text);
    free(text);
    return output_flush(verb);
}

exit_status output_json(json_t *object, const char *verb)
{
    return output_line(output_json_line(object), verb);
}

json_t *output_json_text(const char *text)
{
    if (text == NULL) return json_null();
    json_t *string = json_string(text);
    if (string != NULL) return string;
    char *plain = strdup(text);
    for (char *c = plain; c != NULL && *c != '\0'; ++c)
        if ((unsigned char)*c >= 0x80) *c = '?';
    string = plain != NULL ? json_string(plain) : NULL;
    free(plain);
    return string;
}

json_t *output_json_number(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}

static bool is_plain_word(const char *text)
{
    return text[0] != '\0' &&
           text[strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                             "0123456789+,-./:=@_")] == '\0';
}

/* Writes the text as $'...', which bash, ksh and zsh read. */
static char *escaped_word(const char *text)
{
    char *word = malloc(4 * strlen(text) + 4), *out = word;
    if (word == NULL) return NULL;
    out = stpcpy(out, "$'");
    for (; *text != '\0'; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c == '\'' || c == '\\')
            *out++ = '\\', *out++ = *text;
        else if (c < 0x20 || c >= 0x7F)
            out += sprintf(out, "\\x%02x", c);
        else
            *out++ = *text;
    }
    strcpy(out, "'");
    return word;
}

char *output_shell_word(const char *text)
{
    if (is_plain_word(text)) return strdup(text);
    if (strcmp(message_shown(text).text, text) != 0) return escaped_word(text);
    char *word = malloc(4 * strlen(text) + 3), *out = word;
    if (word == NULL) return NULL;
    *out++ = '\'';
    for (; *text != '\0'; ++text) {
        if (*text == '\'') {
            memcpy(out, "'\\''", 4);
            out += 4;
        } else {
            *out++ = *text;
        }
    }
    memcpy(out, "'", 2);
    return word;
}

/* Returns the decimal of 10 digits next to that of `text` (as "%.9e" prints it), on the given
 * side. */
static double next_decimal(const char *text, int side)
{
    char digits[32], next[48], *exponent, *to = digits;
    for (; *text != '\0'; ++text)
        if (*text != '.') *to++ = *text;
    *to = '\0';
    const long long whole = strtoll(digits, &exponent, 10);
    snprintf(next, sizeof next, "%llde%ld", whole + side, strtol(exponent + 1, NULL, 10) - 9);
    return strtod(next, NULL);
}

/* Returns 10 digits: the nearest decimal if it is on the given side, else the next one, which is
 * less than one unit in the last digit away. Returns 17 digits if neither is, near the largest
 * double. */
static number_text number_on_side(double number, int side)
{
    number_text n;
    snprintf(n.text, sizeof n.text, "%.9e", number);
    const double nearest = strtod(n.text, NULL);
    const bool fits = !isfinite(number) || side * nearest >= side * number;
    const double chosen = fits ? nearest : next_decimal(n.text, side);
    snprintf(n.text, sizeof n.text, "%.10g", chosen);
    if (!isfinite(chosen) && isfinite(number)) snprintf(n.text, sizeof n.text, "%.17g", number);
    return n;
}

number_text output_number_lower(double number) { return number_on_side(number, -1); }
number_text output_number_upper(double number) { return number_on_side(number, 1); }

number_text output_number_exact(double number)
{
    number_text n;
    for (int digits = 15; digits <= 17; ++digits) {
        snprintf(n.text, sizeof n.text, "%.*g", digits, number);
        if (strtod(n.text, NULL) == number) break;
    }
    return n;
}
