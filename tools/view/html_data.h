/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_HTML_DATA_H
#define TOOLS_VIEW_HTML_DATA_H

#include <jansson.h>

#include "tools/view/html.h"

/* Returns the data of the page's script: arrays in base64, 32 bits a number, little-endian. NULL:
 * no memory. */
json_t *html_data(const html_page *page);

#endif
