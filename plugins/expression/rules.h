/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_RULES_H
#define PLUGINS_EXPRESSION_RULES_H

#include "plugins/expression/builder.h"

/* What the language's operators and functions mean
 * ================================================
 * Each is translated to the tightest and cheapest equivalent operations. */

typedef enum meaning {
    MEANING_NEGATE,
    MEANING_ADD,
    MEANING_SUBTRACT,
    MEANING_MULTIPLY,
    MEANING_DIVIDE,
    MEANING_POWER,
    MEANING_SQUARE,
    MEANING_SQRT,
    MEANING_LOG2,
    MEANING_LOG10,
    MEANING_EXP2,
    MEANING_MIN,
    MEANING_MAX,
    MEANING_HYPOT,
    MEANING_CLAMP,
    MEANING_LERP,
    MEANING_COPYSIGN,
    MEANING_OPERATION /* + an opcode: that operation and nothing else */
} meaning;

#define ARGUMENTS_MAX 16

/* Arguments are values of the builder, as many as the meaning has; MIN and MAX take any number. */
uint16_t rules_apply(builder *b, int which, const uint16_t *argument, size_t count);

/* pi and e, enclosed. */
near_constant rules_pi(void);
near_constant rules_e(void);

#endif
