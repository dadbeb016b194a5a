/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void output_prepare(void)
{
    for (int fd = 0; fd <= 2; ++fd)
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF)
            (void)!open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
    signal(SIGPIPE, SIG_IGN);
}

static exit_status written(bool ok, const char *verb)
{
    if (ok) return EXIT_ANSWERED;
    const int error = errno;
    clearerr(stdout); /* one complaint is enough */
    return complain(EXIT_DATA, verb, "standard output: %s", strerror(error));
}

exit_status output_flush(const char *verb)
{
    errno = EIO; /* where an earlier write failed, its own reason is gone */
    const bool was_ok = !ferror(stdout);
    return written(fflush(stdout) == 0 && was_ok, verb);
}

exit_status output_finish(const char *verb)
{
    const exit_status status = output_flush(verb);
    if (fclose(stdout) == 0 || status != EXIT_ANSWERED) return status;
    return complain(EXIT_DATA, verb, "standard output: %s", strerror(errno));
}

exit_status output_json(json_t *object, const char *verb)
{
    char *text = object != NULL ? json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(object);
    if (text == NULL) return complain_of_memory(verb);
    const bool put = puts(text) >= 0;
    const exit_status status = put ? output_flush(verb) : written(false, verb);
    free(text);
    return status;
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

char *output_shell_word(const char *text)
{
    if (is_plain_word(text)) return strdup(text);
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

/* With 10 digits, one unit in the last is at most 1e-9 of the number, and rounding moves it by at
 * most half of that: shifted by a little more than half, the rounded number is on the wanted side.
 * 17 digits, for numbers so small that this fails, give back the number itself. */
static number_text number_on_side(double number, double side)
{
    const double shifted[] = {number, number + side * fabs(number) * 5.1e-10};
    number_text n;
    for (int i = 0; i < 2; ++i) {
        snprintf(n.text, sizeof n.text, "%.10g", shifted[i]);
        if (side * strtod(n.text, NULL) >= side * number) return n;
    }
    snprintf(n.text, sizeof n.text, "%.17g", number);
    return n;
}

number_text output_number_lower(double number) { return number_on_side(number, -1); }
number_text output_number_upper(double number) { return number_on_side(number, 1); }
