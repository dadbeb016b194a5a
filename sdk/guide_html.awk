# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

# The guide as a page for browsers, from its plain text: headings are underlined by = or -, code and
# tables are indented by four blanks, items of lists begin with "  - ".

function escaped(text) {
    gsub(/&/, "\\&amp;", text)
    gsub(/</, "\\&lt;", text)
    gsub(/>/, "\\&gt;", text)
    return text
}

# Closes what is open, unless it is `wanted`, and opens that: "p", "pre", "ul" or "".
function change(wanted) {
    if (open == wanted) return
    if (open == "ul") printf "</li>"
    if (open != "") print "</" open ">"
    if (wanted != "") printf "<%s>", wanted
    open = wanted
    blank = 0
}

function anchor(text) {
    text = tolower(text)
    gsub(/[^a-z0-9]+/, "-", text)
    gsub(/^-|-$/, "", text)
    return text
}

function write_line(line) {
    if (line ~ /^    /) {
        change("pre")
        for (; blank > 0; blank--) print ""
        print escaped(substr(line, 5))
    } else if (line ~ /^  - /) {
        printf "%s", open == "ul" ? "</li>\n" : ""
        change("ul")
        print "<li>" escaped(substr(line, 5))
        blank = 0
    } else if (line == "") {
        blank++
        if (open == "p") change("")
    } else if (open == "ul" && line ~ /^  / && blank == 0) {
        print escaped(line)
    } else {
        if (open != "p") change("p")
        print escaped(line)
        blank = 0
    }
}

function heading(line, level) {
    change("")
    printf "<h%d id=\"%s\">%s</h%d>\n", level, anchor(line), escaped(line), level
    blank = 0
}

BEGIN {
    print "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
    print "<title>How to write a plugin for Impinge</title>"
    print "<style>body{max-width:52em;margin:2em auto;padding:0 1em;font:16px/1.5 sans-serif}"
    print "pre{background:#f4f4f4;padding:.8em;overflow-x:auto;font-size:14px;line-height:1.35}"
    print "</style></head><body>"
}

# A line is written when the next one tells that it is no heading.
{
    if (held && $0 ~ /^=+$/ && length($0) == length(last)) { heading(last, 1); held = 0; next }
    if (held && $0 ~ /^-+$/ && length($0) == length(last)) { heading(last, 2); held = 0; next }
    if (held) write_line(last)
    last = $0
    held = 1
}

END {
    if (held) write_line(last)
    change("")
    print "</body></html>"
}
