/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/input.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void input_begin(input *in, FILE *file)
{
    *in = (input){.file = file};
    sha256_begin(&in->hash);
}

bool input_refuse(input *in, const char *format, ...)
{
    if (input_is_refused(in)) return false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(in->fault, sizeof in->fault, format, arguments);
    va_end(arguments);
    in->fault_at = in->at;
    return false;
}

static void hash_read(input *in)
{
    sha256_add(&in->hash, in->read, in->count);
    in->count = 0;
}

unsigned input_byte(input *in)
{
    const int c = input_is_refused(in) ? EOF : getc(in->file);
    if (c == EOF) {
        input_refuse(in, ferror(in->file) ? "it cannot be read" : "it ends too early");
        return 0;
    }
    ++in->at;
    in->read[in->count++] = (uint8_t)c;
    if (in->count == INPUT_BYTES) hash_read(in);
    if (in->copy != NULL) in->copy(in->copy_context, (uint8_t)c);
    return (unsigned)c;
}

unsigned input_16(input *in)
{
    const unsigned high = input_byte(in);
    return high << 8 | input_byte(in);
}

uint64_t input_count(input *in, uint64_t most)
{
    uint64_t n = 0;
    for (int shift = 0; shift < 56; shift += 7) {
        const unsigned byte = input_byte(in);
        n |= (uint64_t)(byte & 127) << shift;
        if (byte >= 128) continue;
        if (n <= most) return n;
        break;
    }
    input_refuse(in, "a number is above %llu", (unsigned long long)most);
    return 0;
}

char *input_line(input *in, size_t most)
{
    size_t length = 0, capacity = 256;
    char *line = malloc(capacity);
    while (line != NULL && !input_is_refused(in)) {
        const unsigned c = input_byte(in);
        if (input_is_refused(in)) break;
        if (c == '\n') {
            line[length] = '\0';
            return line;
        }
        if (c < ' ' || c > '~' || length == most) { /* others could change what is shown */
            input_refuse(in, length == most ? "a line is too long" : "a line holds byte %u", c);
            break;
        }
        line[length++] = (char)c;
        if (length < capacity) continue;
        char *grown = realloc(line, capacity *= 2);
        if (grown == NULL) free(line);
        line = grown;
    }
    if (line == NULL) input_refuse(in, "memory ran out");
    free(line);
    return NULL;
}

bool input_end(input *in)
{
    uint8_t digest[SHA256_BYTES];
    hash_read(in);
    sha256_end(&in->hash, digest);
    in->copy = NULL;
    for (int k = 0; k < SHA256_BYTES; ++k)
        if (input_byte(in) != digest[k] && !input_is_refused(in))
            return input_refuse(in, "the checksum is not that of the bytes before it");
    if (!input_is_refused(in) && getc(in->file) != EOF)
        return input_refuse(in, "bytes follow the checksum");
    return !input_is_refused(in);
}
