#!/bin/sh
# SPDX-License-Identifier: MIT
# Compiles a C file for the chip with the compiler and the flags that follow:
#     tools/compile.sh FILE.c FILE.rel SDCC FLAG...
# Images and boards have most files in common. What the preprocessor makes of a file decides what the compiler
# makes of it. So each such text is compiled once and kept in build/objects, from where the others copy it.
# A folder of build/objects appears as a whole, with what was compiled in a folder of its own: two makes at
# once, or one that is interrupted, leave nothing wrong there.
# This is done a thousand times in a build, so it starts as few processes as it can.
set -eu
source=$1 object=$2
shift 2
folder=${object%/*} name=${object##*/}
depends=${object%.rel}.d
[ -d "$folder" ] || mkdir -p "$folder"
# With its comments: the listing carries them, and tools/bound reads them there. The environment is the one way to name
# the file with the headers that all versions know. $SDCPP is what the compiler runs for this; without the detour it takes
# a quarter of the time.
new=
trap 'rm -rf "$object" $new' EXIT # no object whose headers are not known
trap 'exit 1' HUP INT TERM
: >"$depends"
export DEPENDENCIES_OUTPUT="$depends $object"
if [ -n "${SDCPP:-}" ]; then
    macros=
    for flag; do
        case $flag in -D* | -U* | -I*) macros="$macros '$flag'" ;; esac
    done
    text=$(eval "exec $SDCPP $macros -C '$source'")
else
    text=$("$@" -Wp,-C -E "$source")
fi
unset DEPENDENCIES_OUTPUT
# An image's table is the only header in a folder of the image's; where that is decides nothing.
case $text in *'/lut_table.h"'*) text=$(printf '%s\n' "$text" | sed 's|"[^"]*/lut_table\.h"|"lut_table.h"|') ;; esac
flags=${SDCC_VERSION:-}
for flag; do
    # Defines and folders of headers have done their work.
    case $flag in -D* | -U* | -I*) ;; *) flags="$flags $flag" ;; esac
done
sums=$(printf '%s\n%s\n' "$flags" "$text" | sha256sum - tools/no_atomics.sh)
# shellcheck disable=SC2086  # two words for each file: its sum and its name
set -- $sums "$@"
kept=build/objects/$1-$3
shift 4
if [ ! -d "$kept" ]; then
    new=$kept.$$
    mkdir -p "$new"
    "$@" -c "$source" -o "$new/$name"
    tools/no_atomics.sh "$new/$name"
    # shellcheck disable=SC2162  # a backslash at a line's end joins the next one
    read _ headers <"$depends"
    # shellcheck disable=SC2086  # one word each
    changed=$(exec find $headers -newer "$depends")
    if [ -n "$changed" ]; then
        echo "$changed: error: changed while $source was compiled; run make again" >&2
        exit 1
    fi
    # Another process may have compiled the same meanwhile.
    mv -T "$new" "$kept" 2>/dev/null || { [ -d "$kept" ] && rm -r "$new"; }
fi
cp "$kept"/* "$folder"
trap - EXIT
