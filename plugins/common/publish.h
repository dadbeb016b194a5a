/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_PUBLISH_H
#define PLUGINS_COMMON_PUBLISH_H

#include <impinge/surface.h>

/* The entries of the plugins of this folder. They are built like third-party plugins, with the SDK
 * alone and no config.h; Makefile.am gives them the version of the package. */
#ifndef PLUGIN_VERSION
#define PLUGIN_VERSION "built apart"
#endif

#define PUBLISH_SURFACE(TYPE)                                                                      \
    IMPINGE_SURFACE_PLUGIN(#TYPE, PLUGIN_VERSION, "Apache-2.0", "The Impinge authors", TYPE)
#define PUBLISH_MAP(TYPE)                                                                          \
    IMPINGE_MAP_PLUGIN(#TYPE, PLUGIN_VERSION, "Apache-2.0", "The Impinge authors", TYPE)

#endif
