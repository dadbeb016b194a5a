/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/output_file.h"
#include "tools/view/animation.h"
#include "tools/view/html.h"
#include "tools/view/png.h"
#include "tools/view/storyboard.h"

/* What was written, for the line that is printed. */
typedef struct written {
    char what[64];
    double error_upper; /* length */
} written;

typedef struct format {
    const char *ending;
    imp_code (*write)(const subject *, const view_request *, FILE *, written *, imp_error *);
} format;

static imp_code write_png(const subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    raster r;
    canvas c = {request->width, request->height, &r, NULL};
    const bool begun =
        raster_begin(&r, (size_t)request->width, (size_t)request->height, (colour){1, 1, 1});
    imp_code code =
        begun ? storyboard_draw(what, request, &c, &w->error_upper, error) : mesh_no_memory(error);
    if (code == IMP_SUCCESS && !png_write_raster(file, &r)) code = mesh_no_memory(error);
    snprintf(w->what, sizeof w->what, "%gx%g pixels", request->width, request->height);
    raster_free(&r);
    return code;
}

static imp_code write_svg(const subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    canvas c = canvas_svg_begin(file, request->width, request->height);
    const imp_code code = storyboard_draw(what, request, &c, &w->error_upper, error);
    canvas_svg_end(&c);
    snprintf(w->what, sizeof w->what, "%gx%g pixels", request->width, request->height);
    return code;
}

/* --- Films --------------------------------------------------------------------------------- */

/* One moment, where no other is asked for: the contact's, or the start. */
static view_request one_moment(const subject *what, const view_request *request)
{
    view_request still = *request;
    if (!still.has_at)
        still.at = what->contact.verdict == IMP_CONTACT ? what->contact.t : what->options.t_start;
    still.has_at = true;
    return still;
}

static void tell_film(const film *f, written *w)
{
    size_t triangles = 0;
    for (size_t k = 0; k < f->count; ++k) triangles += mesh_triangle_count(f->tracks[k].mesh);
    w->error_upper = f->stage.error_upper;
    snprintf(w->what, sizeof w->what, "%zu moment%s, %zu triangles", f->frames,
             f->frames == 1 ? "" : "s", triangles);
}

typedef imp_code (*film_writer)(const film *, FILE *, imp_error *);

static imp_code write_film(const subject *what, const view_request *request, FILE *file, written *w,
                           imp_error *error, film_writer write)
{
    film f;
    imp_code code = film_make(what, request, &f, error);
    if (code == IMP_SUCCESS) code = write(&f, file, error);
    if (code == IMP_SUCCESS) tell_film(&f, w);
    film_free(&f);
    return code;
}

static imp_code write_obj(const subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    const view_request still = one_moment(what, request);
    return write_film(what, &still, file, w, error, animation_obj);
}

static imp_code first_vtu(const film *f, FILE *file, imp_error *error)
{
    return animation_vtu(f, 0, file, error);
}

static imp_code write_vtu(const subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    const view_request still = one_moment(what, request);
    return write_film(what, &still, file, w, error, first_vtu);
}

static imp_code write_glb(const subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    return write_film(what, request, file, w, error, animation_glb);
}

/* A collection consists of files with names of their own. */
static exit_status check_pvd(const view_request *request)
{
    const char *ending = request_ending(request->output);
    if (ending != NULL && strcmp(ending, ".pvd") == 0) return EXIT_ANSWERED;
    return complain(EXIT_USAGE, request->verb,
                    "--output must be a file that ends with .pvd, whose frames are files beside it, "
                    "not '%s'",
                    request->output);
}

