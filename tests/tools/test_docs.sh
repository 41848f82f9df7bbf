#!/bin/bash
# SPDX-License-Identifier: MIT
# What README.md and docs/*.md say is so: links and paths exist, options and knobs are known, commands
# print what the pages show, figures are those of the sources. tests/tools/pages.awk explains the parts.
. tests/lib.sh
# Without an option drive takes s51, which the demo runs here too, for its gap to the last digit. What the pages show
# else is the same in the fast engine; in s51, which is slow, `make test-long` looks.
export ENGINE=${ENGINE:-s51}
board=stc89c516rd
pages=(README.md docs/*.md)
awk -f tests/tools/pages.awk "${pages[@]}" >"$out/items"

items() { # KIND [PAGE]: lines of PLACE <tab> TEXT
    awk -F '\t' -v OFS='\t' -v kind="$1" -v page="${2:-}" \
        '$2 == kind && (page == "" || index($1, page ":") == 1) { print $1, $3 }' "$out/items"
}

# --- links, paths, sizes -------------------------------------------------------------------------------
# A heading's anchor, as the usual viewers make it.
anchors() {
    sed -n 's/^##* //p' "$1" | tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}
wrong_links() {
    local place target file anchor
    while IFS=$'\t' read -r place target; do
        case $target in http*://* | mailto:*) continue ;; esac
        file=${target%%#*}
        anchor=${target#"$file"}
        file=${file:+$(dirname "${place%:*}")/$file}
        file=${file:-${place%:*}}
        [ -e "$file" ] || echo "$place: no file '$target'"
        [ -z "$anchor" ] || anchors "$file" | grep -qx -- "${anchor#\#}" || echo "$place: no heading '$target'"
    done < <(items link)
}
faultless "links lead somewhere" "$(wrong_links)"
faultless "README.md links to each page" "$(for page in docs/*.md; do grep -qF "($page)" README.md || echo "$page"; done)"
faultless "each picture is shown" "$(for file in docs/pictures/*.svg docs/pictures/*.png; do grep -qF "${file#docs/}" "${pages[@]}" || echo "$file"; done)"
build/fistab table tables/brake.fis --csv="$out/surface.csv" -o "$out/surface.h"
cmp -s docs/pictures/surface.sums <(for file in "$out/surface.csv" docs/pictures/surface.png; do cksum <"$file"; done)
say "surface.png shows the table" $? "it shows another one, or was not made by make pictures; run that"
[ "$(cat docs/pictures/*.svg docs/pictures/*.png | wc -c)" -le $((300 * 1024)) ]
say "the pictures take 300 KB at most" $? "$(du -bc docs/pictures/* | tail -n 1)"
[ "$(wc -l <README.md)" -le 120 ]
say "README.md has 120 lines at most" $? "$(wc -l <README.md)"

# NAME, APP, BOARD, DIR and X stand for any name. What make leaves in build is not looked for, but for the
# tools.
wrong_paths() {
    local place text word
    while IFS=$'\t' read -r place text; do
        for word in $text; do
            word=${word%[,.;:]}
            case $word in
            build/fistab | build/drive | build/bound | build/flip | build/lab) [ -x "$word" ] || echo "$place: no tool '$word'" ;;
            firmware/* | tools/* | tests/* | tables/* | docs/* | .ci/*)
                compgen -G "$(sed -E 's/(NAME|APP|BOARD|FILE|DIR)/*/g' <<<"$word")" >/dev/null || echo "$place: no '$word'"
                ;;
            esac
        done
    done < <(items code; items command)
}
set -f
faultless "paths exist" "$(wrong_paths)"
set +f

# --- options and knobs ---------------------------------------------------------------------------------
mapfile -t fistab_commands < <(build/fistab --help | sed -nE 's/^  ([a-z]+)  +.*/fistab \1/p')
for tool in "${fistab_commands[@]}" drive bound lab flip; do
    # shellcheck disable=SC2086  # a tool and its command
    build/$tool --help >"$out/help_${tool/ /_}"
