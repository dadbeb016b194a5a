/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/sha256.h"

#include <stdio.h>
#include <string.h>

/* The first 32 bits of the fractional parts of the cube roots of the first 64 primes. */
static const uint32_t rounds[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

void sha256_begin(sha256 *h)
{
    *h = (sha256){.state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c,
                            0x1f83d9ab, 0x5be0cd19}};
}

static uint32_t turned(uint32_t x, int by) { return x >> by | x << (32 - by); }

static void expand(const uint8_t block[64], uint32_t w[64])
{
    for (int k = 0; k < 16; ++k)
        w[k] = (uint32_t)block[4 * k] << 24 | (uint32_t)block[4 * k + 1] << 16 |
               (uint32_t)block[4 * k + 2] << 8 | block[4 * k + 3];
    for (int k = 16; k < 64; ++k) {
        const uint32_t x = w[k - 15], y = w[k - 2];
        w[k] = w[k - 16] + (turned(x, 7) ^ turned(x, 18) ^ x >> 3) + w[k - 7] +
               (turned(y, 17) ^ turned(y, 19) ^ y >> 10);
    }
}

static void take_block(sha256 *h)
{
    uint32_t w[64], s[8];
    expand(h->block, w);
    memcpy(s, h->state, sizeof s);
    for (int k = 0; k < 64; ++k) {
        const uint32_t e = s[4], a = s[0];
        const uint32_t x = s[7] + (turned(e, 6) ^ turned(e, 11) ^ turned(e, 25)) +
                           ((e & s[5]) ^ (~e & s[6])) + rounds[k] + w[k];
        const uint32_t y = (turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) +
                           ((a & s[1]) ^ (a & s[2]) ^ (s[1] & s[2]));
        memmove(s + 1, s, 7 * sizeof *s);
        s[4] += x;
        s[0] = x + y;
    }
    for (int k = 0; k < 8; ++k) h->state[k] += s[k];
}

void sha256_add(sha256 *h, const void *bytes, size_t size)
{
    const uint8_t *from = bytes;
    while (size > 0) {
        const size_t used = (size_t)(h->size % 64), room = 64 - used;
        const size_t part = size < room ? size : room;
        memcpy(h->block + used, from, part);
        h->size += part, from += part, size -= part;
        if (used + part == 64) take_block(h);
    }
}

void sha256_end(sha256 *h, uint8_t digest[SHA256_BYTES])
{
    const uint64_t bits = 8 * h->size;
    uint8_t last[8];
    for (int k = 0; k < 8; ++k) last[k] = (uint8_t)(bits >> (56 - 8 * k));
    sha256_add(h, "\x80", 1);
    while (h->size % 64 != 56) sha256_add(h, "", 1);
    sha256_add(h, last, sizeof last);
    for (int k = 0; k < SHA256_BYTES; ++k)
        digest[k] = (uint8_t)(h->state[k / 4] >> (24 - 8 * (k % 4)));
}

void sha256_text(const uint8_t digest[SHA256_BYTES], char text[SHA256_TEXT])
{
    for (int k = 0; k < SHA256_BYTES; ++k) snprintf(text + 2 * k, 3, "%02x", digest[k]);
}

bool sha256_file(const char *path, char text[SHA256_TEXT])
{
    uint8_t digest[SHA256_BYTES], block[4096];
    sha256 h;
    size_t size;
    FILE *file = fopen(path, "rb");
    if (file == NULL) return false;
    sha256_begin(&h);
    while ((size = fread(block, 1, sizeof block, file)) > 0) sha256_add(&h, block, size);
    const bool read = !ferror(file);
    fclose(file);
    sha256_end(&h, digest);
    sha256_text(digest, text);
    return read;
}
