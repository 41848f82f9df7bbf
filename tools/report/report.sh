#!/bin/bash
# SPDX-License-Identifier: MIT
# The closed-loop report: each controller on each scenario, on all cores, as one page.
#     tools/report/report.sh BOARD            writes build/report/index.html
# A result stands under a name made of the hashes of drive, image and scenario: what has run is not
# run again, so an interrupted report goes on where it stopped and a changed image runs anew. Exit
# status: 0 fine; 1 a run failed or a figure could not be made: the page says which; 2 nothing could
# be run. Knobs, from the environment:
#     MAP=coarse|normal|fine   how fine the avoidance map is
#     ONLY='GLOB...'           only scenarios of these names
#     IMAGES='NAME...'         only these images
#     JOBS=N                   so many runs at a time, instead of one a core
#     SSHLOGIN=A,B,:           machines for GNU parallel; ':' is this one
set -euo pipefail

board=${1:?"which board?"}
: "${MAP:=normal}" "${ONLY:=*}" "${IMAGES:=}" "${JOBS:=}" "${SSHLOGIN:=:}" "${DRIVE:=build/drive}" "${REPORT_OUT:=build/report}"
export DRIVE
here=tools/report
runs=$REPORT_OUT/runs
work=$REPORT_OUT/parts
mkdir -p "$runs" "$REPORT_OUT/scenarios"
rm -rf "$work"
mkdir -p "$work/traces" "$work/figures"

fail() {
    echo "report.sh: error: $1" >&2
    exit 2
}

# Values of a key of a tab's description, one a line.
tab_values() {
    sed -n "s/^$2 *= *//p" "$1"
}

read -ra only <<<"$ONLY"
wanted() {
    local glob
    for glob in "${only[@]}"; do
        # shellcheck disable=SC2053  # a pattern
        [[ $1 == $glob ]] && return 0
    done
    return 1
}

tab_id() {
    basename "$1" .tab | sed 's/^[0-9]*-//'
}

short_hash() {
    sha256sum "$1" | cut -c1-10
}

# --- what is to be run --------------------------------------------------------------------------------
case $MAP in
coarse | normal | fine) ;;
*) fail "MAP=$MAP: use coarse, normal or fine" ;;
esac
case $JOBS in
'') ;;
*[!0-9]* | 0*) fail "JOBS=$JOBS: give a whole number, 1 or more" ;;
esac
images=$(for tab in "$here"/tabs/*.tab; do tab_values "$tab" image | cut -d'|' -f1; done | xargs)
for image in $IMAGES; do
    [[ " $images " == *" $image "* ]] || fail "no image '$image'; the images are: $images"
done
[ -x "$DRIVE" ] || fail "no $DRIVE; run make"
rm -f "$REPORT_OUT"/scenarios/*.scn
$here/scenarios.sh --map="$MAP" "$REPORT_OUT/scenarios"

# The scenarios of a tab: lines of file, name, the one image that it is for or *. A file may name its
# image itself (app = ...); those under "own" are for the first image of the tab. A prefix that marks a
# variant's files is dropped from the name, so that variants stand side by side.
scenarios_of() {
    local tab=$1 key file prefixes
    prefixes=$(tab_values "$tab" variant | tr ' ' '|')
    for key in scenarios own; do
        for file in $(tab_values "$tab" $key | sed "s|build/report/|$REPORT_OUT/|g"); do
            [ -f "$file" ] || continue
            printf '%s\t%s\t%s\n' "$file" "$(basename "$file" .scn | sed -E "s/^(${prefixes:-^})//")" \
                "$(if [ $key = own ]; then tab_values "$tab" image | awk 'NR == 1 { print $1 }'; else sed -n 's/^app *= *//p' "$file"; fi)"
        done
    done
}

