/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_SHA256_H
#define CORE_COMMON_SHA256_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* SHA-256 (FIPS 180-4), by which a certificate names the files it was made from */

typedef struct sha256 {
    uint32_t state[8];
    uint64_t size;
    uint8_t block[64];
} sha256;

enum { SHA256_BYTES = 32, SHA256_TEXT = 2 * SHA256_BYTES + 1 };

void sha256_begin(sha256 *h);
void sha256_add(sha256 *h, const void *bytes, size_t size);
void sha256_end(sha256 *h, uint8_t digest[SHA256_BYTES]);

/* Writes the digest as hexadecimal digits. */
void sha256_text(const uint8_t digest[SHA256_BYTES], char text[SHA256_TEXT]);

/* Writes the digest of a file's bytes; false: it cannot be read, and errno says why. */
bool sha256_file(const char *path, char text[SHA256_TEXT]);

#endif
