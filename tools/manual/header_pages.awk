# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Manual pages of section 3 from the comments of public headers, so that the two cannot differ:
#     awk -v to=FOLDER -v version=X.Y.Z -f header_pages.awk HEADER...
# A headline "/* --- Query: the earliest contact --- */", or the underlined title of a header, sends
# what follows it to the page imp_query. Each function and each struct gets a page that leads there
# (".so man3/imp_query.3"). A comment that a blank line follows is a paragraph; any other one
# describes the declarations below it, up to a blank line. Lines that are indented stay as they are.

FNR == 1 {
    end_of_chunk()
    include = FILENAME
    sub(/.*\//, "impinge/", include)
    in_comment = in_body = guarded = 0
}

# What only C++ sees, and the preprocessor, but for texts that programs use.
/^#ifdef __cplusplus/ { guarded = 1 }
guarded { if (/^#endif/) guarded = 0; next }
/^#define IMP_[A-Z_]* / { declared[++declarations] = $0; next }
/^#/ || /SPDX-/ { next }

# The body of an inline function.
in_body { if (/^}/) { in_body = 0; end_of_chunk() } next }
/^static inline/ { inline_function = 1 }
/^{/ && inline_function {
    inline_function = 0
    in_body = 1
    declared[declarations] = declared[declarations] ";"
    next
}

/^\/\* --- .* -+ \*\/$/ {
    end_of_chunk()
    sub(/^\/\* --- /, "")
    sub(/ -+ \*\/$/, "")
    begin_page($0)
    next
}
in_comment || /^\/\*/ {
    if (!in_comment) end_of_chunk()
    in_comment = !/\*\//
    sub(/^ ?\/?\*+\/?/, "")
    sub(/ *\*\/$/, "")
    sub(/^ /, "")
    sub(/ +$/, "")
    if (/^=+$/) {
        begin_page(title())
    } else {
        told[++lines] = $0
    }
    next
}
/^$/ { end_of_chunk(); next }
{ declared[++declarations] = $0 }

END {
    end_of_chunk()
    for (p = 1; p <= pages; ++p) write_page(order[p])
}

# The comment so far, which an underline has made the title of the header.
function title(   text, k) {
    for (k = 1; k <= lines; ++k) text = text (k > 1 ? " " : "") told[k]
    lines = 0
    return text
}

# "Query: the earliest contact" begins, or continues, the page imp_query.
function begin_page(headline,   colon, word) {
    colon = index(headline, ":")
    word = tolower(colon ? substr(headline, 1, colon - 1) : headline)
    sub(/^the /, "", word)
    sub(/[^a-z0-9_].*/, "", word)
    page = word ~ /^lib/ ? word : "imp_" word
    if (!(page in summary)) {
        order[++pages] = page
        summary[page] = colon ? substr(headline, colon + 2) : headline
        header[page] = include
    } else {
        text_of[page] = text_of[page] ".SS " escape(toupper(substr(headline, colon + 2, 1)) \
            substr(headline, colon + 3)) "\n"
    }
}

# Text for roff: no line of it is a request, and what looks like a quote or a hat stays one.
function escape(text) {
    gsub(/\\/, "\\(rs", text)
    gsub(/\^/, "\\(ha", text)
    gsub(/~/, "\\(ti", text)
    gsub(/`/, "\\(ga", text)
    gsub(/'/, "\\(aq", text)
    if (text ~ /^\./) text = "\\&" text
    return text
}

function escape_code(text) {
    text = escape(text)
    gsub(/-/, "\\-", text)
    return text
}

# The comment of a chunk; lines that are indented by two blanks or more, or underlined, as they stand.
function comment(   k, out, kept) {
    kept = 0
    for (k = 1; k <= lines; ++k) {
        if (told[k] != "" && (told[k] ~ /^  /) != kept) {
            kept = !kept
            out = out (kept ? ".PP\n.nf\n" : ".fi\n.PP\n")
        }
        out = out (told[k] == "" ? (kept ? "\n" : ".PP\n") : escape(told[k]) "\n")
    }
    return out (kept ? ".fi\n" : "")
}

function bold(text) {
    gsub(/[ \t]+/, " ", text)
    return ".B \"" escape_code(quoted(text)) "\"\n"
}

function quoted(text) { gsub(/"/, "\"\"", text); return text }

# A name that a page is found by.
function add_name(name) {
    sub(/^\*+/, "", name)
    if (name == page || (page, name) in has_name) return
    has_name[page, name] = 1
    names[page] = names[page] " " name
}

# A declaration on one line, without its comments.
function declare(text,   name) {
    gsub(/[ \t]+/, " ", text)
    text = trim(text)
    sub(/^IMP_EXPORT /, "", text)
    sub(/^static inline /, "", text)
    if (text ~ /^typedef .*\(\*/) {
        name = substr(text, index(text, "(*") + 2)
        sub(/\).*/, "", name)
        add_name(name)
    } else if (match(text, /[a-z_0-9]+\(/)) {
        add_name(substr(text, RSTART, RLENGTH - 1))
        synopsis[page] = synopsis[page] fold(text)
    } else if (match(text, /[a-z_0-9]+;$/)) {
        add_name(substr(text, RSTART, RLENGTH - 1))
    }
    return bold(text)
}

# A prototype in lines of at most 72 columns.
function fold(text,   out, line, n, k, word) {
    n = split(text, word, " ")
    for (k = 1; k <= n; ++k) {
        if (line != "" && length(line) + 1 + length(word[k]) > 72) {
            out = out ".B \"" escape_code(line) "\"\n"
            line = "       "
        }
        line = line (line == "" ? "" : " ") word[k]
    }
    return out ".B \"" escape_code(line) "\"\n"
}

# Declarations: functions in bold, and members of structs and enums, each with its comment.
function declaration_text(   k, out, line, note, depth, at, stop) {
    for (k = 1; k <= declarations; ++k) {
        line = line " " declared[k]
        if (line ~ /^ #define/) {
            sub(/^ #define /, "", line)
            out = out bold(line)
            line = ""
            continue
        }
        while ((at = index(line, "/*")) > 0 && (stop = index(line, "*/")) > 0) {
            note = note (note == "" ? "" : " ") trim(substr(line, at + 2, stop - at - 2))
            line = substr(line, 1, at - 1) substr(line, stop + 2)
        }
        if (index(line, "/*") > 0) continue
        # Only the last member of an enum ends without a mark.
        if (line !~ /[;,{}] *$/ && !(depth > 0 && declared[k + 1] ~ /^ *}/)) continue
        # Arguments of a function end no declaration.
        if (depth == 0 && line ~ /, *$/ || trim(line) == "") continue
        if (depth == 0 && line ~ /{.*} *;? *[a-z_]*;? *$/) {
            out = out closing(trim(line)) notes(note)
        } else if (line ~ /{ *$/) {
            out = out (depth > 0 ? ".TP\n" : "") bold(trim(line)) notes(note) ".RS 4\n.PD 0\n"
            ++depth
        } else if (line ~ /^ *}/) {
            --depth
            out = out ".RE\n" (depth == 0 ? ".PD\n" : "") (depth == 0 ? closing(trim(line)) : bold(trim(line))) notes(note)
        } else if (depth > 0) {
            out = out ".TP\n" bold(trim(line)) notes(note)
        } else {
            out = out (out == "" ? "" : ".br\n") declare(line) notes(note)
        }
        line = note = ""
    }
    return out
}

function notes(note) {
    gsub(/[ \t]+/, " ", note)
    return note == "" ? "" : escape(note) "\n"
}

function closing(text,   name) {
    name = text
    sub(/^.*} */, "", name)
    sub(/;.*/, "", name)
    if (name != "") add_name(name)
    return bold(text)
}

function trim(text) {
    sub(/^[ \t]+/, "", text)
    sub(/[ \t]+$/, "", text)
    return text
}

function end_of_chunk(   text) {
    if (declarations > 0) {
        text = declaration_text()
        if (lines > 0) text = text ".RS 4\n" comment() ".RE\n"
        text_of[page] = text_of[page] ".PP\n" text
    } else if (lines > 0) {
        text_of[page] = text_of[page] ".PP\n" comment()
    }
    lines = declarations = 0
}

function write_page(name,   file, all, n, k, of) {
    file = to "/" name ".3"
    n = split(names[name], of, " ")
    for (k = 1; k <= n; ++k) all = all ", " of[k]
    printf ".\\\" Written by tools/manual/header_pages.awk from <%s>.\n", header[name] >file
    printf ".TH %s 3 \"\" \"Impinge %s\" \"Impinge Library\"\n", name, version >file
    print ".ad l\n.nh" >file
    printf ".SH NAME\n%s%s \\- %s\n", name, all, escape(summary[name]) >file
    printf ".SH SYNOPSIS\n.nf\n.B #include <%s>\n", header[name] >file
    if (synopsis[name] != "") printf ".PP\n%s", synopsis[name] >file
    print ".fi\n.PP\nCompile and link with the flags that" >file
    print ".B pkg\\-config \\-\\-cflags \\-\\-libs impinge\nprints." >file
    printf ".SH DESCRIPTION\n%s.SH SEE ALSO\n", text_of[name] >file
    for (k = 1; k <= pages; ++k)
        if (order[k] != name) printf ".BR %s (3),\n", order[k] >file
    print ".BR impinge (1),\n.BR impinge\\-scene (5),\n.BR impinge (7),\n.BR impinge\\-plugin (7)" >file
    close(file)
    for (k = 1; k <= n; ++k) {
        file = to "/" of[k] ".3"
        print ".so man3/" name ".3" >file
        close(file)
    }
}