done
helps=("$out"/help_*)
make help >"$out/make_help"
options_of() { # HELP...
    cat "$@" | grep -oE -- '--[a-z][a-z-]*' | sort -u
}
wrong_options() {
    local place text word help
    while IFS=$'\t' read -r place text; do
        [[ $text == sdcc\ * ]] && continue # the compiler's own
        help=("${helps[@]}")
        [[ $text =~ ^(build/)?(fistab|drive|bound|flip|lab)\ ([a-z]+) ]] && {
            help=("$out/help_${BASH_REMATCH[2]}")
            [ -e "${help[0]}" ] || help=("${help[0]}_${BASH_REMATCH[3]}")
            [ -e "${help[0]}" ] || { echo "$place: no command '${BASH_REMATCH[0]}'"; continue; }
        }
        for word in $text; do
            [[ $word == --[a-z]* ]] || continue
            options_of "${help[@]}" | grep -qx -- "${word%%=*}" || echo "$place: no option '$word'"
        done
    done < <(items code; items command)
}
set -f
faultless "options exist" "$(wrong_options)"

wrong_make() {
    local place text words word
    while IFS=$'\t' read -r place text; do
        [ "${text%% *}" = make ] || continue
        eval "words=($text)" # as a shell takes it apart, with quotes
        for word in "${words[@]:1}"; do
            case $word in
            -*) ;;
            *=*) grep -qE "^  ${word%%=*}=" "$out/make_help" || echo "$place: no knob '$word'" ;;
            */*) [ -e "$word" ] || echo "$place: no '$word'" ;;
            *) grep -qE "^  $word " "$out/make_help" || echo "$place: no target '$word'" ;;
            esac
        done
    done < <(items code; items command)
}
faultless "targets and knobs of make exist" "$(wrong_make)"
set +f

# of_image NAME STATUS [WHY]: as say, for a figure of an image. The pages state those of SDCC 4.2.0.
of_image() {
    if sdcc --version | grep -qF 'mcs51' && ! sdcc --version | grep -qF ' 4.2.0 '; then
        echo "$0:$LINENO:$1:IGNORE: the pages state what the images of SDCC 4.2.0 do"
    else
        say "$@"
    fi
}

# --- output --------------------------------------------------------------------------------------------
# What a console block shows below a command is what that prints; a line "..." stands for any lines. What
# the long ones print is taken from what they call.
output_of() { # COMMAND
    case $1 in
    "make demo") ENGINE=s51 tools/demo.sh $board ;;
    "make test") tests/run.sh "echo a:1:b:PASS" | sed 's/^[0-9]* passed/N passed/' ;;
    build/drive\ *standing_car_3mps*) ENGINE=s51 bash -c "$1" ;;
    build/fistab\ * | build/drive\ * | build/bound\ *) bash -c "$1" ;;
    *) echo "no way to check this command" ;;
    esac 2>&1 </dev/null
}
# What the commands of docs/bound.md read.
while IFS= read -r command; do
    bash -c "$command" 2>/dev/null
done < <(items command | cut -f2 | grep '^sdcc ')
awk -F '\t' -v out="$out/shown" '
    $2 == "command" { command = $3; place = $1; next }
    $2 == "output" && command != "" { n++; print command >(out n ".command"); print place >(out n ".place"); command = "" }
    $2 == "output" { print $3 >(out n ".lines") }
    $2 == "end" { command = "" }' "$out/items"
for file in "$out"/shown*.command; do
    output_of "$(cat "$file")" >"${file%.command}.output"
    fault=$(awk '
        FNR == NR { wanted[++count] = $0; next }
        { got[++lines] = $0 }
        END {
            at = 1
            for (i = 1; i <= count; i++) {
                if (wanted[i] == "...") { any = 1; continue }
                while (any && at <= lines && got[at] != wanted[i]) at++
                if (got[at] != wanted[i]) { print "does not print: " wanted[i]; exit }
                at++; any = 0
            }
            if (!any && at <= lines) print "also prints: " got[at]
        }' "${file%.command}.lines" "${file%.command}.output")
    [ -z "$fault" ]
    status=$?
    case $(cat "$file") in
    "make demo" | build/drive\ run* | build/bound\ *) judge=of_image ;;
    *) judge=say ;;
    esac
    $judge "$(cat "${file%.command}.place") $(cat "$file")" $status "$fault"
done

sentence=$(grep -m 1 '^Standing car ahead' "$out"/shown*.output | sed 's/^[^:]*://')
grep -qF ">$sentence<" docs/pictures/live.svg && [ -n "$sentence" ]
of_image "the picture of the loop shows the demo" $? "it lacks '$sentence'; run make pictures"

shows() { # NAME PATTERN FILE PAGE: the blocks of PAGE have lines of that form, and each is a line of FILE
    items block "$4" | cut -f2 | grep -E -- "$2" >"$out/seen"
    [ -s "$out/seen" ] && ! grep -vxF -f "$3" "$out/seen" >"$out/untrue"
    of_image "$1" $? "$4 shows '$(head -n 1 "$out/untrue")'; it is '$(grep -m 1 -F -- "$(head -n 1 "$out/untrue" | cut -c1-8)" "$3")'"
}
drive=(build/drive run --board "$board" --scenario)
# Of the telemetry the two engines differ in a millimetre here and there, and in a byte of unused stack.
"${drive[@]}" tests/loop/standing_car_3mps.scn --engine=s51 --uart "$out/log" >/dev/null
for character in '?' s; do
    "${drive[@]}" tests/loop/standing_car_3mps.scn --engine=fast --set uart.at_s=0.5 --set "uart.send=$character" --uart "$out/answer" >/dev/null
    cat "$out/answer" >>"$out/log"
done
tr -d '\r' <"$out/log" >"$out/uart"
shows "what the serial line says" '^(# (\?|state|fuzzy51 [0-9])|seq,|[0-9]+,)' "$out/uart" docs/brake.md
cat firmware/*/main.c | grep -oE '"seq,[a-z0-9_,]*' | tr -d '"' >"$out/headers"
shows "the telemetry of the frame-fed controllers" '^seq,' "$out/headers" docs/controllers.md
sed 's/; deepest.*//' "build/$board/brake.bound" >"$out/bound"
sed -n 's/; deepest measure.*//p' docs/bound.md >>"$out/bound.shown"
shows "the bounds" '^(pwm_interrupt|control_step): ' "$out/bound" docs/bound.md
[ -s "$out/bound.shown" ] && grep -qxF -f "$out/bound.shown" "$out/bound"
of_image "the stack's bound" $? "docs/bound.md shows '$(cat "$out/bound.shown")'; it is '$(grep '^stack: ' "$out/bound")'"
items block docs/drive.md | cut -f2 | sed -n '/^\[scenario\]$/,$p' >"$out/shown.scn"
"${drive[@]}" "$out/shown.scn" >"$out/said" 2>&1
say "the scenario shown" $? "$(head -n 1 "$out/said")"

