/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_TEXT_FORM_H
#define PLUGINS_EXPRESSION_TEXT_FORM_H

#include "plugins/expression/coil_form.h"
#include "plugins/expression/turned_form.h"

/* What three texts are known to be besides; the one that is named is filled. */
typedef enum text_kind { TEXT_PLAIN, TEXT_COIL, TEXT_TURNED } text_kind;

typedef struct text_form {
    text_kind kind;
    coil_form coil;
    turned_form turned;
} text_form;

#endif
