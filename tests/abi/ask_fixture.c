/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Prints what the types of fixture_1_0.so answer, digit by digit: asked by the host, and called as
 * the header of today says. Usage: ask_fixture FOLDER. */

#include <dlfcn.h>
#include <impinge/impinge.h>
#include <impinge/model_arithmetic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fail(const char *what, const char *why)
{
    fprintf(stderr, "ask_fixture: %s: %s\n", what, why);
    exit(1);
}

static void print(const char *name, const double *x, size_t n)
{
    printf("  %s", name);
    for (size_t k = 0; k < n; ++k) printf(" %a", x[k]);
    putchar('\n');
}

/* --- Through the host ------------------------------------------------------------------------- */

static void ask_host(imp_registry *registry, const char *pipeline)
{
    const double p[6] = {0.25, 0.5, 0.75, 1, 0, 1.25};
    double x[6], off[6], lo[3], hi[3];
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, pipeline, pipeline, &error);
    printf("%s\n", pipeline);
    if (scene == NULL) {
        printf("  refused%s\n", strstr(error.text, "found 'no'") != NULL ? " by the plugin" : "");
        return;
    }
    if (imp_scene_eval(scene, 0, 0, 2, p, x, off, &error) != IMP_SUCCESS) fail("eval", error.text);
    imp_scene_domain(scene, 0, 0, lo, hi);
    print("points", x, 6);
    if (strchr(pipeline, '!') == NULL) print("errors", off, 6); /* those of maps are the host's */
    print("lo", lo, 3);
    print("hi", hi, 3);
    imp_scene_free(scene);
}

/* --- As the header says ----------------------------------------------------------------------- */

static void print_models(const imp_model model[3])
{
    for (int i = 0; i < 3; ++i) {
        const imp_model *m = &model[i];
        print("quadratic", (const double[]){m->a, m->b[0], m->b[1], m->b[2]}, 4);
        print("squares", m->q, 6);
        print("remainder, range", (const double[]){m->e, m->lo, m->hi}, 3);
        print("rates", m->rate, 3);
        printf("  depends %u %u\n", m->depends, m->reserved);
    }
}

static void print_net(const imp_net *net)
{
    const size_t points = (net->degree[0] + 1) * (net->degree[1] + 1);
    printf("  degrees %u %u moving %u weighted %u\n", net->degree[0], net->degree[1],
           net->is_moving, net->is_weighted);
    print("place", net->place, 3);
    print("drift", net->drift, 3);
    print("error", net->error, 3);
    for (int i = 0; i < 3; ++i) print("points", net->point[i], points);
    for (int i = 0; i < 3; ++i) print("velocities", net->velocity[i], points);
}

static void ask_surface(const imp_surface_type *type, const imp_model in[4],
                        const imp_region *region)
{
    void *self;
    imp_rate_matrix rates;
    imp_model model[3];
    if (type->parameter_count > 0 || type->create(NULL, &self, NULL) != IMP_STATUS_OK) return;
    printf("%s\n", type->name);
    printf("  rate answers %d\n", type->rate(self, region, &rates));
    print("rates", &rates.m[0][0], 9);
    if (type->include != NULL) {
        printf("  include answers %d\n", type->include(self, region, model));
        print_models(model);
    }
    if (type->net != NULL) {
        imp_net net = {.degree = {0, 0}};
        printf("  net answers %d\n", type->net(self, region, &net));
        print_net(&net);
    }
    const size_t least = offsetof(imp_surface_type, distance) + sizeof type->distance;
    if (type->struct_size >= least && type->distance != NULL) {
        imp_model gap[3];
        const imp_model above[4] = {in[0], in[1], imp_shift(in[2], 4), in[3]};
        memset(gap, 0, sizeof gap);
        printf("  distance answers %d\n", type->distance(self, above, &gap[0]));
        print_models(gap);
    }
    type->destroy(self);
}

