/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* The note says one version, the symbol another. */
IMP_NOTE_("note_disagrees", "1.0");

static const void *get_factory(const char *id)
{
    (void)id;
    return NULL;
}

const imp_plugin impinge_plugin = {IMP_PLUGIN_MAGIC, sizeof(imp_plugin),
                                   IMP_ABI_MAJOR,    IMP_ABI_MINOR,
                                   "note_disagrees", "2.0",
                                   "Apache-2.0",     "tests",
                                   get_factory};
