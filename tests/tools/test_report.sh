#!/bin/bash
# SPDX-License-Identifier: MIT
# The report: its scenarios, its runs (complete, failed, interrupted, changed), and its page, which
# headless Chromium loads and goes through by itself.
. tests/lib.sh

# --- scenarios -------------------------------------------------------------------------------------
build/drive scenarios --map=fine "$out/scenarios" && build/drive scenarios --map=fine "$out/again"
wrong=$(diff -r "$out/scenarios" "$out/again" | head -n 1)
faultless same_scenarios_each_time "$wrong"

wrong=$(build/drive list "$out/scenarios" 2>&1 >"$out/list" | head -n 3)
files=("$out"/scenarios/*.scn)
[ "$(wc -l <"$out/list")" -ge ${#files[@]} ] || wrong="$wrong $(wc -l <"$out/list") lines for ${#files[@]} files"
faultless drive_reads_every_scenario "$wrong"

# By hand, A = 8 m/s2, L = 0.35 s, 5 m: 6.5 m/s needs 6.5 * 0.35 + 6.5^2 / 16 = 4.92 m; 6.75 m/s needs 5.21 m
# and arrives with sqrt(6.75^2 - 16 * (5 - 6.75 * 0.35)) = 1.83; 20 m/s is there before the brake acts.
# Both at 10 m/s, 5 m apart, 10 m/s2: the brake acts at 0.43 s, when 0.9246 m are lost and the lead does
# 5.7 m/s; it stands at 1 s after 5 m; the own car, then at 10 - 8 * 0.57 = 5.44 m/s, has driven 8.7004 m,
# has 1.2996 m left and arrives with sqrt(5.44^2 - 16 * 1.2996) = 2.97.
owed() {
    sed -n '/^\[expect\]/,$p' "$out/scenarios/$1.scn" | grep -q "^$2\$" || echo "$1 does not owe $2;"
}
wrong="$(owed limit_06.50 'impact = none')$(owed limit_06.75 'impact_mps <= 1.83')$(owed seen_20.0 'impact_mps <= 20.00')"
wrong="$wrong$(owed map_v10_b10 'impact_mps <= 2.97')$(owed map_v10_b08 'impact = none')$(owed false_open 'max_brake_pct <= 0')"
wrong="$wrong$(owed ccrb_030_1s 'full_brake_within_s <= 0.06')"
faultless outcomes_as_worked_by_hand "$wrong"

# --- runs ---------------------------------------------------------------------------------------------
# A drive that can be told to fail: it notes each run, dies on scenarios named in $out/die, ends without
# a result on those in $out/empty, waits on all while $out/slow is there, and lets s51 report one state more
# while $out/lie is there.
cat >"$out/drive" <<END
#!/bin/sh
for word; do case \$word in *.scn) name=\$(basename "\$word" .scn) ;; esac done
echo "\$name" >>$out/calls
[ ! -f $out/slow ] || sleep 2
if grep -qx "\$name" $out/die 2>/dev/null; then kill -9 \$\$; fi
if grep -qx "\$name" $out/empty 2>/dev/null; then exit 0; fi
build/drive "\$@"
status=\$?
case "\$*" in *"--engine s51 "*) [ ! -f $out/lie ] || sed -i '/"reached":/s/"\$/, LIE"/' "\${*##*--json }" ;; esac
exit \$status
END
chmod +x "$out/drive"
start_report() { # in place of the shell that calls it
    exec env DRIVE="${drive:-$out/drive}" ENGINE="${engine:-fast}" SAMPLE="${sample:-0}" REPORT_OUT="$out/report" COVERAGE="$out/coverage" MAP=coarse JOBS=2 IMAGES="${images:-brake}" \
        ONLY="${only:-seen_02.0 false_open cutin_1.5}" SSHLOGIN="${login:-:}" \
        tools/report/report.sh "${board:-stc89c516rd}" >"$out/log" 2>&1
}
run_report() {
    (start_report)
}
count_runs() { # true|false: the brake's runs that ended so
    jq "[.runs[] | select(.ok == $1)] | length" "$out/report/parts/brake.json"
}
calls() {
    wc -l 2>/dev/null <"$out/calls" || echo 0
}
# What pages say of their tests of themselves, each in a frame as wide as WIDTH pixels: a window has at least
# 500. One start of Chromium is for all: $out/said gets lines "FRAME: what the page says". Chromium's own log,
# $out/browser, shows what the pages said on the console. On a busy machine the browser's time may be over before a
# page has its chip: then it gets more.
self_tests() { # WIDTH PAGE...
    local profile budget_ms
    profile=$(mktemp -d)
    {
        echo '<html><body>'
        printf '<iframe style="border:0;width:%spx;height:900px" src="report/%s#selftest"></iframe>\n' "$@"
        cat <<'END'
<script>
const frames = [...document.querySelectorAll("iframe")].map((frame) => frame.contentWindow);
onmessage = (message) => { document.body.append(`said ${frames.indexOf(message.source)}: ${message.data}\n`); };
</script>
END
    } >"$out/frame.html"
    for budget_ms in 30000 120000 480000; do
        timeout 120 chromium --headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking \
            --disable-component-update --disable-sync --user-data-dir="$profile" --enable-logging=stderr \
            --window-size=1400,1000 --virtual-time-budget=$budget_ms --dump-dom "file://$PWD/$out/frame.html" \
            2>"$out/browser" | grep -o 'said [0-9]*: [^<]*' | sed 's/^said //' >"$out/said"
        [ "$(cut -d : -f 1 "$out/said" | sort -u | wc -l)" -lt $(($# / 2)) ] || break
    done
    rm -rf "$profile"
}
page_fault() { # FRAME WIDTH [CHIP]: CHIP is what the page says first of its own drive
    local said
    said=$(sed -n "s/^$1: //p" "$out/said")
    [[ $said == "passed: "*" 0 faults, $2 px wide; chip: ${3:-}"* ]] || echo "the page says: '$said'"
}
keep_page() { # NAME
    cp "$out/report/index.html" "$out/report/$1.html"
}

echo false_open >"$out/die"
echo cutin_1.5 >"$out/empty"
run_report
status=$?
wrong=
[ $status = 1 ] || wrong="exit status $status: $(tail -n 2 "$out/log")"
[ "$(count_runs true)" = 1 ] || wrong="$wrong not one good run"
[ "$(count_runs false)" = 2 ] || wrong="$wrong not two failed runs"
grep -q '2 runs failed' "$out/log" || wrong="$wrong the failures are not said"
faultless a_failed_run_is_reported_and_loses_no_other "$wrong"

keep_page failed
grep -q '"error":"exit status 2: drive ended with 0 but left no result"' "$out/report/failed.html"
say the_page_names_failed_runs $? "no reason is given"

# What make test has measured: nothing in the first report, two files in the next.
early=$(jq -c '.coverage[] | select(.rows != [] or (.caption | test("make test measures it") | not)) | .title' "$out/report/parts/data.json")
mkdir -p "$out/coverage"
echo '{"files":[{"file":"a.c","lines":8,"lines_reached":6,"branches":2,"branches_reached":2},{"file":"b.c","lines":2,"lines_reached":2,"branches":0,"branches_reached":0}]}' >"$out/coverage/host.json"
echo '{"boards":["one","two"],"files":[{"file":"c.c","instructions":30,"run":20,"explained":9}]}' >"$out/coverage/chip.json"

rm -f "$out/die" "$out/empty" "$out/calls"
run_report
status=$?
wrong=
[ $status = 0 ] || wrong="exit status $status: $(tail -n 2 "$out/log")"
[ "$(sort "$out/calls" | tr '\n' ' ')" = "cutin_1.5 false_open " ] || wrong="$wrong ran $(tr '\n' ' ' <"$out/calls")"
faultless only_failed_runs_are_run_again "$wrong"
wrong=$early
[ "$(jq -c '[.coverage[].rows[]]' "$out/report/parts/data.json")" = '[["a.c","6 of 8","2 of 2"],["b.c","2 of 2","–"],["all","8 of 10","2 of 2"],["","80 %","100 %"],["c.c","20 of 30",9],["all","20 of 30",9],["","66.6 %",""]]' ] ||
    wrong="$wrong $(jq -c '[.coverage[].rows[]]' "$out/report/parts/data.json")"
grep -q 'on one, two, as make test found on 20' "$out/report/index.html" || wrong="$wrong the boards are not said"
faultless the_page_shows_what_the_tests_reach "$wrong"

rm -f "$out/calls"
run_report
faultless nothing_is_run_twice "$([ "$(calls)" = 0 ] || echo "$(calls) runs")"

# Another drive, another image (here of another board): other results. The old ones stay good.
rm -f "$out/calls"
echo '# changed' >>"$out/drive"
run_report
wrong=
[ "$(calls)" = 3 ] || wrong="$(calls) runs with another drive"
board=generic8052 run_report
[ "$(calls)" = 6 ] || wrong="$wrong $(calls) runs with another image"
run_report
[ "$(calls)" = 6 ] || wrong="$wrong $(calls) runs back with the first image"
faultless results_are_bound_to_their_inputs "$wrong"

# The sample: as many short drives in s51, too, the same ones each time; what differs makes the report fail.
short='seen_12.0 seen_20.0 seen_35.0' # the shortest for s51
rm -f "$out/calls"
only=$short sample=2 run_report
status=$?
wrong=
[ $status = 0 ] || wrong="exit status $status: $(tail -n 2 "$out/log")"
[ "$(calls)" = 5 ] || wrong="$wrong $(calls) runs for three new drives and a sample of 2"
grep -q '3 drives by the engine fast, 0 failed. Of these, 2 drawn at random were driven in s51, too: all agree' "$out/report/index.html" ||
    wrong="$wrong the page does not say so"
only=$short sample=2 run_report
[ "$(calls)" = 5 ] || wrong="$wrong another sample the second time"
faultless a_sample_runs_in_s51_too "$wrong"
touch "$out/lie"
rm -rf "$out"/report/runs/*-s51
only=$short sample=2 run_report
status=$?
wrong=
[ $status = 1 ] || wrong="exit status $status"
[ "$(grep -c '^the engines disagree: brake/.*LIE' "$out/log")" = 2 ] || wrong="$wrong the log does not name them: $(tail -n 2 "$out/log")"
grep -q '2 disagree' "$out/report/index.html" || wrong="$wrong the page does not say so"
faultless a_disagreement_of_the_engines_fails "$wrong"
keep_page disagreement
rm -rf "$out/lie" "$out"/report/runs/*-s51
rm -f "$out/calls"
engine=s51 only=seen_20.0 run_report
wrong=
[ "$(calls)" = 1 ] || wrong="$(calls) runs"
grep -q '1 drives by the engine s51, 0 failed."' "$out/report/index.html" || wrong="$wrong the page does not say s51"
faultless another_engine_can_be_chosen "$wrong"

# Interrupted in the middle of runs: no run goes on, what was complete stays, the rest follows.
rm -rf "$out/report/runs" "$out/calls"
touch "$out/slow"
only='seen_0[0-5]* cutin_* map_*' start_report &
running=$!
for _ in $(seq 600); do
    sleep 0.2
    [ "$(find "$out/report/runs" -name exit 2>/dev/null | grep -vc part)" -ge 2 ] && break
done
kill -TERM $running
wait $running
status=$?
# A busy machine may take its time over a process that has been killed.
for _ in $(seq 50); do
    wrong=$(for pid in $(pgrep -f "$out/report/runs"); do
        [ ! "/proc/$pid/cwd" -ef . ] || tr '\0' ' ' <"/proc/$pid/cmdline"
    done 2>/dev/null | head -c 300)
    [ -n "$wrong" ] || break
    sleep 0.2
done
[ $status = 130 ] || wrong="exit status $status; $wrong"
grep -q 'stopped; the same command goes on from here' "$out/log" || wrong="nothing is said of it; $wrong"
faultless an_interrupted_report_ends_its_runs "$wrong"
rm -f "$out/slow"
done_before=$(find "$out/report/runs" -name exit -not -path '*.part/*' -exec grep -lxE '0|1' {} + | wc -l)
wanted=$(cd "$out/report/scenarios" && printf '%s\n' seen_0[0-5]* cutin_* map_* | wc -l)
rm -f "$out/calls"
only='seen_0[0-5]* cutin_* map_*' run_report
wrong=
[ "$done_before" -ge 2 ] && [ "$done_before" -lt "$wanted" ] || wrong="$done_before of $wanted were done when it was interrupted"
[ "$(calls)" = $((wanted - done_before)) ] || wrong="$wrong $(calls) runs to complete $done_before of $wanted"
[ "$(count_runs true)" = "$wanted" ] || wrong="$wrong not all are there"
faultless an_interrupted_report_goes_on "$wrong"

# Another machine, by a stand-in for ssh: a folder that has nothing of ours, and the HOME and SHELL that
# sshd sets. Two runs at a time use one image there, this machine runs its share, and nothing is left behind.
cat >"$out/ssh" <<END
#!/bin/sh
echo "\$@" >>$PWD/$out/ssh_calls
while [ "\$1" != far ]; do shift; done
shift
[ "\$1" != -- ] || shift
cd $PWD/$out/far && HOME=\$PWD SHELL=/bin/sh exec sh -c "\$*"
END
chmod +x "$out/ssh"
mkdir -p "$out/far"
rm -rf "$out/report/runs"
drive=build/drive only='seen_0[0-5]* cutin_*' login="1/:,2/$PWD/$out/ssh far" run_report
status=$?
wrong=
[ $status = 0 ] || wrong="exit status $status: $(tail -n 2 "$out/log")"
grep -q GNU_Parallel_worker "$out/ssh_calls" || wrong="$wrong nothing ran there"
faultless runs_on_another_machine "$wrong$(find "$out/far" -mindepth 1 | head -n 3)"

# --- the page --------------------------------------------------------------------------------------------
# One run for each tab, and the one that the chip in the page drives, too.
wrong=
images='brake brake_far radar gap follow park' only='seen_02.0 frame_noise standing_car_3mps' run_report
status=$?
[ $status = 0 ] || wrong="exit status $status: $(tail -n 2 "$out/log")"
wrong="$wrong$(for id in brake radar gap follow park; do grep -q "{\"id\":\"$id\"" "$out/report/index.html" || echo " no tab $id"; done)"
faultless a_tab_for_each_controller "$wrong"
faultless each_image_says_who_it_is "$(jq -r '.images[] | select(.who | test("^fuzzy51 [0-9.]+ [a-z/_]+ stc89c516rd [0-9]+ Hz( tfluna)? table=0x[0-9A-F]+$") | not) | .id + ": " + .who' \
    "$out"/report/parts/{brake,radar,gap,follow,park}.json 2>&1)"
gap=$(build/drive run --engine=fast --board=stc89c516rd --scenario=tests/loop/standing_car_3mps.scn --json="$out/chip.json" >/dev/null &&
    printf '%.3f' "$(jq .outcome.stop_gap_m "$out/chip.json")")
self_tests 1280 index.html 375 index.html 1280 failed.html 375 disagreement.html
faultless page_works_at_1280_px "$(page_fault 0 1280 "brake impact_mps 0.000, brake stop_gap_m $gap, ")"
faultless page_works_at_375_px "$(page_fault 1 375 "brake impact_mps 0.000, brake stop_gap_m $gap, ")"
faultless page_with_failed_runs_works "$(page_fault 2 1280)"
faultless page_with_a_disagreement_works "$(page_fault 3 375)"
faultless pages_say_nothing_on_the_console "$(grep CONSOLE "$out/browser" | head -n 3)"
faultless page_needs_no_network "$(grep -oiE '(src|href|url\()[= ]*["'\'']?(https?:)?//[^"'\'' >]*' "$out/report/index.html" | head -n 1)"
finish
