/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_UNCONST_H
#define CORE_BASE_UNCONST_H

#include <stdint.h>

/* Casts const away, for functions that do not declare what they leave unchanged: free() of memory
 * that we own, and the iterators of jansson. Writing there is a bug. */
static inline void *unconst(const void *address) { return (void *)(uintptr_t)address; }

#endif
