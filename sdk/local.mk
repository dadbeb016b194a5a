# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

# What plugin authors get: headers and impinge-sdk.pc. Nothing here is compiled.

pkginclude_HEADERS = \
    sdk/impinge/surface.h

pkgconfig_DATA += sdk/impinge-sdk.pc
