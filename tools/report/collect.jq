# SPDX-License-Identifier: MIT
# From the runs of one tab to what the page shows: the tab's object for the page's data.
#     jq -n -f collect.jq --arg id ID --arg built IMAGES --rawfile tab FILE.tab --rawfile tasks TASKS
#        --slurpfile texts TEXTS.json --slurpfile tables TABLES.json --slurpfile chip CHIP.json
#        --arg runs FOLDER --arg out FOLDER RESULT.json...
# TASKS has a line a run: tab, image, scenario, key, image's file, scenario's file. TEXTS.json holds text
# files by name: scenarios, and of each run its log and its exit status; TABLES.json holds CSV files by
# name, each as {column: values}; CHIP.json holds {board, hex: {IMAGE: TEXT}, scenario: TEXT} for a drive in the
# page, or null. The results are drive's, one a run: FOLDER/KEY/result.json.

def trim: gsub("^\\s+|\\s+$"; "");
def fields: split("|") | map(trim);
def or_null: if . == null or . == "" then null else . end;
def digits: (. // "" | or_null) // "0" | tonumber;
def rounded($digits): pow(10; $digits) as $scale | if type == "number" then (. * $scale | round) / $scale else . end;

# --- the tab's description ------------------------------------------------------------------------

# Values of a key, in order.
def entries($key): [$tab | split("\n")[] | select(contains($key)) | capture("^\\s*(?<key>\\w+)\\s*=\\s*(?<value>.*?)\\s*$")
    | select(.key == $key) | .value];
def first_of($key): entries($key)[0] // "";

def images: [entries("image") | map(fields) | to_entries[]
    | {id: .value[0], name: .value[1], short: (.value[2] | or_null // .value[1]), colour: (.key % 6 + 1)}];
def built_images: ($built | split(" ")) as $there | images | map(select(.id as $image | $there | index([$image])));
# A quantity "gap_mm*0.001-2": a column, times a factor, plus an offset.
def quantity: capture("^(?<source>\\w+)(\\*(?<factor>-?[0-9.]+))?(?<offset>[-+][0-9.]+)?$")
    | .factor = (.factor // "1" | tonumber) | .offset = (.offset // "0" | ltrimstr("+") | tonumber);
def columns: [entries("column")[] | fields
    | (.[0] | quantity) + {key: .[0], name: .[1], unit: .[2], digits: (.[3] | digits), steps: (.[4] == "steps"), shown: (.[5] == "shown"),
       is_word: (.[4] == "words"), is_switch: (.[4] == "words" or .[5] == "hidden")}];
def panels: [entries("panel")[] | fields
    | {label: .[0], column: .[1], reference: (.[2] | or_null), low: (.[3] | or_null | if . then tonumber else . end), high: (.[4] | or_null | if . then tonumber else . end)}];
def measures: [entries("measure")[] | fields | {key: .[0], name: .[1], unit: .[2], digits: (.[3] | digits)}];
def tiles: [entries("tile")[] | fields | {name: .[0], unit: .[1], digits: (.[2] | digits), kind: .[3], argument: (.[4] // "")}];
def groups: [entries("group")[] | fields | {id: .[0], title: .[1], listed: (.[2] != "figure")}];
def scene: first_of("scene") | fields | {name: .[0]} + ([.[1:] | .[] | split(" ") | {key: .[0], value: (.[1] | tonumber? // .)}] | from_entries);

# The group of a scenario: that of its prefix, or else the one for all others.
def group_of($groups): . as $name
    | (first($groups[] | select(.id as $id | $id == $name or ($name | startswith($id + "_")))) // first($groups[] | select(.id == "*")))
    // {id: "", title: "Scenarios", listed: true};

# --- scenarios --------------------------------------------------------------------------------------

def scenario($name): (. // "") | split("\n")
    | (map(capture("^title\\s*=\\s*(?<title>.*?)\\s*$").title)[0] // $name) as $title
    | (join("\n") | (split("[expect]")[1] // "") | split("\n[")[0] | split("\n")
        | map(trim | select(test("=") and (test("^[;#]|^impact *= *any") | not)))
        | join(", ") | gsub("impact *= *none"; "no impact") | gsub(" *<= *"; " ≤ ") | gsub(" *>= *"; " ≥ ")) as $owed
    | {title: $title, owed: $owed,
       owed_mps: (if $owed | test("no impact") then 0 else [$owed | capture("impact_mps ≤ (?<limit>[0-9.]+)").limit | tonumber][0] end)};

# --- runs -------------------------------------------------------------------------------------------

# About 120 moments of a run, and each at which a switch or a word changes.
def trace($columns): .series as $series | ($series.t_s // [] | length) as $count
    | if $count < 2 then null else
        [$columns[] | select($series[.source] | type == "array" and length == $count)] as $there
        | [$there[] | select(.is_switch) | $series[.source]] as $switches
        | ((($count - 1) / 120 | floor) + 1) as $step
        | [range($count) | . as $k | select($k == $count - 1 or $k % $step == 0 or any($switches[]; .[$k] != .[$k - 1]))] as $kept
        | {t: [$series.t_s[$kept[]] | rounded(3)]}
            + ([$there[] | . as $column | {key, value: [$series[.source][$kept[]] | if type == "number" then . * $column.factor + $column.offset else . end | rounded($column.digits)]}] | from_entries)
      end;

# Of a run that is not listed the page shows no more than the values.
def digest($columns; $keys; $listed): {who: (.image // ""), values: (.outcome | with_entries(select(.key as $key | $keys | index([$key])) | select(.value | type == "number") | .value |= rounded(4)))}
    + if $listed then {expect: [.expect[] | {text: .expected, value, met: .holds}], trace: trace($columns)} else {} end;

def file($name): $texts[0][$name] // "";
def run($task; $results; $listed): ($runs + "/" + $task.key) as $folder | (file($folder + "/exit") | trim) as $status
    | if $status != "0" and $status != "1" then
        {ok: false, error: (if $status == "" then "it did not run" else "exit status \($status): " + (file($folder + "/log") | trim | split("\n")[-1] // "") end)}
      else $results[$folder + "/result.json"] as $result
        | {ok: true, met: ($status == "0"), values: $result.values}
            + if $listed then {expect: $result.expect} + if $result.trace then {trace: $result.trace} else {} end else {} end
      end;

# Words become numbers; the column says which.
def number_words($columns; $runs): reduce $columns[] as $column ({runs: $runs, columns: []};
    if $column.is_word then
        ([.runs[].trace[$column.key]? // [] | .[] | select(. != null)] | unique) as $words
        | ($words | to_entries | map({key: .value, value: .key}) | from_entries) as $number
        | .columns += [$column + {words: $words}]
        | .runs |= map_values(if .trace[$column.key]? then .trace[$column.key] |= map(if . == null then . else $number[.] end) else . end)
    else .columns += [$column] end)
    | .columns |= map(del(.is_word, .is_switch));

# --- figures ----------------------------------------------------------------------------------------

def axis($table): quantity as $one | [$table[$one.source][] * $one.factor + $one.offset | (. * 1e6 | round) / 1e6];
# Some thirty values of an axis are enough for a surface.
def some: unique | (if length > 40 then 4 else 1 end) as $step | [.[range(0; length; $step)]];
def thinned: (.x | some) as $xs | (.y | some) as $ys
    | ([$xs[] | {key: tostring, value: true}] | from_entries) as $has_x | ([$ys[] | {key: tostring, value: true}] | from_entries) as $has_y
    | . as $all | [range(.x | length) | select($has_x[$all.x[.] | tostring] and $has_y[$all.y[.] | tostring])] as $kept
    | map_values([.[$kept[]]]);
def rows($figure; $image): ($figure.file | sub("^build/report"; $out) | gsub("{}"; $image)) as $name
    | $tables[0][$name] as $table
    | if $name == "" or $table == null then null else
        {x: ($figure.x | axis($table)), y: ($figure.y | axis($table)), value: ($figure.value | axis($table))}
        + (if $figure.kind == "rules" or $figure.kind == "diagram" then {also: ($figure.show | axis($table))} else {} end)
        | if $figure.kind == "surface" then thinned else . end
      end;
def figures($images; $ran): [entries("figure")[] | fields
    | {kind: .[0], title: .[1], caption: .[2], wide: (.[3] != "each"), file: (.[4] // ""), group: (.[5] // ""),
       x: (.[6] // ""), xLabel: (.[7] // ""), y: (.[8] // ""), yLabel: (.[9] // ""), value: (.[10] // ""), show: (.[11] // ""), inputs: (.[12] // "")}
    | . as $figure
    | .items = [if .wide then {images: [$images[].id], caption: ""} else $images[] | {images: [.id], caption: .name} end
        | . + {rows: rows($figure; .images[0])}
        | select($figure.file == "" or .rows)
        | select($figure.group == "" or any(.images[]; $ran[$figure.group + "/" + .]))]
    | select(.items != [])];

# --- published figures -------------------------------------------------------------------------------

def published: [entries("published")[] | fields | {name: .[0], unit: .[1], digits: (.[2] | digits), said: .[3], scenario: .[4], measure: .[5]}];

# --- drive it yourself ------------------------------------------------------------------------------

# A scenario's text as settings: "section.key=value" for each line of it.
def settings: reduce (split("\n")[] | trim | select(test("^([;#]|$)") | not)) as $line ({section: "", list: []};
    if $line | startswith("[") then .section = ($line | ltrimstr("[") | rtrimstr("]"))
    else .list += [.section + "." + ($line | sub(" *= *"; "="))] end) | .list;
def knobs: [entries("knob")[] | fields
    | {name: .[0], unit: .[1], setting: .[2], low: (.[3] | tonumber), high: (.[4] | tonumber), step: (.[5] | tonumber), value: (.[6] // "0" | tonumber)}];
def yourself: $chip[0] | if . == null then null else {board, hex, settings: (.scenario | settings), like: (first_of("yourself") | split("/")[-1] | rtrimstr(".scn")), knobs: knobs} end;

# --- the tab ----------------------------------------------------------------------------------------

columns as $columns | groups as $groups | built_images as $images
| [measures[].key, (tiles[].kind), (published[].measure)] as $keys
| [$tasks | split("\n")[] | split("\t") | select(.[0] == $id) | {image: .[1], scenario: .[2], key: .[3], file: .[5]}] as $mine
| ([$mine[] | select(.scenario | group_of($groups).listed) | {key: "\($runs)/\(.key)/result.json", value: true}] | from_entries) as $listed
| (reduce inputs as $result ({}; .[input_filename] = ($result | digest($columns; $keys; $listed[input_filename])))) as $results
| ([$mine[] | {key: .image, value: $results["\($runs)/\(.key)/result.json"].who} | select(.value)] | from_entries) as $who
| ([$mine[] | {key: "\(.image)/\(.scenario)", value: run(.; $results; .scenario | group_of($groups).listed)}] | from_entries) as $runs
| number_words($columns; $runs) as $numbered
| (reduce $mine[] as $task ({}; if has($task.scenario) then . else .[$task.scenario] = (file($task.file) | scenario($task.scenario)) end)) as $scenarios
| [$mine[].scenario] as $names | (reduce $names[] as $name ([]; if index([$name]) then . else . + [$name] end)) as $order
| ([$mine[] | {key: ((.scenario | group_of($groups).id) + "/" + .image), value: true}] | from_entries) as $ran
| ([images[] | select(.id as $image | $images | map(.id) | index([$image]) | not) | .name]) as $missing
| {id: $id, title: first_of("title"), first: first_of("first"),
   about: (entries("about") + if $missing != [] then ["Not run, so not here: \($missing | join(", "))."] else [] end),
   images: [$images[] | . + {who: ($who[.id] // "")}], columns: $numbered.columns, panels: panels, measures: measures, tiles: tiles,
   groups: [($groups + [{id: "", title: "Scenarios", listed: true}])[] | .id as $group
       | . + {scenarios: [$order[] | select(group_of($groups).id == $group)]} | select(.id != "" or .scenarios != [])],
   scenarios: $scenarios, figures: figures($images; $ran), scene: scene, published: published, yourself: yourself, runs: $numbered.runs}
