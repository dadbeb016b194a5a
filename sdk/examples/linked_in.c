/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#include <impinge/impinge.h>
#include <stdio.h>

/* A program that brings its types along: no folder is searched, no file loaded. Each plugin is
 * compiled with a name of its own for its one symbol, and all is linked with the archive
 * libimpinge.a:
 *
 *     for name in seashell twirl hand_rates; do
 *         cc -c -O2 -ffp-contract=off -DIMPINGE_PLUGIN_SYMBOL=${name}_plugin $name.c \
 *             $(pkg-config --cflags impinge-sdk)
 *     done
 *     cc -static linked_in.c seashell.o twirl.o hand_rates.o \
 *         $(pkg-config --static --cflags --libs impinge) -o linked_in */

extern const imp_plugin seashell_plugin, twirl_plugin, hand_rates_plugin;

static int fail(const imp_error *error)
{
    fprintf(stderr, "%s\n", error->text);
    return 1;
}

int main(void)
{
    const imp_plugin *const plugins[] = {&seashell_plugin, &twirl_plugin, &hand_rates_plugin};
    imp_error error = {IMP_SUCCESS, ""};
    imp_registry *registry = imp_registry_open(NULL, IMP_REGISTRY_ONLY_PATH);
    if (registry == NULL) return 2;
    for (size_t k = 0; k < sizeof plugins / sizeof *plugins; ++k)
        if (imp_registry_add(registry, plugins[k], &error) != IMP_SUCCESS) return fail(&error);

    imp_type_info type;
    for (size_t k = 0; imp_registry_type(registry, k, &type); ++k)
        printf("%s %s, %s\n", type.kind == IMP_TYPE_SURFACE ? "surface" : "map", type.name,
               type.file);

    imp_scene *scene = imp_scene_from_pair(registry, "seashell center=0,0,-4 ! twirl speed=2",
                                           "blade speed=1", &error);
    if (scene == NULL) return fail(&error);
    imp_options options = imp_options_default(scene);
    imp_result result = {.struct_size = sizeof result};
    options.t_end = 0.5;
    if (imp_scene_solve(scene, &options, &result, &error) != IMP_SUCCESS) return fail(&error);
    printf("%s\n", result.verdict == IMP_VERDICT_CLEAR ? "clear" : "not clear");
    imp_scene_free(scene);
    imp_registry_free(registry);
    return 0;
}
