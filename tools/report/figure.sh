#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws one figure for the page: figure.sh OUT.svg SCRIPT.gp NAME=VALUE...
# gnuplot's SVG loses what a page does not need, and the colours that figure.gp names become the
# page's own. Nothing is left behind when gnuplot fails.
set -eu
out=$1 script=$2
shift 2
settings="out='$out.part'"
for setting in "$@"; do
    settings="$settings; ${setting%%=*}='${setting#*=}'"
done
trap 'rm -f "$out.part" "$out.clean" "$out.log"' EXIT
if ! gnuplot -e "$settings" "tools/report/$script" 2>"$out.log" || ! [ -s "$out.part" ]; then
    echo "figure.sh: error: $script made no $out: $(grep -v '^ *$' "$out.log" | tail -n 1)" >&2
    exit 1
fi
# The symbols that gnuplot defines are dropped where no point is drawn.
unused='s|<defs>.*</defs>||'
if sed '1,/<\/defs>/d' "$out.part" | grep -q '<use'; then unused=; fi
sed -E -z -e 's|^.*<svg[ \n]+width="[0-9]+" height="[0-9]+"|<svg|' -e "$unused" \
    -e 's/ id="gnuplot_[^"]*"//g; s|<title>[^<]*</title>||g; s|<desc>[^<]*</desc>||g' \
    -e 's/ stroke-linecap="butt"| stroke-linejoin="miter"| color="[a-z]+"| class="gridline"| stroke-width="1.00"//g' \
    -e 's|<tspan font-family="sans" >([^<]*)</tspan>|\1|g; s/ font-family="sans"//g' -e 's/[ \t]+/ /g; s/ ?\n ?/\n/g' \
    -e ':empty; s|<g[^>]*>\n*</g>||g; t empty' -e 's/\n+/\n/g' \
    -e "s/rgb\( *0, *0, *([1-5])\)/var(--c\1)/g" \
    -e 's/rgb\( *0, *0, *16\)/var(--ink)/g; s/rgb\( *0, *0, *17\)/var(--soft)/g; s/rgb\( *0, *0, *18\)/var(--grid)/g' \
    -e 's/rgb\( *0, *0, *32\)/var(--m0)/g; s/rgb\( *0, *0, *33\)/var(--m1)/g; s/rgb\( *0, *0, *34\)/var(--m2)/g' \
    -e 's/rgb\( *0, *0, *35\)/var(--m3)/g; s/rgb\( *0, *0, *36\)/var(--m4)/g' \
    "$out.part" | awk -v RS="'" -f tools/report/thin.awk >"$out.clean"
mv "$out.clean" "$out"
