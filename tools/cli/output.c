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

/* Characters of the number that the text begins with. */
static size_t number_length(const char *text) { return strspn(text, "+-.0123456789eE"); }

/* Returns the last two of the 17 digits that "%.17g" rounded a number to, whose trailing zeros the
 * text may lack. */
static int last_two_of_17(const char *text, size_t length)
{
    int last = 0, before = 0, digits = 0;
    for (size_t k = 0; k < length && text[k] != 'e' && text[k] != 'E'; ++k) {
        if (text[k] < '0' || text[k] > '9' || (digits == 0 && text[k] == '0')) continue;
        before = last;
        last = text[k] - '0';
        digits += 1;
    }
    return digits == 17 ? 10 * before + last : digits == 16 ? 10 * last : 0;
}

/* Whether 15 digits may read back as the number that the 17 digits of the text stand for. Let U be
 * the unit of the 17th digit, so that abs(x) < 1e17 U. Lemma: if S of 15 digits reads back as x,
 * which is normal, then
 *     abs(S - x) <= ulp(x) / 2 <= 2^-53 abs(x) < 11.2 U,
 *     abs(D - x) <= U / 2 for the 17 digits D,
 * and abs(S - D) <= 11 U, since S and D are whole multiples of U; S is one of 100 U, or ends a
 * decade below D, which then ends in 00 to 11. */
static bool may_have_15_digits(const char *text, size_t length, double number)
{
    const int last = last_two_of_17(text, length);
    return last <= 11 || last >= 89 || fabs(number) < DBL_MIN;
}

/* Writes the number at the beginning of `from` to `to`, in the fewest digits that read back
 * exactly. Returns the number of characters written: at most those read. A text of up to 15
 * characters is one of 15 digits already, perhaps with a ".0" that Jansson adds to whole
 * numbers. */
static size_t write_shortest(const char *from, char *to)
{
    const size_t length = number_length(from);
    char text[32];
    if (length <= 15 || (memchr(from, '.', length) == NULL && memchr(from, 'e', length) == NULL)) {
        const bool whole = length > 2 && memcmp(from + length - 2, ".0", 2) == 0;
        memmove(to, from, length);
        return whole ? length - 2 : length;
    }
    const double number = strtod(from, NULL);
    memmove(to, from, length);
    for (int digits = may_have_15_digits(from, length, number) ? 15 : 16; digits < 17; ++digits) {
        const size_t shorter = (size_t)snprintf(text, sizeof text, "%.*g", digits, number);
        if (shorter >= length || strtod(text, NULL) != number) continue;
        memcpy(to, text, shorter);
        return shorter;
    }
    return length;
}

/* Jansson writes all numbers in one precision: 17 digits are always enough, and seldom needed. */
static void shorten_numbers(char *text)
{
    char *to = text;
    bool quoted = false;
    while (*text != '\0') {
        if (*text == '"') quoted = !quoted;
        if (quoted && *text == '\\') *to++ = *text++;
        if (!quoted && (*text == '-' || (*text >= '0' && *text <= '9'))) {
            const size_t length = number_length(text);
            to += write_shortest(text, to);
            text += length;
        } else {
            *to++ = *text++;
        }
    }
    *to = '\0';
}

/* Returns the next character that controls a terminal and that Jansson does not escape: DEL, or one
 * of C1 (U+0080 to U+009F), which is two bytes in UTF-8. NULL: there is none. */
static const char *next_control(const char *text)
{
    while ((text = strpbrk(text, "\x7f\xc2")) != NULL && *text == '\xc2' &&
           (unsigned char)text[1] >= 0xA0)
        text += 1;
    return text;
}

/* Copies the text with such characters written as \u009b; NULL: no memory. */
static char *escape_controls(const char *text)
{
    char *escaped = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&escaped, &length);
    if (out == NULL) return NULL;
    for (const char *control; (control = next_control(text)) != NULL;) {
        const bool single = *control == '\x7f';
        const unsigned code = single ? 0x7F : (unsigned char)control[1];
        fprintf(out, "%.*s\\u%04x", (int)(control - text), text, code);
        text = control + (single ? 1 : 2);
    }
    fputs(text, out);
    if (fclose(out) == 0) return escaped;
    free(escaped);
    return NULL;
}

char *output_json_line(json_t *object)
{
    const size_t flags = JSON_COMPACT | JSON_REAL_PRECISION(17) | JSON_ENCODE_ANY;
    char *text = json_memory_text(object, flags);
    json_decref(object);
    if (text == NULL) return NULL;
    shorten_numbers(text);
    if (next_control(text) == NULL) return text;
    char *escaped = escape_controls(text);
    free(text);
    return escaped;
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
