#!/bin/bash
# SPDX-License-Identifier: MIT
# docs/drive.md says of scenarios and of JSON what drive really does: its tables of keys are those that
# `drive keys` prints, and its table of JSON has the members that a run writes.
. tests/lib.sh
page=docs/drive.md
drive=build/drive

# From "### [scenario]" to the next "## ", without the empty line before that.
sed -n '/^### \[scenario\]/,/^## /{/^## /d;p}' $page | sed '${/^$/d}' >"$out/shown"
$drive keys >"$out/keys"
diff "$out/keys" "$out/shown" >"$out/diff"
say "the tables of keys are what drive keys prints" $? "$(head -n 4 "$out/diff"); put the output of build/drive keys there"
# shellcheck disable=SC2013  # names of worlds have no blanks
for app in $(sed -n 's/^WORLD(\(.*\))$/\1/p' build/worlds.h); do
    $drive keys "$app" >"$out/app" && grep -q '^### \[scenario\]' "$out/app" && ! grep -q '|  |  |  |' "$out/app"
    say "the keys of $app" $? "$(head -n 3 "$out/app")"
done

$drive run --board stc89c516rd --scenario tests/loop/standing_car_3mps.scn --set scenario.duration_s=0.5 \
    --json "$out/run.json" --csv "$out/run.csv" >/dev/null
sed -n '/^## JSON/,/^## [^J]/s/^| `\([a-z_]*\)` | .*/\1/p' $page | sort >"$out/documented"
(jq -r 'keys[]' "$out/run.json" && echo image) | sort -u >"$out/written"
diff "$out/documented" "$out/written" >"$out/diff"
say "JSON has the members of the page" $? "$(cat "$out/diff")"
jq -r '.series | keys_unsorted[]' "$out/run.json" >"$out/series"
head -n 1 "$out/run.csv" | sed 's/,image$//' | tr , '\n' >"$out/columns"
diff "$out/columns" "$out/series" >"$out/diff"
say "a series for each column of CSV" $? "$(cat "$out/diff")"
rows=$(($(wc -l <"$out/run.csv") - 1))
jq -e --argjson rows "$rows" '[.series[] | type == "array" and length == $rows] | all' "$out/run.json" >/dev/null
say "as many values as CSV has rows" $? "$rows rows"
jq -e '[.expect[] | keys == ["expected", "holds", "value"] and (.holds | type) == "boolean" and (.expected | type) == "string"
    and (.value | type) == "string"] | length > 0 and all' "$out/run.json" >/dev/null
say "each expectation has its members" $? "$(jq -c '.expect[0]' "$out/run.json")"
$drive keys | sed -n 's/^| `\([a-z_0-9]*\)` | \(=\|<=\|=, <=\) .*/\1/p' | grep -v '^never$\|^uart_says$' | sort >"$out/metrics"
jq -r '.outcome | keys[]' "$out/run.json" | sort >"$out/outcome"
diff "$out/metrics" "$out/outcome" >"$out/diff"
say "an outcome for each metric" $? "$(cat "$out/diff")"
jq -e '[.outcome[] | type == "number" or type == "null" or type == "string"] | all' "$out/run.json" >/dev/null
say "outcomes are numbers, texts or null" $? "$(jq -c .outcome "$out/run.json")"
finish
