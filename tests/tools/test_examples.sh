#!/bin/bash
# SPDX-License-Identifier: MIT
# firmware/examples: each builds by `make` in its own folder, and its image, run in s51, answers the values
# at its ports with what fistab says.
. tests/lib.sh
cpu_seconds=60

for example in firmware/examples/*/; do
    name=$(basename "$example")
    rm -rf "build/examples/$name"
    check "make in $example" make -C "$example"
    [ -s "build/examples/$name/$name.hex" ]
    say "$name.hex is there" $? "no build/examples/$name/$name.hex"
done

# Reads lines "PORT VALUE PORT VALUE ..." and prints P2 as the image answers each.
answers() { # IMAGE STEPS: so many instructions are enough for an answer
    {
        echo "step 5000" # the start
        awk -v steps="$2" '{
            for (i = 1; i < NF; i += 2) print "set hw port[" $i "] " $(i + 1)
            print "step " steps
            print "dump sfr 0xa0 0xa0"
        } END { print "quit" }'
    } >"$out/console"
    timeout $((cpu_seconds * 20)) prlimit --cpu=$cpu_seconds tools/s51 -t C52 -q -b "$1" <"$out/console" 2>&1 |
        LC_ALL=C sed -nE 's/.*P2: +0b[01]{8} 0x([0-9a-f]{2}) .*/\1/p' | while read -r hex; do echo $((16#$hex)); done
}

# --- dimmer: every byte of the sensor -----------------------------------------------------------------
seq 0 255 >"$out/light"
build/fistab eval firmware/examples/dimmer/dimmer.fis <"$out/light" | awk '{ printf "%d\n", $1 + 0.5 }' >"$out/wanted"
sed 's/^/1 /' "$out/light" | answers build/examples/dimmer/dimmer.ihx 300 >"$out/got"
[ "$(wc -l <"$out/got")" -eq 256 ]
say "the dimmer answers each byte" $? "$(wc -l <"$out/got") answers"
faultless "the dimmer answers as fistab does" "$(paste "$out/light" "$out/wanted" "$out/got" | awk '$2 != $3 { print "light " $1 ": " $3 ", not " $2 }')"

# --- fan: at the nodes as fistab; between them at most two below the plane through the four nodes, never
# above; beyond the ends as at the end (the last reading that counts is the one before the last node) ----
seq 10 4 42 >"$out/temps"
seq 20 8 84 >"$out/humidities"
awk 'FNR == NR { t[n++] = $1; next } { h[m++] = $1 } END { for (i = 0; i < n; i++) for (j = 0; j < m; j++) print t[i], h[j] }' \
    "$out/temps" "$out/humidities" >"$out/points"
build/fistab eval firmware/examples/fan/fan.fis <"$out/points" >"$out/speeds"
paste -d " " "$out/points" "$out/speeds" >"$out/nodes"
awk 'BEGIN { for (t = 0; t <= 100; t += 3) for (h = 0; h <= 100; h += 7) print 0, t, 1, h; for (t = 20; t < 84; t += 8) for (h = 20; h < 84; h += 8) print 0, t, 1, h }' >"$out/feed"
answers build/examples/fan/fan.ihx 2000 <"$out/feed" >"$out/fan_got"
[ "$(wc -l <"$out/fan_got")" -eq "$(wc -l <"$out/feed")" ]
say "the fan answers each pair" $? "$(wc -l <"$out/fan_got") answers"
awk '
    function clamped(x, low, high) { return x < low ? low : x > high ? high : x }
    FNR == NR { node[($1 - 10) / 4, ($2 - 20) / 8] = int($3 + 0.5); next }
    {
        t = (clamped($2, 20, 83) - 20) / 8; h = (clamped($4, 20, 83) - 20) / 8
        i = int(t); j = int(h)
        near = node[i, j] + (node[i, j + 1] - node[i, j]) * (h - j)
        far = node[i + 1, j] + (node[i + 1, j + 1] - node[i + 1, j]) * (h - j)
        plane = near + (far - near) * (t - i)
        is_node = t == i && h == j
        nodes += is_node
        if (is_node ? $5 != plane : $5 > plane || $5 < plane - 2)
            print "at " $2 / 2 " degrees, " $4 " %: " $5 ", where the plane is at " plane
    }
    END { if (nodes < 64) print "only " nodes + 0 " nodes" }' "$out/nodes" <(paste -d ' ' "$out/feed" "$out/fan_got") >"$out/fan_faults"
faultless "the fan answers as fistab does" "$(cat "$out/fan_faults")"
finish
