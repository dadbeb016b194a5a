/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_JSON_TEXT_H
#define CORE_BASE_JSON_TEXT_H

#include <jansson.h>

#include "core/base/status.h"

/* Writes the value as compact text, which the caller frees by free(). NULL: no memory. */
char *json_text_of(const json_t *value, imp_error *error);

#endif
