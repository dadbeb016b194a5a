/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_FUZZ_FUZZ_MUTATE_H
#define TESTS_FUZZ_FUZZ_MUTATE_H

#include <stddef.h>

/* Mutations of text that leave it well formed more often than random bytes do: a number becomes
 * another one, a word another word of the text. Every other time libFuzzer's own. Only in a search
 * (tests/fuzz/run); replay.c needs none. */

#ifdef IMP_FUZZ_SEARCH

#include <stdint.h>
#include <stdio.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *bytes, size_t length, size_t max_length);
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t length, size_t max_length, unsigned seed);

static unsigned fuzz_draw(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* What a token is made of: 0 none, 1 a number's characters, 2 a word's. */
static int fuzz_kind(uint8_t c)
{
    if ((c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+') return 1;
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ? 2 : 0;
}

typedef struct fuzz_token {
    size_t start, length;
} fuzz_token;

/* The token at or behind a random place, of any kind (0) or that one; empty: none. */
static fuzz_token fuzz_find(const uint8_t *bytes, size_t length, int kind, unsigned *state)
{
    size_t at = fuzz_draw(state) % length;
    while (at > 0 && fuzz_kind(bytes[at - 1]) != 0) --at;
    while (at < length && (kind == 0 ? fuzz_kind(bytes[at]) == 0 : fuzz_kind(bytes[at]) != kind))
        ++at;
    size_t end = at;
    const int first = at < length ? fuzz_kind(bytes[at]) : 0;
    while (end < length && (fuzz_kind(bytes[end]) == first ||
                            (first == 1 && (bytes[end] == 'e' || bytes[end] == 'E')) ||
                            (first == 2 && fuzz_kind(bytes[end]) == 1)))
        ++end;
    return (fuzz_token){at, end - at};
}

static size_t fuzz_replace(uint8_t *bytes, size_t length, size_t max_length, fuzz_token old,
                           const uint8_t *fresh, size_t fresh_length)
{
    if (length - old.length + fresh_length > max_length) return length;
    memmove(bytes + old.start + fresh_length, bytes + old.start + old.length,
            length - old.start - old.length);
    memcpy(bytes + old.start, fresh, fresh_length);
    return length - old.length + fresh_length;
}

static size_t fuzz_number(char text[40], unsigned *state)
{
    static const char *const ends[] = {"0",
                                       "-0",
                                       "1",
                                       "-1",
                                       "2",
                                       "3",
                                       "0.5",
                                       "1e-6",
                                       "1e-12",
                                       "1e-300",
                                       "5e-324",
                                       "1e9",
                                       "1e300",
                                       "1.7976931348623157e308",
                                       "1e400",
                                       "0.1",
                                       "3.141592653589793",
                                       "6.283185307179586",
                                       "1e16",
                                       "4096"};
    const unsigned kind = fuzz_draw(state) % 3;
    if (kind == 0)
        return (size_t)snprintf(text, 40, "%s",
                                ends[fuzz_draw(state) % (sizeof ends / sizeof *ends)]);
    if (kind == 1) return (size_t)snprintf(text, 40, "%d", (int)(fuzz_draw(state) % 21) - 10);
    return (size_t)snprintf(text, 40, "%.4g", ((int)(fuzz_draw(state) % 8001) - 4000) / 1000.0);
}

static size_t fuzz_mutate_text(uint8_t *bytes, size_t length, size_t max_length, unsigned seed)
{
    unsigned state = seed;
    if (length == 0 || fuzz_draw(&state) % 2 == 0)
        return LLVMFuzzerMutate(bytes, length, max_length);
    const int kind = fuzz_draw(&state) % 3 == 0 ? 2 : 1;
    const fuzz_token old = fuzz_find(bytes, length, kind, &state);
    if (old.length == 0) return LLVMFuzzerMutate(bytes, length, max_length);
    uint8_t word[64];
    if (kind == 1) {
        char number[40];
        const size_t n = fuzz_number(number, &state);
        return fuzz_replace(bytes, length, max_length, old, (const uint8_t *)number, n);
    }
    const fuzz_token other = fuzz_find(bytes, length, 2, &state);
    if (other.length == 0 || other.length > sizeof word) return length;
    memcpy(word, bytes + other.start, other.length);
    return fuzz_replace(bytes, length, max_length, old, word, other.length);
}

#define FUZZ_MUTATE_TEXT                                                                           \
    size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t length, size_t max_length,               \
                                   unsigned seed)                                                  \
    {                                                                                              \
        return fuzz_mutate_text(bytes, length, max_length, seed);                                  \
    }

#else
#define FUZZ_MUTATE_TEXT
#endif

#endif
