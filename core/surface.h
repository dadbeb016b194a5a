/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_H
#define CORE_SURFACE_H

#include <impinge/impinge.h>

/* A surface under its maps, composed once
 * =======================================
 * g = phi_K( ... phi_1(f(u,v,t), t) ..., t). The rest of core sees only this: a
 * domain, points, rates, inclusions. Immutable once built, so safe from many threads. */

typedef struct surface surface;

/* Takes over the instance `self` (destroys it in surface_free). NULL: no memory; the instance
 * is destroyed then too. */
surface *surface_new(const imp_surface_type *type, void *self);

/* Puts a map on top of those already there; takes over `self`, also when it fails. */
imp_code surface_add_map(surface *s, const imp_map_type *type, void *self);

void surface_free(surface *s);

/* How messages call it: "sphere radius=2 ! rotate rate=1", or its beginning. The names of type and
 * maps are in it from the start; parameters are added by who knows how they were written. */
const char *surface_label(const surface *s);
void surface_add_label(surface *s, const char *text);

/* Tells messages whose it is; the text must outlive the surface. */
void surface_set_body(surface *s, const char *body, size_t index);

/* Sets IMP_ERROR_PLUGIN and answers it: "body 'b', surface 0: type 'sphere radius=2' <format>". */
imp_code surface_fault(const surface *s, imp_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Whether what the type, or the map put on last, told of its domain keeps the ABI: IMP_OK, or a
 * status for surface_status_text. If it does not, the surface is only fit for surface_free. */
imp_status surface_breach(const surface *s);

/* Domain; time is what the type and all maps have in common: lo[2] > hi[2] if nothing. */
void surface_domain(const surface *s, double lo[3], double hi[3]);

/* Beside the statuses of the ABI. A callback left another floating-point mode behind; it is put
 * back. Or the process of an isolated instance ended, or was ended because it did not answer. Or
 * what a callback gave breaks the ABI. */
#define SURFACE_CHANGED_MODE 1000
#define SURFACE_CRASHED 1001
#define SURFACE_HUNG 1002
#define SURFACE_BAD_DOMAIN 1003
#define SURFACE_BAD_RATES 1004
#define SURFACE_BAD_MODEL 1005

/* What a status other than IMP_OK means here, as the end of "type 'x' ...: ". */
const char *surface_status_text(imp_status status);

/* As imp_surface_type.eval, maps applied. error may be NULL. */
imp_status surface_eval(const surface *s, size_t n, const double *p, double *x, double *error);

/* Rate matrix of the composition (paper, section 5). */
imp_status surface_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates);

/* Inclusion of the composition; boxes from eval and rate where a part has no better. */
imp_status surface_include(const surface *s, const imp_region *region, imp_model model[3]);

#endif
