#!/bin/bash
# SPDX-License-Identifier: MIT
# Random steps of one image on the chip, beside the same C on the host (steps.h):
#     tests/compiler/run.sh BOARD IMAGE STEPS
set -u
board=$1 image=$2 steps=$3
found=$(timeout 1200 "build/compiler/$board/$image/steps" "build/compiler/$board/$image/steps.ihx" "$steps" 2>&1)
status=$?
if [ $status -eq 0 ] && [[ $found == "$steps steps, "*": no difference" ]]; then
    echo "$found"
    echo "$0:$LINENO:${image}_on_${board}_does_as_on_the_host:PASS"
    exit 0
fi
echo "$found"
echo "$0:$LINENO:${image}_on_${board}_does_as_on_the_host:FAIL: exit status $status: $(head -n 1 <<<"$found")"
exit 1
