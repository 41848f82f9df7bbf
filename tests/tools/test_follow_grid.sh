#!/bin/bash
# The follower's 1,080 starts, with the firmware's decision on the host: how many end in contact with
# the rules as published, with the safe ones, and with the safe ones that also brake when a lane change is
# refused; and that the last could not be helped.
cd "$(dirname "$0")/../.." || exit 2
failed=0

check() { # LINE NAME EXPECTED ACTUAL
    if [ "$3" = "$4" ]; then
        echo "$0:$1:$2:PASS"
    else
        echo "$0:$1:$2:FAIL: expected $3, it is $4"
        failed=1
    fi
}

count() { # GRID CONDITION
    awk -F, "NR > 1 && ($2) { count++ } END { print count + 0 }" "build/grid/$1.csv"
}

make grid >/dev/null || {
    echo "$0:$LINENO:make grid:FAIL: it does not build"
    exit 1
}
for grid in follow_paper follow_unyielding follow; do
    check $LINENO "$grid has 1080 starts" 1080 "$(count $grid 1)"
    check $LINENO "$grid: 8 starts collide under full braking, too" 8 "$(count $grid '$8')"
done
check $LINENO "published rules: 824 collisions" 824 "$(count follow_paper '$4')"
check $LINENO "safe rules: 133 collisions" 133 "$(count follow_unyielding '$4')"
check $LINENO "safe rules that brake when refused: 8 collisions" 8 "$(count follow '$4')"
check $LINENO "and none of the 8 could be avoided" 0 "$(count follow '$4 && !$8')"
check $LINENO "a start at the same speed collides with no safe rule" 0 "$(count follow '$4 && $2 == $3')"
exit $failed