# --- figures -------------------------------------------------------------------------------------------
# is_worth NAME VALUE: a constant that others make, of the firmware with the HC-SR04
is_worth() {
    local header
    header=$(grep -lE "^#define +$1 " -r firmware --include='*.h' | head -n 1)
    [ -n "$header" ] && printf '#include "%s"\n#if (%s) != (%s)\n#error\n#endif\n' "$header" "$1" "$2" |
        gcc -fsyntax-only -I. -Ifirmware/lib -Ifirmware/mcu -Ifirmware/brake -x c - 2>/dev/null
}
wrong_figures() {
    local place name value
    while IFS=$'\t' read -r place text; do
        name=${text%% = *}
        value=${text##* = }
        grep -qE "^#define +$name +$value(U|UL|L)?( |\$)" -r firmware build/*/brake/lut_table.h --include='*.h' ||
            is_worth "$name" "$value" || echo "$place: not '$text'"
    done < <(items holds | grep -v "SPDX-License-Identifier: ")
}
faultless "the constants" "$(wrong_figures)"

has_row() { # PAGE START: PAGE has a table row that begins so
    items row "$1" | cut -f2 | grep -qF -- "$2" || echo "$1: no row '$2'"
}
knob_of() { # FILE KNOB
    sed -nE "s/^$2 *:= *//p" "$1"
}
# What tools/memory.sh says of an image on a board, rounded up, as a row of docs/boards.md.
size_row() { # APP BOARD
    tools/memory.sh "$2" "build/$2" "$1" | awk -v app="$1" -v board="$2" '
        { sub(/.* code +/, ""); code = $1; sub(/.* RAM +/, ""); printf "| `%s` | `%s` | %d KB | %d bytes |\n", app, board, (code + 1023) / 1024, int(($1 + 9) / 10) * 10 }'
}
rows_of_boards() {
    local file
    for file in firmware/boards/*.mk; do
        has_row docs/boards.md "| \`$(basename "$file" .mk)\` |"
        has_row docs/boards.md "| $(awk -v hz="$(knob_of "$file" CLK_HZ)" 'BEGIN { print hz / 1e6 }') MHz | $(($(knob_of "$file" CODE_BYTES) / 1024)) KB | $(knob_of "$file" ENCODING) |"
    done
}
faultless "the boards" "$(rows_of_boards)"
sizes=$(for file in build/*/brake_far.mem; do
    board_far=$(basename "$(dirname "$file")")
    has_row docs/boards.md "$(size_row brake_far "$board_far")"
done)
[ -z "$sizes" ]
of_image "the sizes of brake_far" $? "$sizes"
# 0x90 is P1.0, 0xB2 is P3.2.
rows_of_pins() {
    sed -nE 's/^PIN_([A-Z]+) *:= *(0x[0-9A-F]+).*/\1 \2/p' firmware/pins.mk | while read -r name address; do
        has_row docs/wiring.md "| P$(((address - 0x80) >> 4)).$((address & 7)) | $name |"
    done
}
faultless "the pins" "$(rows_of_pins)"
# Faults are numbered from 1 in the order of the enum.
faults_in() { # HEADER ENUM
    sed -n "/^enum $2 {/,/^}/p" "$1" | grep -cE '^ *[A-Z_]+FAULT_[A-Z_]+,'
}
fault_rows() { # PAGE: the numbers in the table below "| fault |"
    items row "$1" | cut -f2 | awk -F ' *[|] *' '$2 == "fault" { is_on = 1; next } is_on && $2 ~ /^[0-9]+$/ { print $2; next } $2 !~ /^-/ { is_on = 0 }'
}
for pair in "docs/brake.md firmware/brake/fault.h brake_fault" "docs/controllers.md firmware/frames/frames.h frames_fault"; do
    read -r page header enum <<<"$pair"
    [ "$(fault_rows "$page" | xargs)" = "$(seq "$(($(faults_in "$header" "$enum") - 1))" | xargs)" ]
    say "the faults in $page" $? "listed: $(fault_rows "$page" | xargs); in $header: $(faults_in "$header" "$enum") with none"
done

# --- names ---------------------------------------------------------------------------------------------
unnamed() { # PAGES NAME...: the names that no page has between backticks
    local places=$1 page name
    shift
    for page in $places; do items code "$page"; done | cut -f2 | tr -s ' ' '\n' >"$out/words"
    for name; do grep -qxF -- "$name" "$out/words" || echo "$places: no '$name'"; done
}
read -ra images < <(sed -n 's/^IMAGES_OF_[a-z]* *:= *//p' firmware/*/*.mk | xargs)
read -ra kinds < <(grep -oE '\{"[a-z0-9]+"' tools/fistab/mf.c | tr -d '{"' | xargs)
read -ra faults < <(grep -rohE 'choices = "[a-z ]*(garbage|corrupt)[a-z ]*"' tools/drive --include='*.c' | sed 's/.*= //' | tr -d '"' | xargs)
[ ${#images[@]} -ge 5 ] && [ ${#kinds[@]} -ge 15 ] && [ ${#faults[@]} -ge 17 ]
say "the names to look for" $? "${images[*]}, ${kinds[*]}, ${faults[*]}"
faultless "every image is described" "$(unnamed "docs/brake.md docs/controllers.md docs/wiring.md" "${images[@]}")"
faultless "every membership function is named" "$(unnamed docs/fistab.md "${kinds[@]}")"
faultless "every fault of a scenario is named" "$(unnamed docs/drive.md "${faults[@]}")"

# Of each frame-fed controller: the rows of its payload follow each other and fill it, as do those of each of
# its targets or other items; its period.
wrong_payloads() {
    local name
    for name in $(sed -n 's/^FRAME_\([A-Z]*\) = .*/\1/p; s/^ *FRAME_\([A-Z]*\) = .*/\1/p' firmware/frames/frame.h | tr '[:upper:]' '[:lower:]' | sort -u); do
        awk -v name="$name" -v wanted="$(sed -nE 's/^#define [A-Z]+_(PAYLOAD|TARGET)_BYTES +([0-9]+).*/\2/p' "firmware/$name/$name.h" | xargs)" '
            function end_table() { if (bytes) sizes = sizes (sizes ? " " : "") bytes; bytes = 0 }
            /^## / { is_on = $2 == name }
            !/^\|/ { end_table() }
            is_on && /^\| [0-9]+ \| [iu][0-9]+ / { if ($2 != bytes + 0) print name ": byte " $2 " follows " bytes; bytes += substr($4, 2) / 8 }
            END { end_table(); if (sizes != wanted) print name ": " sizes " bytes, not " wanted }' docs/controllers.md
        ticks=$(tr '\n' ' ' <"firmware/$name/main.c" | sed -nE 's/.*_PAYLOAD_BYTES, *[A-Z0-9_]+, *([0-9]+), .*/\1/p')
        items row docs/controllers.md | cut -f2 | grep -q "^| \`$name\` |.*| $((ticks * 10)) ms |" || echo "$name: asks every $((ticks * 10)) ms"
    done
}
faultless "payloads and periods" "$(wrong_payloads)"
finish
