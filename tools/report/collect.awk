# SPDX-License-Identifier: MIT
# From run results to what the page shows, for one tab. Variables: tab (its description), id, runs
# (folder of results), work (folder to write to), built (images that exist). Input: the tasks, lines
# of tab, image, scenario, key, hex, scenario file. Writes the tab's data as JSON to stdout, and to
# WORK: ID.values (numbers for figures), ID.figures (figures to draw), traces/ (thinned CSV).

function trim(text) { gsub(/^[ \t\r\n]+|[ \t\r\n]+$/, "", text); return text }
function quote(text) {
    gsub(/\\/, "\\\\", text); gsub(/"/, "\\\"", text); gsub(/</, "\\u003c", text)
    gsub(/[\t\r\n]/, " ", text); gsub(/[\001-\037]/, "", text)
    return "\"" text "\""
}
# A number with so many digits, no longer than needed.
function plain(value, digits,    text) {
    text = sprintf("%." digits "f", value)
    if (text ~ /\./) { sub(/0+$/, "", text); sub(/\.$/, "", text) }
    return text == "-0" ? "0" : text
}
function parts(value, list,    count, k) {
    count = split(value, list, "|")
    for (k = 1; k <= count; k++) list[k] = trim(list[k])
    for (; k <= 8; k++) list[k] = ""
    return count
}
function text_of(file,    line, text) {
    text = ""
    while ((getline line <file) > 0) text = text line "\n"
    close(file)
    return text
}

