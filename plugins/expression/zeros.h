/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_ZEROS_H
#define PLUGINS_EXPRESSION_ZEROS_H

#include "plugins/expression/builder.h"

/* Is x proved to be 0 wherever y is 0? This is decided from the operations: a product with y is, a
 * power of |y| is, the sine of either is. */
bool vanishes_with(const builder *b, uint16_t x, uint16_t y);

#endif
