#!/bin/bash
# SPDX-License-Identifier: MIT
# Random command lines of fistab: options in any order, good and bad values, outputs on the input, on links, on a full
# disk. Whatever the line: exit status 0, 1 or 2, the input and the links are as before, no other file is left, and
# an error says something. SEED=N repeats a run.
. tests/lib.sh
seed=${SEED:-51}
RANDOM=$seed
room=$out/room
mkdir -p "$room"
lines=120

# Not by $(pick ...): a subshell has chances of its own, which no seed repeats.
pick() { # WORD...: one of them, into the variable `picked`
    shift $((RANDOM % $#))
    picked=$1
}

random_line() { # into the array `line`
    local count=$((RANDOM % 5)) i
    pick eval check table table table convert plot none
    line=("$picked")
    pick my.fis my.fis my.fis my.fll link.fis no.fis
    line+=("$picked")
    for ((i = 0; i < count; i++)); do
        pick --exact --samples=11 --samples=0 --nodes --grid=7x5 --grid=300x2 --grid=7 --levels=255 --levels=x \
            --half-down --repair=-1,+2 --repair=2:-1 --monotone=+1 --encoding=packed --target=c --target=x --name=t \
            --csv=my.fis --csv=made.csv --csv=link.csv --csv=/dev/full --changes=made.txt -omade.h -omy.fis -ohard.fis \
            -olink.fis -o/dev/full -omade.svg --output= --rules --coverage --sets -1 -2.5 3 10 --man --version
        line+=("$picked")
    done
}

wrong=
for ((n = 0; n < lines && ${#wrong} == 0; n++)); do
    rm -rf "${room:?}"/*
    cp tests/good/plain.fis "$room/my.fis"
    cp tests/good/plain.fll "$room/my.fll"
    ln "$room/my.fis" "$room/hard.fis"
    ln -s my.fis "$room/link.fis"
    ln -s target.csv "$room/link.csv"
    random_line
    (cd "$room" && timeout 20 "$OLDPWD/build/fistab" "${line[@]}" </dev/null >"$OLDPWD/$out/stdout" 2>"$OLDPWD/$out/stderr")
    status=$?
    [ $status -le 2 ] || wrong="exit status $status"
    [ $status -eq 0 ] || [ -s "$out/stderr" ] || wrong="exit status $status without a word"
    case ${line[1]} in
    my.fll) cmp -s tests/good/plain.fll "$room/my.fll" || wrong="the input has changed" ;;
    *) cmp -s tests/good/plain.fis "$room/my.fis" || [ "${line[1]}" = no.fis ] || wrong="the input has changed" ;;
    esac
    [ -L "$room/link.fis" ] && [ -L "$room/link.csv" ] || wrong="a link is a link no more"
    made=$(find "$room" -name 'made*' -o -name 'target*')
    [ $status -eq 0 ] || [ -z "$made" ] || wrong="left $made"
    left=$(find "$room" -mindepth 1 -printf '%f\n' | grep -vxE 'my\.fis|my\.fll|hard\.fis|link\.fis|link\.csv|target\.csv|made\.(h|csv|txt|svg)')
    [ -z "$left" ] || wrong="left $left"
    [ -z "$wrong" ] || wrong="SEED=$seed, line $n, fistab ${line[*]}: $wrong"
done
faultless random_lines_destroy_nothing "$wrong"
finish
