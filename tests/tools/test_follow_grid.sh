#!/bin/bash
# SPDX-License-Identifier: MIT
# The follower's 1,080 starts, with the firmware's decision on the host. It counts the starts that end in
# contact: with the published rules, with the safe rules, and with the safe rules that also brake when a
# lane change is refused. The contacts of the last case cannot be avoided by any control.
. tests/lib.sh

count() { # GRID CONDITION
    awk -F, "NR > 1 && ($2) { count++ } END { print count + 0 }" "build/grid/$1.csv"
}

check "make grid" make grid
for grid in follow_paper follow_unyielding follow; do
    check "$grid has 1080 starts" [ "$(count $grid 1)" -eq 1080 ]
    check "$grid: 8 starts collide under full braking, too" [ "$(count $grid '$8')" -eq 8 ]
done
check "published rules: 824 collisions" [ "$(count follow_paper '$4')" -eq 824 ]
check "safe rules: 133 collisions" [ "$(count follow_unyielding '$4')" -eq 133 ]
check "safe rules that brake when refused: 8 collisions" [ "$(count follow '$4')" -eq 8 ]
check "and none of the 8 could be avoided" [ "$(count follow '$4 && !$8')" -eq 0 ]
check "a start at the same speed collides with no safe rule" [ "$(count follow '$4 && $2 == $3')" -eq 0 ]
finish
