#!/bin/bash
# SPDX-License-Identifier: MIT
# What stray, missing and coarse readings do to the brake, in thousands of drives in the laboratory: no more than
# docs/brake.md states. And the first drives of `make attack`. ATTACK_RUNS, which `make test-long` sets: so many of
# those, and all of `lab trouble`; else a fifth.
. tests/lib.sh
make lab-images build/lab >"$out/make.log" 2>&1 || say "the laboratory builds" 1 "$(tail -n 3 "$out/make.log")"
# How many contacts with 10, 20 and 30 % missing under the published table, and hangs not found, those drives have.
if [ -n "${ATTACK_RUNS:-}" ]; then
    share=() contacts=0,4,24 hangs=5
else
    share=(--runs 100) contacts=0,3,9 hangs=1
fi
build/lab trouble "${share[@]}" build/lab-images/{first,brake,tuned}.so >"$out/figures"

# IMAGE SAFE_MPS LIMITS: what is over its limit. Up to SAFE_MPS no stray reading leads to an impact. Above,
# one before first sight leads to no more than without it, or than full braking at first sight has where
# that reading is missing: one measurement hears one echo, so the car's own is lost.
too_much() {
    awk -v image="build/lab-images/$1.so" -v safe="$2" -v missing="$3" -v hangs=$hangs '
    /^build/ { here = $1 == image; is_first = /first/; next }
    function most(what, value, limit) { n++; if (value > limit) print what ": " value " of at most " limit }
    is_first && /a stray reading/ { least[$1] = $NF }
    !here { next }
    /a stray reading/ {
        if ($1 + 0 < safe + 0.05) { most($1 " m/s, a stray before first sight", $11, 0); most($1 " m/s, a stray later", $15 + 0, 0) }
        else if (image ~ /tuned/) most($1 " m/s, a stray before first sight", $11, $6 > least[$1] ? $6 : least[$1])
    }
    /missing:/ { split(missing, limit, ","); most($1 " % missing", $4, limit[++shares]) }
    /end in FAULT/ { most($3 " mm, noise " $6 " cm: stops that end in FAULT", $8, 0); most($3 " mm, noise " $6 " cm: hangs not found", $(NF - 2), hangs) }
    END { if (n < 21) print n " figures" }' "$out/figures"
}
faultless "strays, missing and coarse readings under the published table" "$(too_much brake 5.5 $contacts)"
faultless "strays, missing and coarse readings under the tuned table" "$(too_much tuned 6.3 0,0,0)"

# The first drives of `make attack`: no more of them are flagged than docs/brake.md says of all.
runs=${ATTACK_RUNS:-2000}
build/lab attack --runs "$runs" build/lab-images/first.so build/lab-images/{brake,tuned,classic}.so >"$out/attack"
for law in brake tuned classic; do
    flagged=$(awk -v image="build/lab-images/$law.so" '/^build/ { here = $1 == image } here && /drives flagged/ { print $1 }' "$out/attack")
    known=$(awk -F ' *[|] *' -v law="$law" '/^[|] flagged drives/ { for (i = 3; i <= NF; i++) if ($i ~ (law == "brake" ? "published" : law)) column = i }
        column && $2 == "all" { print $column; exit }' docs/brake.md)
    [ "$flagged" -le "$known" ]
    say "$runs drives of chance, $law" $? "$flagged are flagged; docs/brake.md knows $known of 10,000"
done
finish
