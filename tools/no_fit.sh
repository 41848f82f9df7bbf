#!/bin/sh
# SPDX-License-Identifier: MIT
# Says why a link failed, and what can be done:
#     tools/no_fit.sh IMAGE BOARD CODE_BYTES [ADVICE]        after the failed link of IMAGE.ihx
# IMAGE.log has what the linker said, IMAGE.mem the memory that the program takes. ADVICE is what makes the
# program smaller.
set -eu
[ $# -ge 3 ] || {
    echo "usage: no_fit.sh IMAGE BOARD CODE_BYTES [ADVICE]" >&2
    exit 2
}
log=$1.log mem=$1.mem
end=$(awk '$1 == "ROM/EPROM/FLASH" { print $3 }' "$mem" 2>/dev/null || true)
if [ -n "$end" ] && [ $((end)) -ge "$3" ]; then
    echo "$1.ihx: error: $((end + 1)) bytes of code are too many for board $2, which has $3${4:+; $4}"
elif grep -q 'Insufficient\|in internal RAM' "$log"; then
    echo "$1.ihx: error: the variables leave too little RAM for the stack on board $2; see $mem"
else
    cat "$log"
    echo "$1.ihx: error: the link failed; see above"
fi
