/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_VIEW_FILM_H
#define TOOLS_VIEW_VIEW_FILM_H

#include <stdio.h>

#include "tools/view/view.h"

/* The formats that hold triangles, of one moment or of many. Each writes the whole file; an
 * IMP_ERROR_FILE without a text was reported already. */
imp_code view_write_glb(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error);
imp_code view_write_html(subject *what, const view_request *request, FILE *file, written *w,
                         imp_error *error);
imp_code view_write_obj(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error);
imp_code view_write_vtu(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error);
imp_code view_write_pvd(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error);

#endif
