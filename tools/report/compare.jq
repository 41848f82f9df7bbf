# SPDX-License-Identifier: MIT
# Whether the drives of the sample come out alike in both engines: {said, differ}.
#     jq -n -f compare.jq --rawfile sample SAMPLE --arg runs FOLDER RESULT.json...
# SAMPLE has a line a drive: tab, image, scenario, key, ...; the key ends in -s51, the same drive's in the
# other engine in -fast. The results are drive's: FOLDER/KEY/result.json.
# Alike means: the same outcomes hold, an impact or none, and the same states reported. A line with a state takes the
# serial port up to 40 ms. An impact ends the drive, so the last line may be whole in one engine and lack a character
# in the other: there one may report one state more than the other.
def judged: {holds: [.expect[] | select(.holds) | .expected], impact: .outcome.impact, reached: .outcome.reached};
def states: .reached | split(" ");
def alike($a; $b): ($a | del(.reached)) == ($b | del(.reached))
    and ($a.reached == $b.reached or ($a.impact != "none" and (($a | states) - ($b | states) + (($b | states) - ($a | states)) | length) == 1));
def sizes: .outcome | {impact_mps, min_gap_m} | map_values(if type == "number" then . else null end);
def furthest($pairs; $key): [$pairs[] | select(.[0][$key] != null and .[1][$key] != null) | .[0][$key] - .[1][$key] | fabs] | max // 0;

(reduce inputs as $result ({}; .[input_filename] = ($result | {judged: judged, sizes: sizes}))) as $results
| [$sample | split("\n")[] | select(. != "") | split("\t")
    | {name: "\(.[1])/\(.[2])", s51: $results["\($runs)/\(.[3])/result.json"], fast: $results["\($runs)/\(.[3] | sub("-s51$"; "-fast"))/result.json"]}] as $drives
| [$drives[] | select(.s51 and .fast)] as $both
| [$both[] | select(alike(.s51.judged; .fast.judged) | not) | "\(.name): s51 \(.s51.judged | tojson), fast \(.fast.judged | tojson)"] as $differ
| [$both[] | [.s51.sizes, .fast.sizes]] as $pairs
| {differ: $differ,
   said: ("Of these, \($both | length) drawn at random were driven in s51, too: "
          + (if $differ == [] then "all agree" else "\($differ | length) disagree" end)
          + " in the outcomes that hold, impact and states reported; smallest gaps differ by at most \(furthest($pairs; "min_gap_m") * 1000 | round) mm, impact speeds by \(furthest($pairs; "impact_mps") * 100 | round / 100) m/s.")}
