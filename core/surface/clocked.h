/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_CLOCKED_H
#define CORE_SURFACE_CLOCKED_H

#include "core/surface/instance.h"

/* Instances under a clock, held at a value
 * ========================================
 * A surface or a map of a scene may follow a scene parameter instead of time: its t is then the
 * parameter's value. At one value it is an instance like any other that does not depend on time:
 * each callback hands the type's own the value instead of t, and takes what it answers as constant
 * in time. So nothing above this room knows of clocks, but what makes scenes for values
 * (core/scene/posed_scene.h) and what searches over values (core/survey). */

/* Makes the instance that follows parameter number `clock` at this value, which lies in the domain
 * of times of `inner`. It holds `inner`, and has the callbacks that `inner` has, but for formulas.
 * NULL: no memory. */
shared_instance *clocked_new(shared_instance *inner, size_t clock, double value);

/* Returns the instance that follows time: p itself, or what p is at a value of its clock. */
static inline shared_instance *clocked_own(shared_instance *p)
{
    return p->inner != NULL ? p->inner : p;
}

/* What the type itself made, of a surface that follows a clock, or of a piece of it. */
const void *clocked_self(const void *self);

#endif
