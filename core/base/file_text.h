/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_FILE_TEXT_H
#define CORE_BASE_FILE_TEXT_H

#include "core/base/status.h"

/* Reads a whole file, pipe or device into *text (free it), with a NUL behind its *length bytes. At
 * most FILE_TEXT_MAX bytes. Errors name the path and the cause. */
#define FILE_TEXT_MAX ((size_t)1 << 30)

imp_code file_text_read(const char *path, char **text, size_t *length, imp_error *error);

#endif
