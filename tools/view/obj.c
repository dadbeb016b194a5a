/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <ctype.h>

#include "tools/view/animation.h"

typedef struct obj {
    FILE *file;
    size_t before; /* points of objects before this one */
} obj;

static void put_face(void *context, const mesh *m, const size_t c[3], size_t cell)
{
    const obj *o = context;
    (void)m, (void)cell;
    fputs("f", o->file);
    for (int k = 0; k < 3; ++k) {
        const size_t n = o->before + c[k] + 1;
        fprintf(o->file, " %zu/%zu/%zu", n, n, n);
    }
    fputs("\n", o->file);
}

/* OBJ ends a name at a blank. */
static void put_name(FILE *file, const char *name, size_t surface)
{
    fputs("o ", file);
    for (; *name != '\0'; ++name) fputc(isgraph((unsigned char)*name) ? *name : '_', file);
    fprintf(file, "_%zu\n", surface);
}

static void put_points(FILE *file, const track *t, const mesh_patch *p)
{
    const double *u = mesh_u(t->mesh, p), *v = mesh_v(t->mesh, p);
    for (size_t k = 0; k < p->nu * p->nv; ++k) {
        const double *x = t->point[p->first_point + k].x, *n = t->normal[p->first_point + k].x;
        fprintf(file, "v %.9g %.9g %.9g\nvt %.9g %.9g\nvn %.6g %.6g %.6g\n", x[0], x[1], x[2],
                u[k / p->nv], v[k % p->nv], n[0], n[1], n[2]);
    }
}

imp_code animation_obj(const film *f, FILE *file, imp_error *error)
{
    obj o = {file, 0};
    (void)error;
    fprintf(file, "# impinge, t = %.17g, surfaces to within %.3g\n", f->times[0],
            f->stage.error_upper);
    for (size_t k = 0; k < f->count; ++k) {
        const track *t = &f->tracks[k];
        const mesh *m = t->mesh;
        if (!t->there[0]) continue;
        put_name(file, imp_scene_body_name(f->stage.scene, m->body), m->surface);
        for (size_t p = 0; p < m->patch_count; ++p) put_points(file, t, &m->patches[p]);
        mesh_triangles(m, put_face, &o);
        o.before += t->count;
    }
    return IMP_SUCCESS;
}