/* One frame beside the collection, under its own name. */
static imp_code write_pvd_frame(const film *f, const view_request *request, size_t frame,
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

static imp_code write_pvd(const subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    film f;
    const char *slash = strrchr(request->output, '/');
    const char *base = slash != NULL ? slash + 1 : request->output;
    char *stem = strndup(base, (size_t)(strrchr(base, '.') - base));
    imp_code code = film_make(what, request, &f, error);
    if (code == IMP_SUCCESS && stem == NULL) code = mesh_no_memory(error);
    for (size_t k = 0; k < f.frames && code == IMP_SUCCESS; ++k)
        code = write_pvd_frame(&f, request, k, error);
    if (code == IMP_SUCCESS) code = animation_pvd(&f, stem, file, error);
    if (code == IMP_SUCCESS) tell_film(&f, w);
    free(stem);
    film_free(&f);
    return code;
}

/* From where the picture of the contact is taken. */
static imp_code look(const subject *what, const view_request *request, vec *toward,
                     imp_error *error)
{
    direction from = request->from;
    stage s;
    double *moment = malloc(sizeof *moment);
    if (moment != NULL) *moment = what->contact.t;
    imp_code code = storyboard_stage(what, request, moment, 1, &s, error);
    if (code == IMP_SUCCESS) code = storyboard_direction(&s, request, &from, error);
    stage_free(&s);
    *toward = camera_toward(from.azimuth, from.elevation).toward;
    return code;
}

enum { PAGE_SLICES = 120 };

static imp_code write_html(const subject *what, const view_request *request, FILE *file, written *w,
                           imp_error *error)
{
    film f;
    gap_profile gap = {0};
    regions proved = {0};
    html_page page = {&f, NULL, NULL, {{0, 0, 1}}};
    imp_code code = film_make(what, request, &f, error);
    if (code == IMP_SUCCESS) code = look(what, request, &page.toward, error);
    if (code == IMP_SUCCESS && f.frames > 1) {
        page.gap = &gap;
        code = gap_measure(what->scene, &what->options, PAGE_SLICES, 0.05, &gap, error);
    }
    if (code == IMP_SUCCESS && what->query != NULL) {
        page.regions = &proved;
        code = regions_measure(what, &f, &proved, error);
    }
    if (code == IMP_SUCCESS && html_write(&page, file, request->verb) != EXIT_ANSWERED)
        code = IMP_ERROR_FILE;
    if (code == IMP_SUCCESS) tell_film(&f, w);
    regions_free(&proved);
    gap_free(&gap);
    film_free(&f);
    return code;
}

static const format formats[] = {{".png", write_png},   {".svg", write_svg}, {".glb", write_glb},
                                 {".html", write_html}, {".obj", write_obj}, {".vtu", write_vtu},
                                 {".pvd", write_pvd}};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static const format *format_of(const char *ending)
{
    for (size_t k = 0; k < FORMATS && ending != NULL; ++k)
        if (strcmp(ending, formats[k].ending) == 0) return &formats[k];
    return NULL;
}

bool view_has(const char *ending)
{
    const format *f = format_of(ending);
    if (f == NULL) return false;
    if (f->write == write_html) return html_is_available();
    return f->write != write_png || png_is_available();
}

static exit_status unknown_format(const view_request *request)
{
    char all[128] = "";
    for (size_t k = 0; k < FORMATS; ++k)
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", k == 0 ? "" : ", ",
                 formats[k].ending);
    return complain(EXIT_USAGE, request->verb,
                    "--output must end with one of %s, or --format say which, not '%s'", all,
                    request->output);
}

exit_status view_check_output(const view_request *request)
{
    if (request->output == NULL)
        return complain(EXIT_USAGE, request->verb,
                        "where to? -o FILE is missing, such as -o %s.png", request->verb);
    const format *f = format_of(request->format);
    if (f == NULL) return unknown_format(request);
    if (f->write == write_pvd) return check_pvd(request);
    if (f->write == write_html) return html_check(request->output, request->verb);
    if (f->write == write_png) return png_check(request->output, request->verb);
    return EXIT_ANSWERED;
}

exit_status view_write(const subject *what, const view_request *request)
{
    output_file out;
    written w = {.error_upper = 0};
    imp_error error = {0};
    exit_status status = output_file_begin(&out, request->output, request->verb);
    if (status != EXIT_ANSWERED) return status;
    const imp_code code = format_of(request->format)->write(what, request, out.file, &w, &error);
    status = output_file_end(&out, code == IMP_SUCCESS);
    if (status != EXIT_ANSWERED) return status;
    if (code == IMP_ERROR_FILE && error.text[0] == '\0') return EXIT_DATA; /* complained of */
    if (code != IMP_SUCCESS) return complain_of(&error, request->verb);
    if (output_is_standard(request->output)) return EXIT_ANSWERED; /* the picture alone */
    printf("%s: %s, surfaces to within %s\n", message_shown(request->output).text, w.what,
           output_number_upper(w.error_upper).text);
    return output_flush(request->verb);
}
