/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/version.h"

#include <stdio.h>

#include "core/common/capabilities.h"
#include "tools/cli/output.h"

static json_t *capability_json(const capability_row *row)
{
    json_t *kinds = json_array();
    if (row->of_surface != NULL) json_array_append_new(kinds, json_string("surface"));
    if (row->of_map != NULL) json_array_append_new(kinds, json_string("map"));
    return json_pack("{s:s, s:o}", "name", row->name, "kinds", kinds);
}

static json_t *abi_json(void)
{
    json_t *list = json_array();
    bool kept = list != NULL;
    for (int k = 0; kept && k < CAPABILITIES; ++k)
        kept = json_array_append_new(list, capability_json(&capabilities[k])) == 0;
    if (!kept) {
        json_decref(list);
        return NULL;
    }
    return json_pack("{s:i, s:i, s:[s, s, s], s:o}", "major", IMP_ABI_MAJOR, "minor", IMP_ABI_MINOR,
                     "factories", IMP_SURFACE_FACTORY, IMP_MAP_FACTORY, IMP_BUILD_FACTORY,
                     "capabilities", list);
}

exit_status version_print(const arguments *args)
{
    if (arguments_option(args, "json") == NULL) {
        printf("impinge %s (%s)\n", PACKAGE_VERSION, imp_version());
        return EXIT_ANSWERED;
    }
    return output_json(json_pack("{s:s, s:o, s:o}", "version", PACKAGE_VERSION, "library",
                                 output_json_text(imp_version()), "abi", abi_json()),
                       NULL);
}
