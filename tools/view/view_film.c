/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/view_film.h"

#include <stdlib.h>
#include <string.h>

#include "tools/cli/output_file.h"
#include "tools/view/animation.h"
#include "tools/view/camera.h"
#include "tools/view/html.h"
#include "tools/view/storyboard.h"

/* Returns a request of one moment: --at, or else the contact, or the start. */
static view_request one_moment(const subject *what, const view_request *request)
{
    view_request still = *request;
    if (still.at_kind != REQUEST_AT_ALL) return still;
    still.at_kind = REQUEST_AT_TIME;
    still.at = what->spot.is_contact ? what->spot.t : what->options.t_start;
    return still;
}

static void tell_film(const film *f, written *w)
{
    w->error_upper = f->stage.error_upper;
    w->moments = f->frames;
    for (size_t k = 0; k < f->count; ++k) w->triangles += f->tracks[k].mesh->triangle_count;
}

typedef imp_code (*film_writer)(const film *, FILE *, imp_error *);

static imp_code write_film(subject *what, const view_request *request, FILE *file, written *w,
                           imp_error *error, film_writer write)
{
    film f;
    imp_code code = film_make(what, request, &f, error);
    if (code == IMP_SUCCESS) code = write(&f, file, error);
    if (code == IMP_SUCCESS) tell_film(&f, w);
    film_free(&f);
    return code;
}

imp_code view_write_glb(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error)
{
    return write_film(what, request, file, w, error, animation_glb);
}

imp_code view_write_obj(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error)
{
    const view_request still = one_moment(what, request);
    return write_film(what, &still, file, w, error, animation_obj);
}

/* --- VTK -------------------------------------------------------------------------------------- */

static imp_code first_vtu(const film *f, FILE *file, imp_error *error)
{
    return animation_vtu(f, 0, file, error);
}

imp_code view_write_vtu(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error)
{
    const view_request still = one_moment(what, request);
    return write_film(what, &still, file, w, error, first_vtu);
}

/* Writes one frame into its own file beside the collection. */
static imp_code write_frame(const film *f, const view_request *request, size_t frame,
                            imp_error *error)
{
    output_file out;
    char path[4096];
    const int stem = (int)(request_ending(request->output) - request->output);
    if (snprintf(path, sizeof path, "%.*s_%04zu.vtu", stem, request->output, frame) >=
        (int)sizeof path)
        return mesh_no_memory(error);
    if (output_file_begin(&out, path, request->verb) != EXIT_ANSWERED) return IMP_ERROR_FILE;
    const imp_code code = animation_vtu(f, frame, out.file, error);
    return output_file_end(&out, code == IMP_SUCCESS) == EXIT_ANSWERED ? code : IMP_ERROR_FILE;
}

imp_code view_write_pvd(subject *what, const view_request *request, FILE *file, written *w,
                        imp_error *error)
{
    film f;
    const char *slash = strrchr(request->output, '/');
    const char *base = slash != NULL ? slash + 1 : request->output;
    char *stem = strndup(base, (size_t)(strrchr(base, '.') - base));
    imp_code code = film_make(what, request, &f, error);
    if (code == IMP_SUCCESS && stem == NULL) code = mesh_no_memory(error);
    for (size_t k = 0; k < f.frames && code == IMP_SUCCESS; ++k) {
        code = allowance_check(&what->allowance, "files were written", error);
        if (code == IMP_SUCCESS) code = write_frame(&f, request, k, error);
    }
    if (code == IMP_SUCCESS) code = animation_pvd(&f, stem, file, error);
    if (code == IMP_SUCCESS) tell_film(&f, w);
    free(stem);
    film_free(&f);
    return code;
}

/* --- A page ----------------------------------------------------------------------------------- */

/* Chooses a direction from which the spot is visible. */
static imp_code look(film *f, const view_request *request, vec *toward, imp_error *error)
{
    direction from = request->from;
    const double upper = f->stage.error_upper;
    const imp_code code = storyboard_direction(&f->stage, request, &from, error);
    f->stage.error_upper = upper;
    *toward = camera_toward(from.azimuth, from.elevation).toward;
    return code;
}

enum { PAGE_SLICES = 120 };

static imp_code measure_page(subject *what, html_page *page, imp_error *error)
{
    imp_options options = what->options;
    options.max_seconds = allowance_left(&what->allowance, 0.3);
    imp_code code = page->film->frames > 1
                        ? gap_measure(what->scene, &options, PAGE_SLICES, 0.05, &page->gap, error)
                        : IMP_SUCCESS;
    if (code == IMP_SUCCESS && page->film->frames > 1)
        code = gap_at_moments(what->scene, &options, &what->allowance, page->film->times,
                              page->film->frames, &page->moments, error);
    if (code == IMP_SUCCESS && what->query != NULL)
        code = regions_measure(what, page->film, &page->regions, error);
    return code;
}

imp_code view_write_html(subject *what, const view_request *request, FILE *file, written *w,
                         imp_error *error)
{
    film f = {.spot_frame = SIZE_MAX};
    html_page page = {
        .film = &f, .events = &what->events, .title = what->title, .axis = what->axis};
    imp_code code = subject_find_nearest(what, error);
    if (code == IMP_SUCCESS) code = film_make(what, request, &f, error);
    if (code == IMP_SUCCESS) code = look(&f, request, &page.toward, error);
    if (code == IMP_SUCCESS) code = measure_page(what, &page, error);
    if (code == IMP_SUCCESS)
        code = allowance_check(&what->allowance, "the page was written", error);
    if (code == IMP_SUCCESS && html_write(&page, file, request->verb) != EXIT_ANSWERED)
        code = IMP_ERROR_FILE;
    if (code == IMP_SUCCESS) tell_film(&f, w);
    regions_free(&page.regions);
    gap_free(&page.gap);
    gap_free(&page.moments);
    film_free(&f);
    return code;
}
