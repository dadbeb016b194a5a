#!/bin/sh
# SPDX-FileCopyrightText: @author@
# SPDX-License-Identifier: MIT

# Run by the tests of the build: loads the plugin just built, checks it, and tests a pair with another surface.

set -e
plugins=${PLUGINS-.libs}
impinge() { "${IMPINGE-impinge}" "$@" --plugin-path "$plugins"; }
fail() { echo "check.sh: $*" >&2; exit 1; }

built=`cd "$plugins" && pwd -P`/@name@.so
impinge list --refused
told=`impinge info @name@`
echo "$told"
case $told in
*"$built"*) ;;
*) fail "impinge does not load $built" ;;
esac

if "${IMPINGE-impinge}" help check >/dev/null 2>&1; then
    impinge check @name@
fi

# A pair with another surface. Set the surface and the verdict required: contact, clear, or any.
meets='@b@'
answer=any

impinge pair '@a@' "$meets" --exit-code && status=$? || status=$?
case $answer,$status in
contact,1 | clear,0 | any,[01]) ;;
*) fail "pair '@a@' '$meets' ends with status $status, where the answer must be: $answer" ;;
esac
