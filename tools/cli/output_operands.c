/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/output_operands.h"

#include "tools/cli/input.h"
#include "tools/cli/output_target.h"

exit_status output_spares_operands(const arguments *args, const char *name)
{
    const option_value *output = arguments_option(args, name);
    if (output == NULL || output_is_standard(output->text)) return EXIT_ANSWERED;
    for (size_t k = 0; k < args->operand_count; ++k)
        if (input_is_file(output->text) && input_is_same(output->text, args->operands[k]))
            return complain(EXIT_USAGE, args->verb->name,
                            "--%s %s is what is read, and would be overwritten; name another file",
                            name, output->text);
    return EXIT_ANSWERED;
}
