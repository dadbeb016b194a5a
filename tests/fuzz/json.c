/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/parameters.h"
#include "core/reader/json_quick.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_mutate.h"
#include "tests/support/same_json.h"

/* What the quick reader makes of any bytes, jansson makes of them too; what jansson refuses, it
 * leaves to jansson. A budget ends the reading exactly if the values need more. */

const char fuzz_target[] = "json";

FUZZ_MUTATE_TEXT

enum { WIDE = 1 << 30 }; /* bytes: more than the values of any input */

/* Takes from the budget what the values need, and gives them, or how it ended. */
static json_t *parse(const unsigned char *bytes, size_t length, reading_budget *budget,
                     json_quick_end *end)
{
    json_t *value = json_quick_parse((const char *)bytes, length, budget, end);
    FUZZ_REQUIRE((value != NULL) == (*end == JSON_QUICK_DONE));
    FUZZ_REQUIRE(*end != JSON_QUICK_LEFT || budget->bytes == 0);
    FUZZ_REQUIRE((*end == JSON_QUICK_LIMIT) == reading_budget_is_over(budget));
    return value;
}

static void parse_within(const unsigned char *bytes, size_t length, uint64_t limit,
                         json_quick_end expected)
{
    reading_budget budget = {.limits = {.bytes = limit}};
    json_quick_end end;
    json_decref(parse(bytes, length, &budget, &end));
    FUZZ_REQUIRE(end == expected);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    reading_budget budget = {.limits = {.bytes = WIDE}};
    json_error_t fault;
    json_quick_end end;
    json_t *found = parse(bytes, length, &budget, &end);
    json_t *expected = json_loadb((const char *)bytes, length, PARAMETERS_JSON_FLAGS, &fault);
    FUZZ_REQUIRE(end == JSON_QUICK_DONE || end == JSON_QUICK_LEFT);
    if (found != NULL) {
        FUZZ_REQUIRE(expected != NULL && same_json(found, expected));
        FUZZ_REQUIRE(budget.bytes > 0);
        parse_within(bytes, length, budget.bytes, JSON_QUICK_DONE);
        if (budget.bytes > 1) parse_within(bytes, length, budget.bytes - 1, JSON_QUICK_LIMIT);
    }
    json_decref(found);
    json_decref(expected);
    return 0;
}
