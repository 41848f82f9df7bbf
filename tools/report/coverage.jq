# SPDX-License-Identifier: MIT
# What of the firmware the tests reach, for the page: {coverage: [sheet...]}, from what the suites of tests/coverage left,
# $host and $chip: arrays of one document, or empty. $host_at and $chip_at say when that was.
def share($reached; $all): if $all == 0 then "–" else "\($reached) of \($all)" end;
def percent($reached; $all): "\(1000 * $reached / $all | floor / 10) %";
def file: .file | ltrimstr("firmware/");
def sum($key): map(.[$key]) | add;
def missing($title): {title: $title, caption: "Not measured here yet: make test measures it, and then make report shows it.", head: [], rows: []};
{coverage: [
    if $host == [] then missing("On the host") else $host[0].files | {
        title: "On the host",
        caption: "Lines and branches of the firmware that the unit tests reach, as make test found on \($host_at). Each that is not reached has its reason in the source, after “unreached:”. These are all files but firmware/mcu and the main loops.",
        head: ["file", "lines", "branches"],
        rows: (map([file, share(.lines_reached; .lines), share(.branches_reached; .branches)])
            + [["all", share(sum("lines_reached"); sum("lines")), share(sum("branches_reached"); sum("branches"))],
               ["", percent(sum("lines_reached"); sum("lines")), percent(sum("branches_reached"); sum("branches"))]])
    } end,
    if $chip == [] then missing("On the chip") else $chip[0] | {
        title: "On the chip",
        caption: "Instructions of firmware/mcu and of the main loops that drives run in the simulator, on \(.boards | join(", ")), as make test found on \($chip_at). The source says why no drive can run the others, after “unreached:”.",
        head: ["file", "instructions", "unreached"],
        rows: (.files | map([file, share(.run; .instructions), .explained])
            + [["all", share(sum("run"); sum("instructions")), sum("explained")], ["", percent(sum("run"); sum("instructions")), ""]])
    } end]}
