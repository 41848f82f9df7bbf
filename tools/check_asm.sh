#!/bin/sh
# SPDX-License-Identifier: MIT
# Refuses what SDCC 4.2.0 compiles without a word and what the chip then does wrong:
#     tools/check_asm.sh FILE.asm...        all of one program, compiled with --i-code-in-asm
# Interrupts: one must call nothing (it would share the callee's fixed parameters and locals with main),
# must not touch an overlay segment (whose bytes belong to whatever main was running), and needs its
# vector (SDCC sets it only if main's file sees the prototype; else it links, and never runs). What the
# program calls is no interrupt, even if it ends with reti.
# Stores: `lamp.is_on = n == 2;` stores nothing where the right side is a bare ==, < or > and the left
# side is a bool in near memory reached through an address: a struct's member, an array's element. The
# result stays in the carry; SDCC's intermediate code shows it as a bit that has no place. (Fine are
# plain variables, xdata, generic pointers, and !=, <=, >=, !, && and ||.)
# Exit status 1 if one is found.
set -eu
[ $# -gt 0 ] || {
    echo "usage: check_asm.sh FILE.asm..." >&2
    exit 2
}
exec awk '
function complain(place, what) {
    printf "%s: error: %s\n", place, what | "cat >&2"
    failed = 1
}
FNR == 1 { function_name = ""; area = ""; source = "" }
/^;\t[^[][^:]*:[0-9]+:/ { match($0, /:[0-9]+:/); source = substr($0, 3, RSTART + RLENGTH - 4) }
/^;\t\[.*\] ic:[0-9]+:/ { has_icode[FILENAME] = 1 }
/ ic:[0-9]+:[ \t]+\*\(.* (near|idata)\* .*\) := .*\{bit fixed\}$/ {
    complain(source, "SDCC loses the store of this comparison; write: if (...) it = true; else it = false;")
}
{ sub(/;.*/, ""); sub(/ljmp[ \t]+sdcc_atomic_maybe_rollback/, "reti") } # as SDCC 4.5 ends an interrupt
$1 == ".area" { area = $2; function_name = ""; next }
area == "OSEG" && /^_[A-Za-z0-9_]+:/ { sub(/:.*/, ""); overlay[$1] = 1; next }
area == "HOME" && $1 == "ljmp" { vector[$2] = 1; next }
$1 == "lcall" { called[$2] = 1 }
/^_[A-Za-z0-9_]+::?/ && area == "CSEG" { sub(/:.*/, ""); function_name = $1; functions[FILENAME] = 1; next }
function_name != "" && NF > 0 {
    lines[function_name] = lines[function_name] FILENAME ":" FNR "\t" $0 "\n"
    if ($1 == "reti") {
        interrupts[function_name] = FILENAME ":" FNR
    }
}
END {
    for (file in functions) {
        if (!(file in has_icode)) {
            complain(file, "no intermediate code, so lost stores do not show; compile with --i-code-in-asm")
        }
    }
    for (name in interrupts) {
        if (!(name in vector) && (name in called)) {
            continue
        }
        plain = substr(name, 2)
        if (!(name in vector)) {
            complain(interrupts[name], "interrupt \047" plain "\047 has no vector; show its prototype to the file with main")
        }
        count = split(lines[name], body, "\n")
        for (i = 1; i <= count; i++) {
            split(body[i], part, "\t")
            words = split(substr(body[i], length(part[1]) + 2), word, /[ \t,]+/)
            first = word[1] == "" ? 2 : 1
            operation = word[first]
            target = word[first + 1]
            if (operation ~ /^[la]call$/ || (operation ~ /^([las]?jmp)$/ && target !~ /^([0-9]+\$|0)$/)) {
                complain(part[1], "interrupt \047" plain "\047 calls \047" target "\047; let main do it, or write it inline")
            }
            for (j = first + 1; j <= words; j++) {
                symbol = word[j]
                gsub(/[()#@]/, "", symbol)
                if (symbol in overlay || symbol ~ /_PARM_[0-9]+$/) {
                    complain(part[1], "interrupt \047" plain "\047 uses \047" symbol "\047, which shares its place with the locals of main; make it static")
                }
            }
        }
    }
    close("cat >&2")
    exit failed
}' "$@"
