#!/bin/bash
# SPDX-License-Identifier: MIT
# The closed-loop report: each controller on each scenario, on all cores, as one page.
#     tools/report/report.sh BOARD            writes build/report/index.html
# The name of a result is made of the hashes of drive, image and scenario, and of the engine. So nothing is
# run twice: an interrupted report goes on where it stopped, and a changed image runs anew. Exit status: 0
# fine; 1 a run failed, the engines disagree or a figure's data could not be made, and the page says which;
# 2 nothing could be run.
# Knobs, from the environment:
#     ENGINE=fast|s51          which of drive's engines runs the images
#     SAMPLE=N                 with ENGINE=fast: so many of the drives, drawn at random, run in s51, too
#     MAP=coarse|normal|fine   how fine the avoidance map is
#     ONLY='GLOB...'           only scenarios of these names
#     IMAGES='NAME...'         only these images
#     JOBS=N                   so many runs at a time; empty: one a core
#     SSHLOGIN=A,B,:           machines for GNU parallel; ':' is this one
set -euo pipefail

board=${1:?"which board?"}
: "${MAP:=normal}" "${ONLY:=*}" "${IMAGES:=}" "${JOBS:=}" "${SSHLOGIN:=:}" "${ENGINE:=fast}" "${SAMPLE:=100}"
# Where what make test has measured lies, from the environment, too: COVERAGE
: "${DRIVE:=build/drive}" "${COVERAGE:=build/coverage}" "${REPORT_OUT:=build/report}" "${WASM:=build/wasm/page.wasm}"
export DRIVE
here=tools/report
runs=$REPORT_OUT/runs
work=$REPORT_OUT/parts

fail() {
    echo "report.sh: error: $1" >&2
    exit 2
}

existing() { # FILE...: those that there are, one a line
    local file
    for file; do
        if [ -f "$file" ]; then echo "$file"; fi
    done
}

# --- the tabs' descriptions ---------------------------------------------------------------------------
tabs() {
    ls "$here"/tabs/*.tab
}
tab_id() { # TAB
    basename "$1" .tab | sed 's/^[0-9]*-//'
}
tab_values() { # TAB KEY: one a line
    local line
    while IFS= read -r line; do
        [[ $line =~ ^$2\ *=\ *(.*)$ ]] || continue
        echo "${BASH_REMATCH[1]//build\/report\//$REPORT_OUT/}"
    done <"$1"
}
tab_images() { # TAB
    tab_values "$1" image | sed 's/ *|.*//'
}

# Those that are wanted and that the board holds.
built_images() { # TAB
    local image
    tab_images "$1" | while read -r image; do
        [ -f "build/$board/$image.ihx" ] || continue
        [[ -z $IMAGES || " $IMAGES " == *" $image "* ]] || continue
        echo "$image"
    done
}

# --- what is to be run --------------------------------------------------------------------------------
check_knobs() {
    local images image
    case $MAP in
    coarse | normal | fine) ;;
    *) fail "MAP=$MAP: use coarse, normal or fine" ;;
    esac
    case $ENGINE in
    fast | s51) ;;
    *) fail "ENGINE=$ENGINE: use fast or s51" ;;
    esac
    case $SAMPLE in
    '' | *[!0-9]*) fail "SAMPLE=$SAMPLE: give a whole number" ;;
    esac
    case $JOBS in
    '') ;;
    *[!0-9]* | 0*) fail "JOBS=$JOBS: give a whole number, 1 or more" ;;
    esac
    images=$(tabs | while read -r tab; do tab_images "$tab"; done | xargs)
    for image in $IMAGES; do
        [[ " $images " == *" $image "* ]] || fail "no image '$image'; the images are: $images"
    done
    [ -x "$DRIVE" ] || fail "no $DRIVE; run make"
}

read -ra globs <<<"$ONLY"
is_wanted() { # SCENARIO-NAME
    local glob
    for glob in "${globs[@]}"; do
        # shellcheck disable=SC2053  # a pattern
        [[ $1 == $glob ]] && return 0
    done
    return 1
}

