# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Addresses of what an image keeps to itself, from the listings that its link has left. What is global stands in its map.

# The address of a label, such as 0x00002F; nothing if no listing has it.
address_of() { # LABEL LISTING.rst...
    awk -v label="$1:" '$NF == label || $NF == label ":" { print "0x" $1; exit }' "${@:2}"
}
