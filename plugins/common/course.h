/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_COURSE_H
#define PLUGINS_COMMON_COURSE_H

#include "plugins/common/polynomial.h"
#include "plugins/common/spline.h"
#include "plugins/common/units.h"

/* A quantity in the course of time
 * ================================
 * An angle, or three lengths, as a polynomial in time (polynomial.h), or from a table of times and
 * values: given as parameters, or as columns of a file (csv.h), converted from their units
 * (units.h). Between the times of a table it is linear, or a spline (spline.h): a cubic with slopes
 * of its own or with given velocities, a quintic with given accelerations too. Beyond them it is
 * held, or the map is not defined. */

/* The rows of a type's table, in this order, from `first` on. */
enum {
    COURSE_RATE,
    COURSE_COEFFICIENTS,
    COURSE_TIMES,
    COURSE_VALUES,
    COURSE_FILE,
    COURSE_COLUMNS,
    COURSE_UNIT,
    COURSE_INTERPOLATION,
    COURSE_HOLD,
    COURSE_VELOCITIES,
    COURSE_ACCELERATIONS,
    COURSE_ROWS
};

/* VALUES, VELOCITIES and ACCELERATIONS are rows of their own kind; UNIT is that of angles or that
 * of lengths. */
#define COURSE_ROW_TIMES                                                                           \
    IMP_ROW_NUMBERS("times", "time", NULL, IMP_PARAMETER_OPTIONAL,                                 \
                    "instead: of a table, increasing, two or more")

#define COURSE_ROW_FILE                                                                            \
    IMP_ROW_FILE(                                                                                  \
        "file", IMP_PARAMETER_OPTIONAL,                                                            \
        "instead: a table of numbers between commas, or semicolons, or tabs; times in its "        \
        "first column, in s if a head has a unit ('t [ms]'); relative to the scene file")

#define COURSE_ROW_COLUMNS(NAME, COUNT, FLAGS, DOC)                                                \
    IMP_ROW_OF(IMP_KIND_STRING, NAME, "1", NULL, IMP_PARAMETER_OPTIONAL | (FLAGS), 1, COUNT, 0,    \
               -INFINITY, INFINITY, DOC)

#define COURSE_ROW_DEGREES                                                                         \
    IMP_ROW_BOOLEAN("degrees", "false",                                                            \
                    "of a table: whether its angles are in degrees; a head may say so instead "    \
                    "('j1 [deg]')")

#define COURSE_ROW_SCENE_UNIT                                                                      \
    IMP_ROW_OF(IMP_KIND_STRING, "scene_unit", "1", NULL, IMP_PARAMETER_OPTIONAL, 0, 0, 0,          \
               -INFINITY, INFINITY,                                                                \
               "of a file whose head has units ('x [mm]'): that of the scene's lengths, which "    \
               "the columns are converted to: m, cm, mm, um, nm, km, in or ft")

#define COURSE_ROW_INTERPOLATION                                                                   \
    IMP_ROW_OF(IMP_KIND_STRING, "interpolation", "1", "\"linear\"", 0, 0, 0, 0, -INFINITY,         \
               INFINITY, "of a table: linear, or cubic with continuous slopes as in keyframes")

#define COURSE_DOC_VELOCITIES                                                                      \
    "with times: one for each; between them the cubic with these slopes, or with accelerations a " \
    "quintic"
#define COURSE_DOC_ACCELERATIONS "with velocities: one for each of times"

#define COURSE_ROW_HOLD                                                                            \
    IMP_ROW_BOOLEAN("hold", "false",                                                               \
                    "of a table: whether its ends hold before and after it; else the map is "      \
                    "defined between them only")

enum { COURSE_WIDTH_MAX = 3, COURSE_ORDERS = 3 };

/* A table, whose numbers follow in the same block of memory. */
typedef struct course_keys {
    spline table;
    /* The numbers of the table, row by row, before their units are converted, and its velocities
     * and accelerations or NULL. */
    const double *given[COURSE_ORDERS];
    unit from[COURSE_WIDTH_MAX], to[COURSE_WIDTH_MAX]; /* units of the columns that they are from */
} course_keys;

/* It is small, since large scenes have one for each body. */
typedef struct course {
    polynomial polynomial; /* count == 0: it is a table */
    size_t numbers;        /* coefficients of all of its components */
    course_keys *keys;     /* of a table, else NULL */
    bool hold;
} course;

/* Frees the memory that course_read allocated. */
void course_clear(course *c);

/* Reads the rows `first` ... first + COURSE_ROWS - 1 of the table `rows`: an angle, or three
 * lengths. On failure there is nothing to clear. */
imp_status course_read(course *c, const imp_value *values, int first, unit_kind kind,
                       imp_create_error *why, const imp_parameter *rows);

/* Reads other rows into a course, in the memory it has. IMP_STATUS_UNBOUNDED: they need other
 * memory, as those of tables always do. On failure the course may hold anything, but can be
 * cleared. */
imp_status course_renew(course *c, const imp_value *values, int first, unit_kind kind,
                        imp_create_error *why, const imp_parameter *rows);

/* Tells the times at which it is defined: from *lo to *hi. */
void course_times(const course *c, double *lo, double *hi);

/* Returns the first and last time of a table, whether or not it is held beyond them; -INFINITY and
 * INFINITY: it is no table. */
void course_span(const course *c, double *lo, double *hi);

/* Whether it is defined at all times from one to the other. */
bool course_is_defined(const course *c, double from, double to);

/* Prints formulas of a map: for each span of times in which the course is one formula a part, which
 * is `before`, definitions of the course's numbers as "name0" ..., and `after`. */
void course_write(const course *c, const char *name, const char *before, const char *after,
                  const imp_text_sink *to);

/* Computes all its numbers at time t. Precondition: it is defined there. */
void course_at(const course *c, size_t width, imp_model t, imp_model *out);

#endif
