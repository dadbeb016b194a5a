# shellcheck shell=bash
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Completion of impinge in bash: `impinge complete` knows the words, this hands them on.

_impinge()
{
    local line=${COMP_LINE:0:COMP_POINT} current=${COMP_WORDS[COMP_CWORD]} files='' word typed
    COMPREPLY=()
    while IFS=$'\t' read -r word _; do
        if [[ $word == :files ]]; then files=1; else COMPREPLY+=("$word"); fi
    done < <("${1/#\~/$HOME}" complete "$line" 2>/dev/null)

    if [[ $current == [\'\"]* ]]; then
        # A pipeline goes on in its quotes, which bash would close behind a single answer.
        compopt -o nospace 2>/dev/null
        [[ ${#COMPREPLY[@]} -ne 1 ]] || COMPREPLY+=("${COMPREPLY[0]} ")
        return 0
    fi
    # Without quotes bash replaces only what stands behind '='.
    typed=${line##*[[:space:]]}
    [[ $typed != *=* || $COMP_WORDBREAKS != *=* ]] || COMPREPLY=("${COMPREPLY[@]#"${typed%=*}="}")
    [[ ${COMPREPLY[*]} != *= ]] || compopt -o nospace 2>/dev/null
    if [[ -n $files ]]; then
        compopt -o filenames 2>/dev/null
        while IFS= read -r word; do COMPREPLY+=("$word"); done < <(compgen -f -- "$current")
    fi
}
complete -F _impinge impinge
