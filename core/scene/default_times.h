/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_DEFAULT_TIMES_H
#define CORE_SCENE_DEFAULT_TIMES_H

#include <impinge/impinge.h>

/* The times that are examined by default
 * ==========================================
 * Those at which all types and maps of the scene are defined, as far as some of them are made for
 * certain times: the span that tables and keyframes share. A table that holds at its ends is
 * defined at all times; several such are examined from the first time of any to the last. Surfaces
 * that do not exist at other times count like these. Where nothing has a span: from 0 to 1. */

/* Sets time[] to the times that are examined by default. IMP_ERROR_SCENE: two instances are defined
 * at no common time; the error names both, and time[] is NAN. */
imp_code default_times(const imp_scene *scene, double time[2], imp_error *error);

#endif
