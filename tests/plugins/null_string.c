/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Nobody knows who wrote it. */
IMP_NOTE_("null_string", "1.0");

static const void *get_factory(const char *id)
{
    (void)id;
    return NULL;
}

const imp_plugin impinge_plugin = {IMP_PLUGIN_MAGIC, sizeof(imp_plugin),
                                   IMP_ABI_MAJOR,    IMP_ABI_MINOR,
                                   "null_string",    "1.0",
                                   "Apache-2.0",     NULL,
                                   get_factory};