# All pairs of image and scenario.
built=
for tab in "$here"/tabs/*.tab; do
    id=$(tab_id "$tab")
    scenarios_of "$tab" >"$work/scenarios"
    for image in $(tab_values "$tab" image | cut -d'|' -f1); do
        hex=build/$board/$image.ihx
        [ -f "$hex" ] || continue
        [[ -z $IMAGES || " $IMAGES " == *" $image "* ]] || continue
        built="$built $image"
        hash=$(short_hash "$hex")
        while IFS=$'\t' read -r scenario name only_image; do
            if [ "${only_image:-$image}" = "$image" ] && wanted "$name"; then
                printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$id" "$image" "$name" "$hash" "$hex" "$scenario"
            fi
        done <"$work/scenarios"
    done
done >"$work/pairs"
[ -n "$built" ] || fail "no image of a controller in build/$board; run make BOARD=$board"
[ -s "$work/pairs" ] || fail "no scenario is called '$ONLY'"
# A tab with nothing to show is left out.
ids=$(cut -f1 "$work/pairs" | uniq)

# Tasks: tab, image, scenario, key, image's file, scenario's file, seconds of simulated time.
cut -f6 "$work/pairs" | sort -u >"$work/files"
xargs sha256sum <"$work/files" >"$work/hashes"
xargs awk '/^duration_s/ { print FILENAME, $NF }' <"$work/files" >"$work/durations"
awk -F '\t' -v OFS='\t' -v drive="$(short_hash "$DRIVE")" -v board="$board" -v hashes="$work/hashes" -v durations="$work/durations" '
BEGIN {
    while ((getline line <hashes) > 0) { split(line, part, /  */); hash_of[part[2]] = substr(part[1], 1, 10) }
    while ((getline line <durations) > 0) { split(line, part, " "); seconds_of[part[1]] = part[2] }
}
{ print $1, $2, $3, board "-" drive "-" $4 "-" hash_of[$6], $5, $6, seconds_of[$6] }' "$work/pairs" >"$work/tasks"

# A run that failed is tried again; two tasks with one key are one run.
while IFS=$'\t' read -r _ _ _ key hex scenario seconds; do
    case $(cat "$runs/$key/exit" 2>/dev/null || true) in
    0 | 1) ;;
    *) printf '%s\t%s\t%s\t%s\t%d\n' "$key" "$hex" "$board" "$scenario" "$(awk -v s="$seconds" 'BEGIN { print int(60 + 30 * s) }')" ;;
    esac
done <"$work/tasks" | awk -F '\t' '!seen[$1]++' >"$work/todo"

# --- run ------------------------------------------------------------------------------------------------
total=$(wc -l <"$work/tasks")
todo=$(wc -l <"$work/todo")
jobs=${JOBS:-$(nproc)}
# s51 in lockstep makes some 3 simulated seconds a second on a core; booting takes half a second more.
awk -F '\t' -v jobs="$jobs" -v total="$total" -v todo="$todo" -v login="$SSHLOGIN" '
FILENAME ~ /todo$/ { wanted[$1] = 1; next }
wanted[$4] { seconds += $7 + 0.5; wanted[$4] = 0 }
END {
    printf "report: %d runs, %d of them done before", total, total - todo
    if (todo) printf "; %.0f simulated seconds, at most about %.0f min on %d cores%s", seconds, seconds / 3 / jobs / 60 + 1, jobs, login == ":" ? "" : " of this machine alone"
    print ""
}' "$work/todo" "$work/tasks"

# One line a tenth, with the time left; on a terminal one line that is written over.
progress() {
    local count=0 failed=0 begun=$SECONDS word step left
    step=$(((todo + 19) / 20))
    while read -r word _; do
        count=$((count + 1))
        [ "$word" = failed ] && failed=$((failed + 1))
        left=$(((SECONDS - begun) * (todo - count) / count))
        if [ -t 1 ]; then
            printf '\rreport: %d of %d runs, %d failed, %d:%02d left \033[K' "$count" "$todo" "$failed" $((left / 60)) $((left % 60))
        elif [ $((count % step)) = 0 ] || [ "$count" = "$todo" ]; then
            printf 'report: %d of %d runs, %d failed, %d:%02d left\n' "$count" "$todo" "$failed" $((left / 60)) $((left % 60))
        fi
    done
    if [ -t 1 ] && [ "$count" -gt 0 ]; then echo; fi
}

