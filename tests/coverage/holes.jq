# SPDX-License-Identifier: MIT
# Adds up what gcov found in all programs (its JSON, one document a program part) for the files under
# firmware/: {files: [{file, lines, lines_reached, branches, branches_reached, holes: [...]}]}. A line is
# reached if one program reached it; a branch, which is one way to go on from a line, likewise.
[.[].files[] | (.file |= sub("^.*[.][.]/"; "")) | select(.file | startswith("firmware/")) | .file as $file | .lines[]
    | {file: $file, line: .line_number, count, branches: [.branches[] | .count]}]
| group_by([.file, .line])
| map({file: .[0].file, line: .[0].line, reached: (map(.count) | add > 0),
       # The same line with other settings may have other branches.
       branches: (map(.branches) | group_by(length) | map(transpose | map(add > 0)) | add)})
| group_by(.file)
| map({file: .[0].file, lines: length, lines_reached: (map(select(.reached)) | length),
       branches: (map(.branches | length) | add), branches_reached: ([.[].branches[] | select(.)] | length),
       holes: [.[] | select((.reached | not) or (.branches | all | not)) | {line, reached, branches}]})
| {files: .}