static void ask_map(const imp_map_type *type, const imp_model in[4], const imp_region *region)
{
    void *self;
    imp_map_rates rates;
    imp_model out[3];
    const imp_box4 box = {{0, 0.5, -1, 0}, {1, 1.5, 2, 0.5}};
    if (type->parameter_count > 0 || type->create(NULL, &self, NULL) != IMP_STATUS_OK) return;
    printf("%s\n", type->name);
    printf("  rate answers %d\n", type->rate(self, &box, &rates));
    print("rates", &rates.m[0][0], 12);
    if (type->apply != NULL) {
        printf("  apply answers %d\n", type->apply(self, in, out));
        print_models(out);
    }
    if (type->net != NULL) {
        imp_net net = {.place = {1, 2, 3}, .drift = {0.5, 0.25, 0.125}, .error = {0, 0, 0x1p-30}};
        printf("  net answers %d\n", type->net(self, region, &net));
        print_net(&net);
    }
    if (type->struct_size >= offsetof(imp_map_type, rigid) + sizeof type->rigid &&
        type->rigid != NULL) {
        imp_pose pose;
        memset(&pose, 0, sizeof pose);
        printf("  rigid answers %d\n", type->rigid(self, &in[3], &pose));
        for (int i = 0; i < 3; ++i) {
            const imp_model *row = pose.turn[i];
            print("turn", (double[3]){row[0].a, row[1].a, row[2].a}, 3);
        }
        print_models(pose.shift);
        print("pivot", pose.pivot, 3);
    }
    type->destroy(self);
}

/* x, y, z, t as u, v, u, t over the region. */
static void models_of(const imp_region *r, imp_model in[4])
{
    const int parameter[4] = {0, 1, 0, 2};
    for (int k = 0; k < 4; ++k) {
        const int j = parameter[k];
        memset(&in[k], 0, sizeof in[k]);
        in[k].a = r->c[j], in[k].b[j] = r->d[j];
        in[k].lo = r->lo[j], in[k].hi = r->hi[j];
        in[k].rate[j] = 1, in[k].depends = 1u << j;
    }
}

static void ask_plugin(const imp_plugin *plugin)
{
    const imp_region region = {{0.25, 0.5, 1}, {0.5, 1, 2}, {0.375, 0.75, 1.5}, {0.125, 0.25, 0.5}};
    const imp_surface_factory *surfaces = plugin->get_factory(IMP_SURFACE_FACTORY);
    const imp_map_factory *maps = plugin->get_factory(IMP_MAP_FACTORY);
    imp_model in[4];
    printf("%s %s %s %u.%u\n", plugin->name, plugin->version, plugin->license, plugin->abi_major,
           plugin->abi_minor);
    models_of(&region, in);
    for (uint32_t i = 0; i < surfaces->count; ++i) ask_surface(surfaces->types[i], in, &region);
    for (uint32_t i = 0; i < maps->count; ++i) ask_map(maps->types[i], in, &region);
}

static void ask_file(const char *folder)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/fixture_1_0.so", folder);
    void *file = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (file == NULL) fail(path, dlerror());
    const imp_plugin *plugin = dlsym(file, "impinge_plugin");
    if (plugin == NULL) fail(path, dlerror());
    ask_plugin(plugin);
    dlclose(file);
}

int main(int argc, char **argv)
{
    if (argc != 2) fail("usage", "ask_fixture FOLDER");
    imp_registry *registry = imp_registry_new(argv[1]);
    if (registry == NULL) fail("registry", "no memory");
    ask_host(registry, "fixture_kinds number=0.5");
    ask_host(registry, "fixture_kinds number=9 integer=-2 boolean=false string=maybe "
                       "table={\"one\":1,\"two\":2} vector=1,2,3 points=[[1,2,3],[4,5,6]] "
                       "list=[1,2] absent=7");
    ask_host(registry, "fixture_kinds number=10");
    ask_host(registry, "fixture_kinds number=1 string=no");
    ask_host(registry, "fixture_sheet");
    ask_host(registry, "fixture_bare");
    ask_host(registry, "fixture_sheet ! fixture_lean");
    ask_host(registry, "fixture_bare ! fixture_rise ! fixture_lean");
    imp_registry_free(registry);
    ask_file(argv[1]);
    return 0;
}
