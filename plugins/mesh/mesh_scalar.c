/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_scalar.h"

#include <stdint.h>
#include <string.h>

size_t mesh_scalar_size(mesh_scalar type)
{
    static const size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

bool mesh_scalar_is_whole(mesh_scalar type)
{
    return type != SCALAR_FLOAT32 && type != SCALAR_FLOAT64;
}

static uint64_t bits_at(size_t size, bool is_big_endian, const char *bytes)
{
    uint64_t bits = 0;
    for (size_t k = 0; k < size; ++k)
        bits = bits << 8 | (unsigned char)bytes[is_big_endian ? k : size - 1 - k];
    return bits;
}

/* Two's complement, without a conversion that the implementation defines. */
static double signed_of(uint64_t bits, size_t size)
{
    const double value = (double)bits, range = (double)(UINT64_C(1) << 8 * size);
    return 2 * value >= range ? value - range : value;
}

double mesh_scalar_at(mesh_scalar type, bool is_big_endian, const char *bytes)
{
    const size_t size = mesh_scalar_size(type);
    const uint64_t bits = bits_at(size, is_big_endian, bytes);
    if (type == SCALAR_FLOAT64) {
        double x;
        memcpy(&x, &bits, sizeof x);
        return x;
    }
    if (type == SCALAR_FLOAT32) {
        const uint32_t word = (uint32_t)bits;
        float x;
        memcpy(&x, &word, sizeof x);
        return x;
    }
    const bool is_signed = type == SCALAR_INT8 || type == SCALAR_INT16 || type == SCALAR_INT32;
    return is_signed ? signed_of(bits, size) : (double)bits;
}
