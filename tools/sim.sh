#!/bin/sh
# SPDX-License-Identifier: MIT
# One image in the simulator:
#     tools/sim.sh BOARD APP [SCENARIO]
# With a scenario drive runs it, with the live picture if this is a terminal; without one the simulator's
# own console opens, with the image loaded.
set -eu
board=$1 app=$2 scenario=${3:-}
image=build/$board/$app.ihx
of_board() {
    awk -v knob="$1" '$1 == knob { print $3 }' "firmware/boards/$board.mk"
}

if [ -n "$scenario" ]; then
    live=
    [ ! -t 1 ] || live=--live
    # shellcheck disable=SC2086  # no word if empty
    exec build/drive run --hex "$image" --board "$board" --scenario "$scenario" $live
fi
mkdir -p build/sim
uart=build/sim/uart keys=build/sim/keys
: >"$uart"
[ -p "$keys" ] || mkfifo "$keys"
# Opened for both directions the keys neither block nor end.
exec 3<>"$keys"
echo "$image in uCsim's console: run, stop, step, state, info registers, help; quit ends it."
echo "The UART writes to $uart. In another terminal: tail -f $uart; printf v >$keys sends it a v."
echo "The echo is low, as without a target: set bit pin3.2 1 raises it."
# PCON.4, POF, which power-on sets in a chip and not in s51.
exec tools/s51 -t "$(of_board S51_TYPE)" -X "$(of_board CLK_HZ)" -R 1 -S "uart=0,in=$keys,out=$uart" \
    -e 'set bit pin3.2 0' -e 'set mem sfr 0x87 0x10' "$image"
