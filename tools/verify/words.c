/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

void *words_grown(input *in, void *list, size_t count, size_t *room, size_t size)
{
    const size_t before = *room;
    void *made = array_reserve(list, count, room, size);
    if (made == NULL) input_refuse(in, "memory ran out");
    if (made != NULL && *room > before)
        memset((char *)made + count * size, 0, (*room - count) * size);
    return made != NULL ? made : list;
}

const char *words_take(input *in, char **rest)
{
    char *found = strsep(rest, " ");
    if (found == NULL || *found == '\0') input_refuse(in, "a line is too short");
    return found != NULL ? found : "";
}

double words_number(input *in, char **rest)
{
    const char *text = words_take(in, rest);
    char *end;
    const double x = strtod(text, &end);
    if (*end != '\0' || !isfinite(x)) input_refuse(in, "'%.40s' is no finite number", text);
    return input_is_refused(in) ? 0 : x;
}

uint64_t words_whole(input *in, char **rest, uint64_t below)
{
    const char *text = words_take(in, rest);
    char *end;
    const unsigned long long n = strtoull(text, &end, 10);
    if (*end != '\0' || text[0] < '0' || text[0] > '9' || n >= below)
        input_refuse(in, "'%.40s' is no number below %llu", text, (unsigned long long)below);
    return input_is_refused(in) ? 0 : n;
}

void words_copy(input *in, char *to, size_t room, const char *text)
{
    if (strlen(text) >= room)
        input_refuse(in, "'%.40s' is too long", text);
    else
        strcpy(to, text);
}