remote=()
if [ "$SSHLOGIN" != : ]; then
    # Each run in a folder of its own, so that no run's clean-up takes another one's files, nor ours
    # where the other machine has our home. On this machine, run_one.sh is not brought there but here.
    remote=(--workdir ... --transferfile "$DRIVE" --transferfile "$here/run_one.sh" --transferfile '{2}' --transferfile '{4}'
        --return "$runs/{1}" --cleanup)
fi
if [ "$todo" -gt 0 ]; then
    # Whoever ends this script, and be it by its process number alone, ends the runs with it.
    # shellcheck disable=SC1083  # parallel's own braces
    exec 3< <(exec parallel --will-cite --colsep '\t' ${JOBS:+--jobs "$JOBS"} --sshlogin "$SSHLOGIN" "${remote[@]}" --env DRIVE \
        "[ -x $here/run_one.sh ] || cd $(printf %q "$PWD") && $here/run_one.sh {1} {2} {3} {4} {5} $(printf %q "$runs")" <"$work/todo")
    running=$!
    trap 'kill $running; wait $running || true; echo "report.sh: error: stopped; the same command goes on from here" >&2; exit 130' INT TERM HUP
    progress <&3
    exec 3<&-
    trap - INT TERM HUP
    # A machine that cannot be reached has had no runs: they are counted as lost below.
    wait $running || echo "report.sh: warning: parallel ended with status $?" >&2
fi

# --- figures and page -----------------------------------------------------------------------------------
: >"$work/trouble"
for id in $ids; do
    tab=$(echo $here/tabs/*-"$id".tab)
    tab_values "$tab" prepare | sed "s|build/report/|$REPORT_OUT/|g" | while read -r command; do
        sh -c "$command" >"$work/log" 2>&1 </dev/null || echo "$command: $(tail -n 1 "$work/log")" | tee -a "$work/trouble" >&2
    done
    awk -v tab="$tab" -v id="$id" -v runs="$runs" -v work="$work" -v built="$built" -v out="$REPORT_OUT" \
        -f $here/collect.awk "$work/tasks" >"$work/$id.json"
done
cat "$work"/*.figures | parallel --will-cite ${JOBS:+--jobs "$JOBS"} 2>>"$work/trouble" || true

escape() {
    sed -e 's/\\/\\\\/g; s/"/\\"/g; s/</\\u003c/g; s/\t/ /g'
}
lost=$(awk -F '\t' '$4 == "0" && FNR > 1' "$work"/*.values | wc -l)
{
    echo '{"made":"'"$(echo "Board $board, $total runs by s51, $lost failed." | escape)"'","tabs":['
    first=1
    for id in $ids; do
        [ -n "$first" ] || echo ,
        first=
        cat "$work/$id.json"
    done
    echo '],'
    $here/costs.sh
    echo '}'
} >"$work/data.json"
for figure in "$work"/figures/*.svg; do
    [ -f "$figure" ] || continue
    printf '<script type="image/svg+xml" id="figure-%s">' "$(basename "$figure" .svg)"
    cat "$figure"
    echo '</script>'
done >"$work/figures.html"
cat $here/selftest.js $here/scenes.js $here/player.js $here/page.js >"$work/script.js"
sed -e "/^@CSS@\$/{r $here/page.css" -e 'd}' -e "/^@FIGURES@\$/{r $work/figures.html" -e 'd}' \
    -e "/^@DATA@\$/{r $work/data.json" -e 'd}' -e "/^@SCRIPT@\$/{r $work/script.js" -e 'd}' \
    $here/page.html >"$REPORT_OUT/index.html.part"
mv "$REPORT_OUT/index.html.part" "$REPORT_OUT/index.html"
echo "report: $REPORT_OUT/index.html, $(($(wc -c <"$REPORT_OUT/index.html") / 1024)) KiB"
if [ "$lost" -gt 0 ]; then echo "report.sh: error: $lost runs failed; the page names them, 'make report' tries them again" >&2; fi
if [ -s "$work/trouble" ]; then cat "$work/trouble" >&2; fi
[ "$lost" = 0 ] && ! [ -s "$work/trouble" ]
