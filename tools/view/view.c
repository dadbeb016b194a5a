/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/view.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "tools/cli/output.h"
#include "tools/cli/output_file.h"
#include "tools/view/html.h"
#include "tools/view/png.h"
#include "tools/view/storyboard.h"
#include "tools/view/view_film.h"

/* --- Pictures --------------------------------------------------------------------------------- */

static void tell_picture(const view_request *request, written *w)
{
    w->width = (size_t)request->width, w->height = (size_t)request->height;
}

/* Write errors are reported when the file is closed. */
static imp_code write_png(subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    raster r = {.width = 0};
    canvas c = {request->width, request->height, &r, NULL};
    tell_picture(request, w);
    imp_code code = allowance_check_bytes(&what->allowance, raster_bytes(c.width, c.height),
                                          "pixels were kept", error);
    if (code == IMP_SUCCESS && !raster_begin(&r, w->width, w->height, (colour){1, 1, 1}))
        code = mesh_no_memory(error);
    if (code == IMP_SUCCESS) code = storyboard_draw(what, request, &c, &w->error_upper, error);
    if (code == IMP_SUCCESS && !png_write_raster(file, &r) && !ferror(file))
        code = mesh_no_memory(error);
    raster_free(&r);
    return code;
}

static imp_code write_svg(subject *what, const view_request *request, FILE *file, written *w,
                          imp_error *error)
{
    canvas c = canvas_svg_begin(file, request->width, request->height);
    tell_picture(request, w);
    const imp_code code = storyboard_draw(what, request, &c, &w->error_upper, error);
    canvas_svg_end(&c);
    return code;
}

/* --- Formats ---------------------------------------------------------------------------------- */

typedef struct format {
    const char *ending;
    imp_code (*write)(subject *, const view_request *, FILE *, written *, imp_error *);
} format;

static const format formats[] = {{".png", write_png},      {".svg", write_svg},
                                 {".glb", view_write_glb}, {".html", view_write_html},
                                 {".obj", view_write_obj}, {".vtu", view_write_vtu},
                                 {".pvd", view_write_pvd}};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static const format *format_of(const char *ending)
{
    for (size_t k = 0; k < FORMATS && ending != NULL; ++k)
        if (strcasecmp(ending, formats[k].ending) == 0) return &formats[k];
    return NULL;
}

bool view_has(const char *ending)
{
    const format *f = format_of(ending);
    if (f == NULL) return false;
    if (f->write == view_write_html) return html_is_available();
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

/* A collection consists of files with names of their own. */
static exit_status check_collection(const view_request *request)
{
    const char *ending = request_ending(request->output);
    if (ending != NULL && strcasecmp(ending, ".pvd") == 0) return EXIT_ANSWERED;
    return complain(
        EXIT_USAGE, request->verb,
        "--output must be a file that ends with .pvd, whose frames are files beside it, "
        "not '%s'",
        request->output);
}

exit_status view_check_output(const view_request *request)
{
    if (request->output == NULL)
        return complain(EXIT_USAGE, request->verb,
                        "where to? -o FILE is missing, such as -o %s.png", request->verb);
    const format *f = format_of(request->format);
    if (f == NULL) return unknown_format(request);
    if (f->write == view_write_pvd) return check_collection(request);
    if (f->write == view_write_html) return html_check(request->output, request->verb);
    if (f->write == write_png) return png_check(request->output, request->verb);
    return EXIT_ANSWERED;
}

exit_status view_write(subject *what, const view_request *request, written *w)
{
    output_file out;
    imp_error error = {0};
    *w = (written){.error_upper = 0};
    exit_status status = output_file_begin(&out, request->output, request->verb);
    if (status != EXIT_ANSWERED) return status;
    allowance_begin_drawing(&what->allowance);
    const imp_code code = format_of(request->format)->write(what, request, out.file, w, &error);
    status = output_file_end(&out, code == IMP_SUCCESS);
    if (status != EXIT_ANSWERED) return status;
    if (code == IMP_ERROR_FILE && error.text[0] == '\0') return EXIT_DATA; /* complained of */
    if (code == IMP_SUCCESS) return status;
    if (!allowance_ended(&what->allowance)) return complain_of(&error, request->verb);
    return complain(EXIT_UNDECIDED, request->verb, "%s; nothing was written", error.text);
}

/* --- The report ------------------------------------------------------------------------------- */

static json_t *written_json(const view_request *request, const written *w)
{
    json_t *object = json_pack("{s:o, s:o}", "file", output_json_text(request->output),
                               "surfaces_within", output_json_number(w->error_upper));
    const bool picture = w->width > 0;
    const size_t first = picture ? w->width : w->moments,
                 second = picture ? w->height : w->triangles;
    if (json_object_set_new(object, picture ? "width" : "moments",
                            json_integer((json_int_t)first)) == 0 &&
        json_object_set_new(object, picture ? "height" : "triangles",
                            json_integer((json_int_t)second)) == 0)
        return object;
    json_decref(object);
    return NULL;
}

static void print_written(const view_request *request, const written *w)
{
    const char *file = message_shown(request->output).text;
    if (w->width > 0)
        printf("%s: %zux%zu pixels", file, w->width, w->height);
    else
        printf("%s: %zu moment%s, %zu triangles", file, w->moments, w->moments == 1 ? "" : "s",
               w->triangles);
    printf(", surfaces to within %s\n", output_number_upper(w->error_upper).text);
}

exit_status view_write_and_tell(subject *what, const view_request *request)
{
    written w;
    const exit_status status = view_write(what, request, &w);
    if (status != EXIT_ANSWERED || output_is_standard(request->output)) return status;
    if (request->json) return output_json(written_json(request, &w), request->verb);
    print_written(request, &w);
    return output_flush(request->verb);
}