# The description.
function read_tab(    line, name, value, at) {
    while ((getline line <tab) > 0) {
        if (line ~ /^[ \t]*(#|$)/) continue
        at = index(line, "=")
        name = trim(substr(line, 1, at - 1)); value = trim(substr(line, at + 1))
        entry[name, ++entries[name]] = value
    }
    close(tab)
}
function first_of(name) { return entries[name] ? entry[name, 1] : "" }

# A line of the shell that draws a figure. MORE is quoted already.
function word(text) { gsub(/'/, "'\\''", text); return " '" text "'" }
function draw(figure, script, first, second, more) {
    print "tools/report/figure.sh" word(work "/figures/" figure ".svg") word(script) word(first) word(second) more >figures
}

# --- one run ------------------------------------------------------------------------------------------

# The value of a key in the run's result; "" when it has none. All of drive's keys are distinct.
function result_value(text, key,    at, rest) {
    at = index(text, "\"" key "\"")
    if (!at) return ""
    rest = substr(text, at + length(key) + 2, 60)
    if (!match(rest, /^[ \t]*:[ \t]*-?[0-9][0-9.eE+-]*/)) return ""
    rest = substr(rest, 1, RLENGTH)
    sub(/^[ \t]*:[ \t]*/, "", rest)
    return rest
}

# One series of the run's result, as a list. Returns its length.
function series(text, key, list,    at, rest, from) {
    at = index(text, "\"" key "\"")
    if (!at) return 0
    rest = substr(text, at)
    from = index(rest, "[")
    return split(substr(rest, from + 1, index(rest, "]") - from - 1), list, ",")
}

# What a figure's axis must reach, and the distance of its tics: four or so, at round numbers.
function note_range(key, value) {
    if (!(key in least_value) || value < least_value[key]) least_value[key] = value
    if (!(key in most_value) || value > most_value[key]) most_value[key] = value
}
function tic_step(low, high,    power, part) {
    if (high <= low) return 1
    power = 10 ^ int(log((high - low) / 4) / log(10) + 100 - 1e-9) / 10 ^ 100
    part = (high - low) / 4 / power
    return power * (part <= 1.01 ? 1 : part <= 2.01 ? 2 : part <= 5.01 ? 5 : 10)
}

# Thins a run's series to about `rows` moments, keeping each change of a word or a switch and the last moment.
# Returns them as JSON, and writes them as CSV for gnuplot.
function trace(text, name, scenario, rows,    at, out, count, step, k, c, list, kept, json, value, have, head, keep, cells) {
    at = index(text, "\"series\"")
    if (!at) return ""
    text = substr(text, at)
    count = series(text, "t_s", list)
    if (count < 2) return ""
    step = int((count - 1) / rows) + 1
    for (k = 1; k <= count; k++) { cells[0, k] = list[k]; keep[k] = k == 1 || k == count || (k - 1) % step == 0 }
    head = "t_s"
    for (c = 1; c <= columns; c++) {
        have[c] = series(text, column[c], list) == count
        if (!have[c]) continue
        head = head "," column[c]
        for (k = 1; k <= count; k++) {
            cells[c, k] = trim(list[k])
            if (is_switch[c] && k > 1 && cells[c, k] != cells[c, k - 1]) keep[k] = 1
        }
    }
    out = work "/traces/" name ".csv"
    print head >out
    for (c = 0; c <= columns; c++) json_of[c] = ""
    kept = 0
    for (k = 1; k <= count; k++) {
        if (!keep[k]) continue
        kept++
        json_of[0] = json_of[0] (kept > 1 ? "," : "") plain(cells[0, k], 3)
        printf "%s", cells[0, k] >out
        for (c = 1; c <= columns; c++) {
            if (!have[c]) continue
            value = cells[c, k]
            printf ",%s", value == "null" ? "" : value >out
            if (kind_of[c] == "words") {
                if (!((c, value) in word_number)) { word_number[c, value] = word_count[c]++; word_list[c] = word_list[c] (word_count[c] > 1 ? "," : "") value }
                value = word_number[c, value]
            } else if (value != "null") {
                value = plain(value, digits_of[c])
                note_range(scenario SUBSEP column[c], value + 0)
            }
            json_of[c] = json_of[c] (kept > 1 ? "," : "") value
        }
        print "" >out
    }
    close(out)
    json = "{\"t\":[" json_of[0] "]"
    for (c = 1; c <= columns; c++)
        if (have[c]) json = json "," quote(column[c]) ":[" json_of[c] "]"
    return json "}"
}

# What was stated, what it came to.
function outcomes(text,    json, at, rest, list, count, k, item) {
    json = ""
    at = index(text, "\"expect\"")
    if (!at) return ""
    text = substr(text, at)
    if (at = index(text, "\"series\"")) text = substr(text, 1, at - 1)
    count = split(text, list, "{")
    for (k = 2; k <= count; k++) {
        item = list[k]
        json = json (json == "" ? "" : ",") "{\"text\":" string_value(item, "expected") ",\"value\":" string_value(item, "value") ",\"met\":" (item ~ /"holds"[ \t]*:[ \t]*true/ ? "true" : "false") "}"
    }
    return json
}
function string_value(text, key,    at, rest) {
    at = index(text, "\"" key "\"")
    if (!at) return "\"\""
    rest = substr(text, at + length(key) + 2)
    if (!match(rest, /"([^"\\]|\\.)*"/)) return "\"\""
    rest = substr(rest, RSTART, RLENGTH)
    gsub(/</, "\\u003c", rest)
    return rest
}

# The runs are the first member of the tab's object.
function say(json) { printf "%s%s", said++ ? ",\n" : "{\"runs\":{", json }

# --- the scenario ----------------------------------------------------------------------------------------

# Its title, and its stated outcome as words.
function read_scenario(name, file,    line, in_expect, text) {
    text = ""
    while ((getline line <file) > 0) {
        if (line ~ /^title[ \t]*=/) { title_of[name] = trim(substr(line, index(line, "=") + 1)) }
        if (line ~ /^\[/) in_expect = line ~ /^\[expect\]/
        else if (in_expect && line ~ /=/ && line !~ /^[ \t]*[;#]/ && line !~ /^impact *= *any/) text = text (text == "" ? "" : ", ") trim(line)
    }
    close(file)
    if (title_of[name] == "") title_of[name] = name
    gsub(/impact *= *none/, "no impact", text)
    gsub(/ *<= */, " ≤ ", text); gsub(/ *>= */, " ≥ ", text)
    owed_text[name] = text
    owed_mps[name] = text ~ /no impact/ ? 0 : -1
    if (match(text, /impact_mps ≤ [0-9.]+/)) { line = substr(text, RSTART, RLENGTH); sub(/.* /, "", line); owed_mps[name] = line }
}

function group_of(name,    k, others) {
    for (k = 1; k <= groups; k++) {
        if (index(name, group[k] "_") == 1 || name == group[k]) return k
        if (group[k] == "*") others = k
    }
    return others + 0
}

BEGIN {
    FS = OFS = "\t"
    read_tab()
    columns = entries["column"]
    for (k = 1; k <= columns; k++) { parts(entry["column", k], part); column[k] = part[1]; digits_of[k] = part[4] + 0; kind_of[k] = part[5]; word_count[k] = 0; is_switch[k] = part[5] == "words" || part[6] == "hidden" }
    groups = entries["group"]
    for (k = 1; k <= groups; k++) { parts(entry["group", k], part); group[k] = part[1]; group_title[k] = part[2]; listed[k] = part[3] != "figure" }
    measures = entries["measure"]
    for (k = 1; k <= measures; k++) { parts(entry["measure", k], part); measure[k] = part[1]; measured[part[1]] = 1 }
    for (k = 1; k <= entries["tile"]; k++) { parts(entry["tile", k], part); if (part[4] !~ /^(met|impacts|limit)$/ && !(part[4] in measured)) { measure[++measures] = part[4]; measured[part[4]] = 1 } }
    images = 0
    for (k = 1; k <= entries["image"]; k++) {
        parts(entry["image", k], part)
        if (index(" " built " ", " " part[1] " ")) { image[++images] = part[1]; image_name[images] = part[2]; image_short[images] = part[3] == "" ? part[2] : part[3]; colour[images] = (k - 1) % 5 + 1 }
        else missing = missing (missing == "" ? "" : ", ") part[2]
    }
    values = work "/" id ".values"
    printf "image\tscenario\tgroup\tok\tmet\towed_mps" >values
    for (k = 1; k <= measures; k++) printf "\t%s", measure[k] >values
    print "" >values
}

$1 == id {
    name = $3
    folder = runs "/" $4
    if (!(name in title_of)) { read_scenario(name, $6); order[++scenarios] = name }
    g = group_of(name)
    status = trim(text_of(folder "/exit"))
    ok = status == "0" || status == "1"
    run_json = quote($2 "/" name) ":{\"ok\":" (ok ? "true" : "false")
    printf "%s\t%s\t%s\t%d\t%d\t%s", $2, name, g ? group[g] : "", ok, status == "0", owed_mps[name] >values
    if (!ok) {
        error = trim(text_of(folder "/log"))
        sub(/.*\n/, "", error)
        run_json = run_json ",\"error\":" quote(status == "" ? "it did not run" : "exit status " status ": " error) "}"
        for (k = 1; k <= measures; k++) printf "\t" >values
        print "" >values
        say(run_json)
        next
    }
    if (g) ran[group[g], $2]++
    result = text_of(folder "/result.json")
    run_json = run_json ",\"met\":" (status == "0" ? "true" : "false") ",\"values\":{"
    comma = ""
    for (k = 1; k <= measures; k++) {
        value = result_value(result, measure[k])
        printf "\t%s", value >values
        if (value != "") { run_json = run_json comma quote(measure[k]) ":" plain(value, 4); comma = "," }
    }
    print "" >values
    run_json = run_json "}"
    if (!g || listed[g]) {
        run_json = run_json ",\"expect\":[" outcomes(result) "]"
        thin = trace(result, id "." $2 "." name, name, 120)
        if (thin != "") { run_json = run_json ",\"trace\":" thin; traced[name] = traced[name] " " $2 }
    }
    say(run_json "}")
}

# --- the tab ---------------------------------------------------------------------------------------------

function add(list, item) { return list == "" ? item : list ",\n" item }
function pair(name, value) { return quote(name) ":" quote(value) }
function flag(name, value) { return quote(name) ":" (value ? "true" : "false") }

function columns_json(    list, k) {
    for (k = 1; k <= columns; k++) {
        parts(entry["column", k], part)
        list = add(list, "{" pair("key", part[1]) "," pair("name", part[2]) "," pair("unit", part[3]) \
            ",\"digits\":" part[4] + 0 "," flag("steps", part[5] == "steps") "," flag("shown", part[6] == "shown") \
            (kind_of[k] == "words" ? ",\"words\":[" word_list[k] "]" : "") "}")
    }
    return list
}

function measures_json(    list, k) {
    for (k = 1; k <= entries["measure"]; k++) {
        parts(entry["measure", k], part)
        list = add(list, "{" pair("key", part[1]) "," pair("name", part[2]) "," pair("unit", part[3]) ",\"digits\":" part[4] + 0 "}")
    }
    return list
}

function tiles_json(    list, k) {
    for (k = 1; k <= entries["tile"]; k++) {
        parts(entry["tile", k], part)
        list = add(list, "{" pair("name", part[1]) "," pair("unit", part[2]) ",\"digits\":" part[3] + 0 "," \
            pair("kind", part[4]) "," pair("argument", part[5]) "}")
    }
    return list
}

function groups_json(    list, members, g, s) {
    for (g = 0; g <= groups; g++) {
        members = ""
        for (s = 1; s <= scenarios; s++) if (group_of(order[s]) == g) members = add(members, quote(order[s]))
        if (g == 0 && members == "") continue
        list = add(list, "{" pair("id", g ? group[g] : "") "," pair("title", g ? group_title[g] : "Scenarios") "," \
            flag("listed", !g || listed[g]) ",\"scenarios\":[" members "]}")
    }
    return list
}

# The trace figures: one a scenario, of all controllers that ran it.
function draw_traces(    k, s, panels, labels, names, references, lows, highs, steps, key, files, colours) {
    for (k = 1; k <= entries["panel"]; k++) {
        parts(entry["panel", k], part)
        labels = labels " \"" part[1] "\""
        names = names " " part[2]
        shown[k] = part[2]; low_of[k] = part[4]; high_of[k] = part[5]
        references = references " " (part[3] == "" ? "-" : part[3])
        lows = lows " " (part[4] == "" ? "*" : part[4])
        highs = highs " " (part[5] == "" ? "*" : part[5])
    }
    panels = word("columns=" names) word("labels=" labels) word("references=" references) word("lows=" lows) word("highs=" highs)
    for (s = 1; s <= scenarios; s++) {
        if (traced[order[s]] == "") continue
        files = colours = steps = ""
        for (k = 1; k <= images; k++) {
            if (!index(traced[order[s]] " ", " " image[k] " ")) continue
            files = files " " work "/traces/" id "." image[k] "." order[s] ".csv"
            colours = colours " " colour[k]
        }
        for (k = 1; k <= entries["panel"]; k++) {
            key = order[s] SUBSEP shown[k]
            steps = steps " " tic_step(low_of[k] == "" ? least_value[key] : low_of[k], high_of[k] == "" ? most_value[key] : high_of[k])
        }
        draw(id "-trace-" order[s], "trace.gp", "files=" substr(files, 2), "colours=" substr(colours, 2), panels word("steps=" steps))
    }
}

function exists(file,    line, found) {
    found = (getline line <file) > 0
    close(file)
    return found
}

# The other figures: described, and drawn where their data is there. In a data file's name, {} stands
# for the image.
function figures_json(    list, items, k, c, name, all, names, colours, file) {
    for (c = 1; c <= images; c++) { all = all " " image[c]; names = names " \"" image_short[c] "\""; colours = colours " " colour[c] }
    for (k = 1; k <= entries["figure"]; k++) {
        parts(entry["figure", k], part)
        name = part[1]; sub(/\.gp$/, "", name)
        items = ""
        for (c = 1; c <= (part[4] == "each" ? images : 1); c++) {
            if (part[6] != "" && !ran[part[6], part[4] == "each" ? image[c] : image[1]]) continue
            file = part[5]
            sub(/^build\/report/, out, file)
            gsub(/\{\}/, image[c], file)
            if (file != "" && !exists(file)) continue
            if (part[4] == "each") {
                items = add(items, "{" pair("id", id "-" name "-" image[c]) "," pair("caption", image_name[c]) "}")
                draw(id "-" name "-" image[c], part[1], "values=" values, "colours=" colour[c], word("image=" image[c]) word("data=" file))
            } else {
                items = add(items, "{" pair("id", id "-" name) "," pair("caption", "") "}")
                draw(id "-" name, part[1], "values=" values, "colours=" substr(colours, 2), word("image=" substr(all, 2)) word("names=" substr(names, 2)) word("data=" file))
            }
        }
        if (items != "")
            list = add(list, "{" pair("title", part[2]) "," pair("caption", part[3]) "," flag("wide", part[4] != "each") ",\"items\":[" items "]}")
    }
    return list
}

function scene_json(    list, count, k, setting) {
    count = parts(first_of("scene"), part)
    list = pair("name", part[1])
    for (k = 2; k <= count; k++) {
        split(part[k], setting, " ")
        list = list "," quote(setting[1]) ":" (setting[2] ~ /^-?[0-9.]+$/ ? setting[2] : quote(setting[2]))
    }
    return list
}

END {
    close(values)
    figures = work "/" id ".figures"
    printf "" >figures
    draw_traces()
    about = image_list = scenario_list = ""
    for (k = 1; k <= entries["about"]; k++) about = add(about, quote(entry["about", k]))
    if (missing != "") about = add(about, quote("Not run, so not here: " missing "."))
    for (k = 1; k <= images; k++)
        image_list = add(image_list, "{" pair("id", image[k]) "," pair("name", image_name[k]) "," pair("short", image_short[k]) ",\"colour\":" colour[k] "}")
    for (s = 1; s <= scenarios; s++)
        scenario_list = add(scenario_list, quote(order[s]) ":{" pair("title", title_of[order[s]]) "," pair("owed", owed_text[order[s]]) "}")
    print (said ? "" : "{\"runs\":{") "},"
    print pair("id", id) "," pair("title", first_of("title")) "," pair("first", first_of("first")) ","
    print "\"about\":[" about "],"
    print "\"images\":[" image_list "],"
    print "\"columns\":[" columns_json() "],"
    print "\"measures\":[" measures_json() "],"
    print "\"tiles\":[" tiles_json() "],"
    print "\"groups\":[" groups_json() "],"
    print "\"scenarios\":{" scenario_list "},"
    print "\"figures\":[" figures_json() "],"
    print "\"scene\":{" scene_json() "}}"
    close(figures)
}
