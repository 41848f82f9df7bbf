# SPDX-License-Identifier: MIT
# The brake's image whose bits are flipped, and where its variables are.
# shellcheck shell=bash
. tests/listing.sh

# Links the brake in FOLDER/BOARD: the listings of build/BOARD are those of the last link that took an object,
# which may be another image's.
link_brake() { # FOLDER BOARD
    make -s BOARD="$2" OUT="$1/$2" "$1/$2/brake.ihx"
}

# The hexadecimal address of a variable of that image, without 0x.
variable_at() { # FOLDER BOARD NAME
    printf '%X' "$(address_of "_$3" "$1/$2"/brake/*/*.rst)"
}

# Where the stack of that image begins.
stack_at() { # FOLDER BOARD
    awk '$2 == "__start__stack" { print "0x" substr($1, 7) }' "$1/$2/brake.map"
}
