#!/bin/bash
# SPDX-License-Identifier: MIT
# Calls fistab, bound and drive with odd command lines for SECONDS and looks at what they leave:
#     tests/fuzz/command_lines.sh SECONDS [SEED]
# Options come in any order, an output may be the input, a link, a full disk or a folder, and some calls are
# stopped by a signal. Whatever the line: the exit status is 0, 1 or 2 (or the signal's), the input keeps
# its bytes, a link stays a link, and no other file is left. Prints the seed, and the line that broke a rule.
set -u
cd "$(dirname "$0")/../.." || exit 2
seconds=${1:-60}
RANDOM=$((${2:-$$} % 32768))
echo "command_lines.sh: seed ${2:-$$}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$PWD
cp tables/brake.fis "$work/in.fis"
cp tests/loop/standing_car_3mps.scn "$work/in.scn"
cp build/canary.ihx "$work/in.ihx"
sums=$(cd "$work" && sha256sum in.*)

# Not by $(pick ...): a subshell has chances of its own, which no seed repeats.
pick() { # WORD...: one of them, into the variable `picked`
    shift $((RANDOM % $#))
    picked=$1
}

# Sets words to a command line of chance, a word an element.
make_line() {
    local n output csv
    pick out.h in.fis ./in.fis link.fis "$work/in.fis" hard.fis dangling /dev/full /dev/stdout /dev/null folder nosuch/out.h '' -
    output=$picked
    pick out.csv out.h in.fis link.fis /dev/full "$output"
    csv=$picked
    pick fistab fistab fistab bound drive
    words=("$picked")
    case ${words[0]} in
    fistab) pick table table table plot convert check eval nosuch ;;
    drive) pick run list keys nosuch ;;
    esac
    [ "${words[0]}" = bound ] || words+=("$picked")
    [ $((RANDOM % 4)) -ne 0 ] || words+=(-o "$output")
    for ((n = RANDOM % 6; n >= 0; n--)); do
        case ${words[0]} in
        fistab) pick in.fis in.fis link.fis hard.fis "-o${output:-out.h}" "--output=$output" "--csv=$csv" --grid=3x3 --grid=0x3 --grid=99999999999x1 \
            --nodes --levels=7 --levels=0 --repair=-1,+2 --repair=3:x --encoding=packed --target=c --target=x --samples=5 --exact \
            --monotone=-1,+2 --monotone=9 --coverage --rules 3 10 -1 nan --help --version '' -- folder in.scn "$output" ;;
        bound) pick in.ihx in.ihx in.fis --cycles=main --round=main --loop=main:3 --loop=x --iram=128 --iram=0 nosuch folder '' --help ;;
        drive) pick --hex=in.ihx --hex=in.fis --board=stc89c516rd --board=x --scenario=in.scn --scenario=in.ihx "--csv=$output" "--json=$output" "--vcd=$output" \
            "--uart=$csv" "--coverage=$csv" --engine=fast --engine=x --set=ego.speed_mps=3 --set=x folder '' --help ;;
        esac
        words+=("$picked")
    done
}

broken() { # WHAT
    echo "command_lines.sh: $1: $(printf '%q ' "${words[@]}")"
    exit 1
}

count=0
end=$((SECONDS + seconds))
while [ $SECONDS -lt $end ]; do
    (cd "$work" && rm -rf out.* link.fis dangling folder hard.fis && ln -s in.fis link.fis && ln -s out.there dangling && mkdir folder && ln in.fis hard.fis)
    make_line
    case $((RANDOM % 8)) in
    0)
        pick TERM INT HUP
        limit=(timeout -s "$picked" "0.0$((RANDOM % 9 + 1))")
        ;;
    *) limit=(timeout 20) ;;
    esac
    (cd "$work" && exec "${limit[@]}" "$root/build/${words[0]}" "${words[@]:1}" >stdout 2>stderr <<<"3 10")
    status=$?
    case $status in
    0 | 1 | 2 | 129 | 130 | 143) ;;
    124) [ "${limit[1]}" = -s ] || broken "it took more than 20 s" ;;
    *) broken "exit status $status" ;;
    esac
    [ "$(cd "$work" && sha256sum in.*)" = "$sums" ] || broken "the input is changed"
    if ! [ -L "$work/link.fis" ] || ! [ -L "$work/dangling" ] || ! [ -d "$work/folder" ]; then
        broken "a link or a folder is gone"
    fi
    [ -z "$(ls -A "$work/folder")" ] || broken "a file in the folder"
    # shellcheck disable=SC2010  # the names are those made here
    left=$(ls -A "$work" | grep -vxE 'in\.(fis|scn|ihx)|out\.(h|csv|there)|link\.fis|hard\.fis|dangling|folder|stdout|stderr')
    [ -z "$left" ] || broken "it leaves '$left'"
    if [ "${words[0]}" = fistab ] && [ $status -ne 0 ]; then
        [ -z "$(ls "$work"/out.* 2>/dev/null)" ] || broken "status $status, and a file is left"
    fi
    if [ $status -eq 1 ] || [ $status -eq 2 ]; then
        [ -s "$work/stderr" ] || [ -s "$work/stdout" ] || broken "status $status without a message"
    fi
    count=$((count + 1))
done
echo "command_lines.sh: $count command lines, none broke a rule"
