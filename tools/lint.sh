#!/bin/bash
# SPDX-License-Identifier: MIT
# Looks for mistakes in all shell scripts (shellcheck) and in all C (cppcheck); `make lint` calls it.
# Prints what they find, and exits with 1 if they find something. What a tool is wrong about is
# suppressed here or at its place, with the reason.
set -u
cd "$(dirname "$0")/.." || exit 2
failed=0

# A script is a file that ends in .sh or starts with a line that names a shell.
mapfile -t scripts < <({ git ls-files '*.sh'; git grep -lIE '^#!/bin/(ba)?sh'; } | sort -u)
shellcheck "${scripts[@]}" || failed=1

# variableScope: house style declares variables at the start of a function.
# knownConditionTrueFalse: cppcheck does not know that values wrap around at 8 or 16 bits, as in
# `while (++byte != 0)`, and takes such a condition for a constant.
# nullPointerRedundantCheck: cppcheck does not know that a failed assertion of Unity ends the test.
# unsignedLessThanZero: the image `none` stops at a distance of 0, so `dist_mm <= BRAKE_STOP_MM` is meant.
# redundantAssignment: a watchdog's register takes two values in a row.
# syntaxError: cppcheck cannot read all of SDCC's __asm, so it does not check start.c, code.c, ram.c and round.c.
check_c() { # OPTION|FILE...
    cppcheck --quiet --error-exitcode=1 --std=c11 --enable=warning,style,performance,portability --inline-suppr --max-configs=1 \
        --suppress=missingIncludeSystem --suppress=unmatchedSuppression --suppress="*:build/*" \
        --suppress=variableScope --suppress=knownConditionTrueFalse --suppress="nullPointerRedundantCheck:tests/*" \
        --suppress=unsignedLessThanZero --suppress="redundantAssignment:tests/tools/images/*" --suppress=toomanyconfigs \
        --suppress="syntaxError:firmware/mcu/start.c" --suppress="syntaxError:firmware/mcu/code.c" \
        --suppress="syntaxError:firmware/mcu/ram.c" --suppress="syntaxError:firmware/mcu/round.c" "$@" || failed=1
}

# Each C file is checked with the options that make compiles it with, the firmware for one board.
board=stc89c516rd
mkdir -p build
make -nB BOARD=$board V=1 test-build >build/lint.make || exit 2
grep -oE 'build/[^ ]*lut_table\.h' build/lint.make | sort -u | xargs make -s BOARD=$board >/dev/null || exit 2
awk '
    / -c |tools\/compile.sh / {
        of_chip = /(^| )sdcc /
        if (of_chip && /-DUNITY/) next # a unit test, which the host compiles, too
        options = of_chip ? "chip" : "host"
        for (i = 1; i <= NF; i++) if ($i ~ /^-[DI]/ && $i !~ /^-DIDENTITY=/) options = options " " $i
        for (i = 1; i < NF; i++) if ($i == "-c" || $i == "tools/compile.sh") if (!seen[options, $(i + 1)]++) files[options] = files[options] " " $(i + 1)
    }
    END { for (options in files) print options files[options] }' build/lint.make | tr -d "'" >build/lint.txt

# The others: images that the tests themselves build, and programs that are linked in one step. The proof
# units are left out, because they only include the firmware's own files.
mapfile -t folders < <(git ls-files 'firmware/*.h' 'tools/*.h' | xargs -n 1 dirname | sort -u)
mapfile -t others < <(git ls-files '*.c' ':!tests/bad' ':!tests/prove' | grep -vxFf <(tr ' ' '\n' <build/lint.txt))
echo "chip -DCLK_HZ=12000000UL -Ibuild -Ibuild/$board/brake ${folders[*]/#/-I} ${others[*]}" >>build/lint.txt

while read -ra words; do
    for_chip=()
    # avr8 stands for the 8051: int has 16 bits.
    [ "${words[0]}" = host ] || for_chip=(--platform=avr8 '-D__sbit=volatile _Bool' '-D__at(address)=')
    check_c "${for_chip[@]}" "${words[@]:1}"
done <build/lint.txt
exit $failed
