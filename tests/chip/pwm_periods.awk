# SPDX-License-Identifier: MIT
# Judges a PWM by its pin's edges, period by period:
#     awk -v clk_hz=12000000 -f pwm_periods.awk ASKED EDGES
# ASKED and EDGES are what s51_edges says of the byte that hal_brake_set was told last (written right
# after it) and of the pin, from high at 100 % on. Prints, in machine cycles but for `late_us`:
#     periods N      seen in all, on a grid that begins with the first rise
#     duties N       different ones, of those asked before the period began
#     wrong N        periods that are no duty asked in time for them, and not one pulse from their start
#     error_mc X     the pulse, at most so far from its share of the period; of the right ones
#     drift_mc X     rises, at most so far from the grid
#     late_us X      from hal_brake_set to the start of the first period with its duty, at most
# and of each wrong period a line on stderr. A duty told less than 140 cycles before a period may or may not
# count for it.
BEGIN {
    period = clk_hz / 1200
    tolerance = period / 1000 # 0.1 %
    margin = 140
    per_us = clk_hz / 12e6
    level = 1
    first_rise = -1
    asked_count = 1
    asked_at[0] = -1e9
    asked[0] = 100
}
function number(bits,    i, n) {
    n = 0
    for (i = 1; i <= length(bits); i++) n = 2 * n + substr(bits, i, 1)
    return n
}
function distance(x) { return x < 0 ? -x : x }

# The index of the duty asked that this period is: the last one in time, or one that came just before.
function who(start, high,    i, last) {
    for (last = asked_from; last + 1 < asked_count && asked_at[last + 1] <= start - margin; last++) {
    }
    asked_from = last
    for (i = last; i < asked_count && asked_at[i] <= start; i++) {
        if (distance(high - asked[i] * period / 100) <= (asked[i] % 100 == 0 ? 0 : tolerance)) return i
    }
    return -1
}

# One period: `edges` since it began; `start_level`, and how long the first pulse was.
function judge(start,    i, high, fault, at, rise) {
    rise = start
    at = 0
    high = 0
    for (i = edge_from; i < edge_count && edge_at[i] <= start + period - tolerance; i++) {
        if (edge_at[i] <= start + tolerance) {
            at++
            if (edge[i] == 1) {
                rise = edge_at[i]
                if (distance(rise - start) > drift) drift = distance(rise - start)
            }
        } else if (edge[i] == 1 || falls++) {
            fault = 1
        } else {
            high = edge_at[i] - rise
        }
        level = edge[i]
    }
    edge_from = i
    falls = 0
    if (high == 0 && level == 1) high = period
    i = at > 1 || fault ? -1 : who(start, high)
    periods++
    if (i < 0) {
        wrong++
        printf "pwm: period %d at %.3f us: high for %.1f cycles, %d edges at its start; asked: %d %%\n",
            periods, start / per_us, high, at, asked[asked_from] | "cat >&2"
        return
    }
    duties[asked[i]]++
    if (distance(high - asked[i] * period / 100) > error) error = distance(high - asked[i] * period / 100)
    if (i != before && i > 0 && (start - asked_at[i]) / per_us > late) late = (start - asked_at[i]) / per_us
    before = i
}
NR == FNR {
    asked_at[asked_count] = $1 * per_us
    asked[asked_count++] = number($2)
    next
}
$2 != level {
    level = $2
    edge_at[edge_count] = $1 * per_us
    edge[edge_count++] = level
    if (level == 1 && first_rise < 0) {
        first_rise = $1 * per_us
        edge_from = edge_count - 1
    }
}
END {
    level = 0
    if (first_rise < 0) {
        print "pwm: the pin never rises" | "cat >&2"
        exit 1
    }
    for (start = first_rise; start + period < edge_at[edge_count - 1]; start += period) judge(start)
    for (i in duties) count++
    printf "periods %d duties %d wrong %d error_mc %.1f drift_mc %.1f late_us %.0f\n",
        periods, count, wrong, error, drift, late
}
