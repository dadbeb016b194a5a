# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# All functions of public headers as a table in C, on standard output: api_table.awk HEADER...
# For each one there is a function call_NAME, which calls it with values by their numbers, and a row of
# API_TABLE; test_api.c says what is done with them. A parameter's type is written as one word,
# imp_scene_p for a pointer or an array; how many there are of something is of type `count`.

# Comments and lines of the preprocessor go; the rest is one text, in which declarations end with ; or {.
{ sub(/^#.*/, ""); text = text " " $0 }

END {
    while (match(text, /\/\*([^*]|\*+[^*\/])*\*+\//))
        text = substr(text, 1, RSTART - 1) " " substr(text, RSTART + RLENGTH)
    gsub(/[ \t]+/, " ", text)
    while (match(text, /(IMP_EXPORT|static inline) [^;{}()]*\([^()]*(\([^()]*\)[^()]*)*\) ?[;{]/)) {
        declaration = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        write_function(declaration)
    }
    print "#define API_TABLE \\\n" rows
}

function type_of(parameter,    stars, name) {
    gsub(/const|struct/, "", parameter)
    stars = gsub(/\*/, "", parameter) + gsub(/\[[^\]]*\]/, "", parameter)
    name = parameter
    sub(/ +$/, "", name)
    sub(/.* /, "", name)
    if (stars == 0 && (name == "n" || name == "length" || name == "count")) return "count"
    sub(/^ +/, "", parameter)
    sub(/ .*/, "", parameter)
    while (stars-- > 0) parameter = parameter "_p"
    return parameter
}

function write_function(declaration,    list, name, answer, n, k, of, values, counts, kinds) {
    sub(/^(IMP_EXPORT|static inline) /, "", declaration)
    sub(/ ?[;{]$/, "", declaration)
    name = substr(declaration, 1, index(declaration, "(") - 1)
    list = substr(declaration, index(declaration, "(") + 1)
    sub(/\)$/, "", list)
    answer = name
    sub(/.*[ *]/, "", name)
    answer = type_of(substr(answer, 1, length(answer) - length(name)) " x")
    n = list == "void" ? 0 : split(list, of, /, */)
    for (k = 1; k <= n; ++k) {
        values = values (k > 1 ? ", " : "") "API_VALUE(" type_of(of[k]) ", pick[" k - 1 "])"
        counts = counts "API_COUNT(" type_of(of[k]) "), "
        kinds = kinds "\"" type_of(of[k]) "\", "
    }
    print "static bool call_" name "(const size_t *pick)\n{\n    (void)pick;"
    print "    return API_REFUSED_" answer "(" name "(" values "));\n}\n"
    rows = rows "    {\"" name "\", call_" name ", " n ", {" kinds "NULL}, {" counts "0}}, \\\n"
}
