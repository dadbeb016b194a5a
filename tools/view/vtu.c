/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/animation.h"

typedef struct vtu {
    FILE *file;
    size_t before, frame;
} vtu;

static void put_triangle(void *context, const mesh *m, const size_t c[3], size_t cell)
{
    const vtu *v = context;
    (void)m, (void)cell;
    fprintf(v->file, "%zu %zu %zu\n", v->before + c[0], v->before + c[1], v->before + c[2]);
}

typedef void (*put_values)(const track *t, const vtu *v);

static void put_points(const track *t, const vtu *v)
{
    for (size_t i = 0; i < t->count; ++i) {
        const vec p = track_point(t, v->frame, i);
        fprintf(v->file, "%.9g %.9g %.9g\n", p.x[0], p.x[1], p.x[2]);
    }
}

static void put_normals(const track *t, const vtu *v)
{
    for (size_t i = 0; i < t->count; ++i) {
        const vec n = track_normal(t, v->frame, i);
        fprintf(v->file, "%.6g %.6g %.6g\n", n.x[0], n.x[1], n.x[2]);
    }
}

static void put_parameters(const track *t, const vtu *v)
{
    const mesh *m = t->mesh;
    for (size_t k = 0; k < m->patch_count; ++k) {
        const mesh_patch *p = &m->patches[k];
        for (size_t i = 0; i < p->nu * p->nv; ++i)
            fprintf(v->file, "%.9g %.9g\n", mesh_u(m, p)[i / p->nv], mesh_v(m, p)[i % p->nv]);
    }
}

static void put_connectivity(const track *t, const vtu *v)
{
    vtu here = *v;
    mesh_triangles(t->mesh, put_triangle, &here);
}

static void put_bodies(const track *t, const vtu *v)
{
    for (size_t i = t->mesh->triangle_count; i > 0; --i) fprintf(v->file, "%zu\n", t->mesh->body);
}

static void put_surfaces(const track *t, const vtu *v)
{
    for (size_t i = t->mesh->triangle_count; i > 0; --i)
        fprintf(v->file, "%zu\n", t->mesh->surface);
}

static void put_array(const film *f, size_t frame, FILE *file, const char *attributes,
                      put_values put)
{
    vtu v = {file, 0, frame};
    fprintf(file, "<DataArray %s format=\"ascii\">\n", attributes);
    for (size_t k = 0; k < f->count; ++k) {
        if (!f->tracks[k].there[frame]) continue;
        put(&f->tracks[k], &v);
        v.before += f->tracks[k].count;
    }
    fputs("</DataArray>\n", file);
}

static void put_cells(const film *f, size_t frame, size_t triangles, FILE *file)
{
    fputs("<Cells>\n", file);
    put_array(f, frame, file, "type=\"Int64\" Name=\"connectivity\"", put_connectivity);
    fputs("<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n", file);
    for (size_t i = 1; i <= triangles; ++i) fprintf(file, "%zu\n", 3 * i);
    fputs("</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n", file);
    for (size_t i = 0; i < triangles; ++i) fputs("5\n", file);
    fputs("</DataArray>\n</Cells>\n", file);
}

imp_code animation_vtu(const film *f, size_t frame, FILE *file, imp_error *error)
{
    size_t points = 0, triangles = 0;
    (void)error;
    for (size_t k = 0; k < f->count; ++k) {
        if (!f->tracks[k].there[frame]) continue;
        points += f->tracks[k].count;
        triangles += f->tracks[k].mesh->triangle_count;
    }
    fprintf(file,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
            "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"ascii\">%.17g</DataArray></FieldData>\n"
            "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n<Points>\n",
            f->times[frame], points, triangles);
    put_array(f, frame, file, "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"",
              put_points);
    fputs("</Points>\n", file);
    put_cells(f, frame, triangles, file);
    fputs("<PointData Normals=\"normal\">\n", file);
    put_array(f, frame, file, "type=\"Float64\" Name=\"normal\" NumberOfComponents=\"3\"",
              put_normals);
    put_array(f, frame, file, "type=\"Float64\" Name=\"uv\" NumberOfComponents=\"2\"",
              put_parameters);
    fputs("</PointData>\n<CellData>\n", file);
    put_array(f, frame, file, "type=\"Int64\" Name=\"body\"", put_bodies);
    put_array(f, frame, file, "type=\"Int64\" Name=\"surface\"", put_surfaces);
    fputs("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", file);
    return IMP_SUCCESS;
}

imp_code animation_pvd(const film *f, const char *stem, FILE *file, imp_error *error)
{
    (void)error;
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n",
          file);
    for (size_t k = 0; k < f->frames; ++k) {
        fprintf(file, "<DataSet timestep=\"%.17g\" file=\"", f->times[k]);
        for (const char *c = stem; *c != '\0'; ++c) {
            if (*c == '&')
                fputs("&amp;", file);
            else if (*c == '<')
                fputs("&lt;", file);
            else if (*c == '"')
                fputs("&quot;", file);
            else
                fputc(*c, file);
        }
        fprintf(file, "_%04zu.vtu\"/>\n", k);
    }
    fputs("</Collection>\n</VTKFile>\n", file);
    return IMP_SUCCESS;
}
