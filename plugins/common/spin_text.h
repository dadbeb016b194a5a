/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_SPIN_TEXT_H
#define PLUGINS_COMMON_SPIN_TEXT_H

#include <impinge/formula_text.h>

/* The rotation of spin.h as text of a formula. */

/* Defines r0, r1, r2 as R(s) (w0, w1, w2). The text before defines s, h and w0 ... w2. `from` and
 * `to_rotation`: the quaternions of both ends. */
void spin_write(const double spin[3], const double from[4], const double to_rotation[4],
                const imp_text_sink *to);

#endif
