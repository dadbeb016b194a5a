# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

# What plugin authors get: headers and impinge-sdk.pc. Nothing here is compiled.

pkginclude_HEADERS = \
    sdk/impinge/formula.h \
    sdk/impinge/interval.h \
    sdk/impinge/model.h \
    sdk/impinge/model_angles.h \
    sdk/impinge/model_arithmetic.h \
    sdk/impinge/model_functions.h \
    sdk/impinge/model_series.h \
    sdk/impinge/surface.h

pkgconfig_DATA += sdk/impinge-sdk.pc