# The scenarios of a tab: lines of file, name, the one image that the file is for, or nothing. A file may
# name its image (app = ...). Those under "own" are for the first image of the tab. The name lacks the
# prefix that marks a variant's files, so that variants share a row.
scenarios_of() { # TAB
    local prefixes first key file name
    prefixes=$(tab_values "$1" variant | paste -sd '|')
    first=$(tab_images "$1" | head -n 1)
    for key in scenarios own; do
        for file in $(tab_values "$1" $key); do
            [ -f "$file" ] || continue
            name=${file##*/}
            name=${name%.scn}
            [[ -z $prefixes || ! $name =~ ^($prefixes)(.*)$ ]] || name=${BASH_REMATCH[2]}
            is_wanted "$name" || continue
            printf '%s\t%s\t%s\n' "$file" "$name" "$(if [ $key = own ]; then echo "$first"; fi)"
        done
    done | awk -F '\t' -v OFS='\t' '
        $3 == "" {
            while ((getline line <$1) > 0)
                if (sub(/^app *= */, "", line)) $3 = line
            close($1)
        }
        { print }'
}

short_hashes() { # FILE...: lines of file, hash
    sha256sum "$@" | awk '{ print $2 "\t" substr($1, 1, 10) }'
}

# Tasks, one a line: tab, image, scenario, key, image's file, scenario's file, seconds of simulated time.
list_tasks() {
    local tab image images drive_hash
    drive_hash=$(short_hashes "$DRIVE" | cut -f2)
    tabs | while read -r tab; do
        mapfile -t images < <(built_images "$tab")
        [ ${#images[@]} -gt 0 ] || continue
        scenarios_of "$tab" >"$work/scenarios"
        for image in "${images[@]}"; do
            echo "$image" >>"$work/built"
            awk -F '\t' -v OFS='\t' -v id="$(tab_id "$tab")" -v image="$image" -v hex="build/$board/$image.ihx" \
                '$3 == "" || $3 == image { print id, image, $2, hex, $1 }' "$work/scenarios"
        done
    done >"$work/pairs"
    [ -s "$work/built" ] || fail "no image of a controller in build/$board; run make BOARD=$board"
    [ -s "$work/pairs" ] || fail "no scenario is called '$ONLY'"
    cut -f4,5 "$work/pairs" | tr '\t' '\n' | sort -u >"$work/files"
    xargs sha256sum <"$work/files" | awk '{ print $2 "\t" substr($1, 1, 10) }' >"$work/hashes"
    grep '[.]scn$' "$work/files" | xargs awk '/^duration_s/ { print FILENAME "\t" $NF }' >"$work/durations"
    awk -F '\t' -v OFS='\t' -v prefix="$board-$drive_hash" -v engine="$ENGINE" '
        FILENAME ~ /hashes$/ { hash[$1] = $2; next }
        FILENAME ~ /durations$/ { seconds[$1] = $2; next }
        { print $1, $2, $3, prefix "-" hash[$4] "-" hash[$5] "-" engine, $4, $5, seconds[$5] }' \
        "$work/hashes" "$work/durations" "$work/pairs" >"$work/tasks"
}

# The tasks that run in s51, too: drawn with a fixed seed from those whose runs in the fast engine took at most
# SAMPLE_S simulated seconds, because s51 takes a second of a core for three of them.
SAMPLE_S=3
draw_sample() {
    local key
    : >"$work/sample"
    [ "$ENGINE" = fast ] && [ "$SAMPLE" -gt 0 ] || return 0
    cut -f4 "$work/tasks" | sort -u | while read -r key; do existing "$runs/$key/result.json"; done | xargs -r awk -v OFS='\t' '
        $1 == "\"duration_s\":" { seconds = $2 + 0 }
        $1 == "\"boot_s\":" { n = split(FILENAME, part, "/"); print part[n - 1], seconds + $2; nextfile }' >"$work/seconds"
    awk -F '\t' -v OFS='\t' -v most="$SAMPLE_S" '
        BEGIN { srand(1) }
        FILENAME ~ /seconds$/ { seconds[$1] = $2; next }
        $4 in seconds && seconds[$4] <= most && !seen[$4]++ { $7 = seconds[$4]; print rand(), $0 }' "$work/seconds" "$work/tasks" |
        sort -g | cut -f2- | awk -v most="$SAMPLE" 'NR <= most' | sed 's/-fast\t/-s51\t/' >"$work/sample"
}

# The exit status of each run that has ended: lines of key, status.
exit_statuses() {
    find "$runs" -mindepth 2 -maxdepth 2 -name exit -not -path '*.part/*' -exec awk -v OFS='\t' \
        'FNR == 1 { n = split(FILENAME, part, "/"); print part[n - 1], $0 }' {} + >"$work/statuses"
}

# What is left to run of a file of tasks: lines of key, image's file, board, scenario's file, limit of seconds,
# engine. A run that failed is tried again; two tasks with one key are one run.
list_todo() { # TASKS
    exit_statuses
    awk -F '\t' -v OFS='\t' -v board="$board" '
        FILENAME ~ /statuses$/ { done[$1] = $2 == "0" || $2 == "1"; next }
        !done[$4]++ { engine = $4; sub(/.*-/, "", engine); print $4, $5, board, $6, int(60 + 30 * $7), engine }' \
        "$work/statuses" "$1" >"$work/todo"
}

# --- run ------------------------------------------------------------------------------------------------
announce() { # TASKS
    # s51 in lockstep makes some 3 simulated seconds a second on a core, and its start takes half a second;
    # the fast engine makes 100, and a run with all that is around it takes 40 ms.
    awk -F '\t' -v jobs="${JOBS:-$(nproc)}" -v engine="$(head -n 1 "$1" | cut -f4 | sed 's/.*-//')" -v total="$(wc -l <"$1")" -v todo="$todo" -v login="$SSHLOGIN" '
        FILENAME ~ /todo$/ { wanted[$1] = 1; next }
        wanted[$4] { seconds += $7; work_s += $4 ~ /-s51$/ ? $7 / 3 + 0.5 : $7 / 100 + 0.04; wanted[$4] = 0 }
        END {
            printf "report: %d runs by %s, %d of them done before", total, engine, total - todo
            if (todo) printf "; %.0f simulated seconds, at most about %.0f s on %d cores%s", seconds, work_s / jobs + 10, jobs, login == ":" ? "" : " of this machine alone"
            print ""
        }' "$work/todo" "$1"
}

# One line a twentieth, with the time left; on a terminal one line that is written over.
progress() {
    local count=0 failed=0 begun=$SECONDS word step left text
    step=$(((todo + 19) / 20))
    while read -r word _; do
        count=$((count + 1))
        [ "$word" = failed ] && failed=$((failed + 1))
        left=$(((SECONDS - begun) * (todo - count) / count))
        printf -v text 'report: %d of %d runs, %d failed, %d:%02d left' "$count" "$todo" "$failed" $((left / 60)) $((left % 60))
        if [ -t 1 ]; then
            printf '\r%s \033[K' "$text"
        elif [ $((count % step)) = 0 ] || [ "$count" = "$todo" ]; then
            echo "$text"
        fi
    done
    if [ -t 1 ] && [ "$count" -gt 0 ]; then echo; fi
}

run_todo() {
    local remote=() command
    command="$here/run_one.sh {1} {2} {3} {4} {5} {6} $(printf %q "$runs")"
    if [ "$SSHLOGIN" != : ]; then
        # Each run has a folder of its own on the other machine, so that its clean-up takes no file of
        # another run, and none of ours if that machine has our home. This machine has run_one.sh already.
        remote=(--workdir ... --transferfile "$DRIVE" --transferfile "$here/run_one.sh" --transferfile '{2}' --transferfile '{4}'
            --return "$runs/{1}" --cleanup)
        command="[ -x $here/run_one.sh ] || cd $(printf %q "$PWD") && $command"
    fi
    # Whoever ends this script, even by its process number alone, ends the runs with it.
    exec 3< <(exec parallel --will-cite --colsep '\t' ${JOBS:+--jobs "$JOBS"} --sshlogin "$SSHLOGIN" "${remote[@]}" --env DRIVE \
        "$command" <"$work/todo")
    running=$!
    trap 'kill $running; wait $running || true; echo "report.sh: error: stopped; the same command goes on from here" >&2; exit 130' INT TERM HUP
    progress <&3
    exec 3<&-
    trap - INT TERM HUP
    # A machine that cannot be reached has had no runs: they are counted as lost below.
    wait $running || echo "report.sh: warning: parallel ended with status $?" >&2
}

run_tasks() { # TASKS
    list_todo "$1"
    todo=$(wc -l <"$work/todo")
    announce "$1"
    if [ "$todo" -gt 0 ]; then run_todo; fi
}

# --- page -----------------------------------------------------------------------------------------------
# Text files as one JSON object, by name.
text_files() { # FILE...
    if [ $# -eq 0 ]; then
        echo '{}'
    else
        jq -Rn 'reduce inputs as $line ({}; .[input_filename] += $line + "\n")' "$@"
    fi
}

# CSV files with a head as one JSON object: {FILE: {COLUMN: [NUMBER...]}}. What is not a number is null.
csv_files() { # FILE...
    awk -F, '
        function flush(    c) {
            if (file == "") return
            printf "%s\"%s\":{", (files++ ? "," : "{"), file
            for (c = 1; c <= columns; c++) printf "%s\"%s\":[%s]", (c > 1 ? "," : ""), head[c], column[c]
            printf "}"
        }
        FNR == 1 {
            flush()
            file = FILENAME
            columns = NF
            for (c = 1; c <= columns; c++) {
                head[c] = $c
                gsub(/"/, "", head[c])
                column[c] = ""
            }
            next
        }
        {
            for (c = 1; c <= columns; c++)
                column[c] = column[c] (FNR > 2 ? "," : "") ($c ~ /^-?(0|[1-9][0-9]*)([.][0-9]+)?(e[-+]?[0-9]+)?$/ ? $c : "null")
        }
        END {
            flush()
            print files ? "}" : "{}"
        }' "$@" </dev/null
}

# The data files of a tab's figures that there are; {} in a name stands for each image that is built.
tab_tables() { # TAB
    local file image
    tab_values "$1" figure | awk -F ' *[|] *' '$5 != "" { print $5 }' | while read -r file; do
        built_images "$1" | while read -r image; do existing "${file//\{\}/$image}"; done
    done
}

# What a page needs to drive a tab's images itself, or null: the tab says with which scenario it begins.
chip_files() { # TAB ID
    local scenario image
    scenario=$(tab_values "$1" yourself)
    if [ -z "$scenario" ] || [ ! -f "$WASM" ]; then
        echo null
        return
    fi
    awk -F '\t' -v OFS='\t' -v id="$2" '$1 == id && !seen[$2]++ { print $2, $5 }' "$work/tasks" | while IFS=$'\t' read -r image hex; do
        jq -Rsc --arg image "$image" '{($image): .}' "$hex"
    done | jq -sc --arg board "$board" --rawfile scenario "$scenario" '{board: $board, hex: add, scenario: $scenario}'
}

# What the page shows of one tab, as JSON.
collect() { # TAB ID
    local tab=$1 id=$2 keys
    mapfile -t keys < <(awk -F '\t' -v id="$id" '$1 == id && !seen[$4]++ { print $4 }' "$work/tasks")
    mapfile -t scenario_files < <(awk -F '\t' -v id="$id" '$1 == id && !seen[$6]++ { print $6 }' "$work/tasks")
    mapfile -t said < <(for key in "${keys[@]}"; do existing "$runs/$key/exit" "$runs/$key/log"; done)
    mapfile -t results < <(for key in "${keys[@]}"; do
        case $(cat "$runs/$key/exit" 2>/dev/null || true) in 0 | 1) echo "$runs/$key/result.json" ;; esac
    done)
    mapfile -t tables < <(tab_tables "$tab")
    text_files "${scenario_files[@]}" "${said[@]}" >"$work/texts_$id.json"
    csv_files "${tables[@]}" >"$work/tables_$id.json"
    chip_files "$tab" "$id" >"$work/chip_$id.json"
    jq -nc -f $here/collect.jq --arg id "$id" --arg built "$(xargs <"$work/built")" --rawfile tab "$tab" --rawfile tasks "$work/tasks" \
        --slurpfile texts "$work/texts_$id.json" --slurpfile tables "$work/tables_$id.json" --slurpfile chip "$work/chip_$id.json" --arg runs "$runs" --arg out "$REPORT_OUT" \
        "${results[@]}" </dev/null
}

# What the controllers take of each board ("sheets"), and what make bench has left ("texts").
costs() {
    local fragment board apps
    for fragment in firmware/boards/*.mk; do
        board=$(basename "$fragment" .mk)
        mapfile -t apps < <(existing "build/$board"/*.mem | sed 's|.*/||; s|[.]mem$||')
        [ ${#apps[@]} -eq 0 ] || tools/memory.sh "$board" "build/$board" "${apps[@]}"
    done >"$work/memory"
    mapfile -t texts < <(existing build/bench/*.txt)
    text_files "${texts[@]}" | jq -c --rawfile memory "$work/memory" -f $here/costs.jq
}

# What of the firmware the tests reach, if make test has left that.
coverage() {
    local name when=()
    for name in host chip; do
        when+=("$(date -r "$COVERAGE/$name.json" '+%Y-%m-%d, %H:%M' 2>/dev/null || echo never)")
        cat "$COVERAGE/$name.json" 2>/dev/null >"$work/coverage_$name.json" || true
    done
    jq -nc --arg host_at "${when[0]}" --arg chip_at "${when[1]}" --slurpfile host "$work/coverage_host.json" \
        --slurpfile chip "$work/coverage_chip.json" -f $here/coverage.jq
}

# Whether the drives of the sample come out alike in both engines. What does not agree is trouble.
compare_engines() {
    : >"$work/agreement.json"
    [ -s "$work/sample" ] || return 0
    sed "s|^|$runs/|" <(cut -f4 "$work/sample") >"$work/keys"
    while read -r folder; do existing "$folder/result.json" "${folder%-s51}-fast/result.json"; done <"$work/keys" >"$work/compared"
    xargs jq -nc -f $here/compare.jq --rawfile sample "$work/sample" --arg runs "$runs" <"$work/compared" >"$work/agreement.json"
    jq -r '.differ[] | "the engines disagree: " + .' "$work/agreement.json" >>"$work/trouble"
}

write_page() {
    local ids id part collecting=()
    ids=$(cut -f1 "$work/tasks" | uniq) # a tab with nothing to show is left out
    for id in $ids; do
        collect "$(echo "$here"/tabs/*-"$id".tab)" "$id" >"$work/$id.json" &
        collecting+=($!)
    done
    for part in "${collecting[@]}"; do wait "$part"; done
    costs >"$work/costs.json"
    coverage >"$work/coverage.json"
    for id in $ids; do echo "$work/$id.json"; done | xargs cat |
        jq -sc --arg made "Board $board, $count drives by the engine $ENGINE, $lost failed." --slurpfile costs "$work/costs.json" --slurpfile coverage "$work/coverage.json" \
            --slurpfile agreement "$work/agreement.json" \
            '{made: ([$made, $agreement[].said] | join(" ")), disagree: [$agreement[].differ[]], tabs: .} + $costs[0] + $coverage[0]' | sed 's/</\\u003c/g' >"$work/data.json"
    cat $here/selftest.js $here/figures.js $here/scenes.js $here/player.js $here/yourself.js $here/page.js >"$work/script.js"
    base64 -w 0 "$WASM" >"$work/chip.txt" 2>/dev/null || echo "no $WASM, so the page has no chip; run make report" >>"$work/trouble"
    echo >>"$work/chip.txt"
    part=$REPORT_OUT/index.html.part
    sed -e "/^@CSS@\$/{r $here/page.css" -e 'd}' -e "/^@DATA@\$/{r $work/data.json" -e 'd}' -e "/^@CHIP@\$/{r $work/chip.txt" -e 'd}' \
        -e "/^@SCRIPT@\$/{r $work/script.js" -e 'd}' $here/page.html >"$part"
    mv "$part" "$REPORT_OUT/index.html"
    echo "report: $REPORT_OUT/index.html, $(($(wc -c <"$REPORT_OUT/index.html") / 1024)) KiB"
}

# --- in order -------------------------------------------------------------------------------------------
check_knobs
mkdir -p "$runs" "$REPORT_OUT/scenarios"
rm -rf "$work" "$REPORT_OUT"/scenarios/*.scn
mkdir -p "$work"
: >"$work/trouble"
: >"$work/built"
build/drive scenarios --map="$MAP" "$REPORT_OUT/scenarios" || fail "drive wrote no scenarios"
list_tasks
run_tasks "$work/tasks"
draw_sample
if [ -s "$work/sample" ]; then run_tasks "$work/sample"; fi
count=$(wc -l <"$work/tasks")
exit_statuses
lost=$(awk -F '\t' 'FILENAME ~ /statuses$/ { done[$1] = $2 == "0" || $2 == "1"; next } !done[$4] { lost++ } END { print lost + 0 }' \
    "$work/statuses" "$work/sample" "$work/tasks")
compare_engines
write_page
if [ "$lost" -gt 0 ]; then echo "report.sh: error: $lost runs failed; the page names them, 'make report' tries them again" >&2; fi
if [ -s "$work/trouble" ]; then cat "$work/trouble" >&2; fi
[ "$lost" = 0 ] && ! [ -s "$work/trouble" ]
