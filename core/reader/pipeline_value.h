/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_PIPELINE_VALUE_H
#define CORE_READER_PIPELINE_VALUE_H

#include <jansson.h>

#include <impinge/impinge.h>

/* A value as it is typed on a command line
 * =========================
 *     .5  ->  0.5      1,0,0  ->  [1,0,0]      sin(u)  ->  "sin(u)" where a string is wanted
 *
 * Turns `length` > 0 bytes of valid UTF-8 into JSON. `row` is the parameter the value is for, NULL
 * if it is unknown. A word where no string is wanted still becomes a string, for parameters to
 * refuse it in its own words. The caller owns *json. IMP_ERROR_SCENE: `why` says what is wrong. */
imp_code pipeline_value_read(const imp_parameter *row, const char *text, size_t length,
                             json_t **json, char *why, size_t why_size);

#endif
