# SPDX-License-Identifier: MIT
# The brake's image whose bits are flipped, and where its variables are.
# shellcheck shell=bash

# Links the brake in FOLDER/BOARD: the listings of build/BOARD are those of the last link that took an object,
# which may be another image's.
link_brake() { # FOLDER BOARD
    make -s BOARD="$2" OUT="$1/$2" "$1/$2/brake.ihx"
}

# The hexadecimal address of a variable of that image.
address_of() { # FOLDER BOARD NAME
    awk -v name="_$3:" '$NF == name || $NF == name ":" { print substr($1, 5); exit }' "$1/$2"/brake/*/*.rst
}
