#!/bin/sh
# SPDX-FileCopyrightText: @author@
# SPDX-License-Identifier: MIT

# Run by `make check`: the plugin just built is loaded, asked, and meets a sphere.

set -e
impinge() { "${IMPINGE-impinge}" "$@" --plugin-path .libs; }
fail() { echo "check.sh: $*" >&2; exit 1; }

built=`pwd -P`/.libs/@name@.so
impinge list --refused
told=`impinge info @name@`
echo "$told"
case $told in
*"$built"*) ;;
*) fail "impinge does not load $built" ;;
esac

impinge pair '@a@' '@b@' --exit-code && status=$? || status=$?
test $status -eq 1 || fail "no contact, where there should be one"

if "${IMPINGE-impinge}" help check >/dev/null 2>&1; then
    impinge check @name@
fi
