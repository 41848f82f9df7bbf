#!/bin/sh
# SPDX-License-Identifier: MIT
# Compiles a C file for the chip with the compiler and the flags that follow:
#     tools/compile.sh FILE.c FILE.rel SDCC FLAG...
# Images and boards have most files in common. What the preprocessor makes of a file decides what the compiler
# makes of it. So each such text is compiled once and kept in build/objects, from where the others copy it.
set -eu
source=$1 object=$2
shift 2
[ -d "${object%/*}" ] || mkdir -p "${object%/*}"
"$@" -MMD -E "$source" -o "$object"
{
    echo "${SDCC_VERSION:-}"
    for flag; do
        # Defines and folders of headers have done their work.
        case $flag in -D* | -U* | -I*) ;; *) echo "$flag" ;; esac
    done
    cat tools/no_atomics.sh "$object"
} | sha256sum | {
    read -r key _
    kept=build/objects/$key
    if [ ! -d "$kept" ]; then
        "$@" -c "$source" -o "$object"
        tools/no_atomics.sh "$object"
        new=$(mktemp -d -p build kept.XXXXXX)
        cp "$object" "${object%.rel}.asm" "${object%.rel}.lst" "$new"
        mkdir -p build/objects
        # Another process may have compiled the same meanwhile.
        mv -T "$new" "$kept" 2>/dev/null || rm -r "$new"
    fi
    cp "$kept"/* "${object%/*}"
}
