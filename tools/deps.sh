#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what a make target needs and the machine lacks; says what it does; does nothing when all
# is there. Packages come from the machine's own Debian sources by name. `make` calls it; by hand:
#     tools/deps.sh [TARGET]...        the targets stand in packages_for below; build is the default
# Without apt-get, or with NO_INSTALL=1, it installs nothing: it looks for the programs and headers
# themselves, and names all that are missing in one message.
set -eu
cd "$(dirname "$0")/.."
unity=build/deps/unity

packages_for() {
    build="gcc make libc6-dev sdcc sdcc-libraries sdcc-ucsim libinih-dev libcjson-dev"
    page="jq parallel rsync clang lld wasi-libc libclang-rt-dev-wasm32"
    case $1 in
    build | sim | attack | flips) echo "$build" ;;
    demo) echo "$build gnuplot-nox" ;;
    unit) echo "$build parallel" ;;
    test) echo "$build $page gnuplot-nox chromium avrdude clang-format-19 fuzzylite" ;;
    bench) echo "$build gnuplot-nox parallel fuzzylite" ;;
    # Debian 13 has no Frama-C: install_missing says so.
    prove) echo "$build frama-c-base ocaml-findlib why3 z3 cvc4" ;;
    fuzz) echo "$build clang libclang-rt-dev" ;;
    mutants) echo "$build clang libclang-dev" ;;
    report) echo "$build $page" ;;
    golden) echo "$build octave octave-fuzzy-logic-toolkit fuzzylite" ;;
    pictures) echo "$build gnuplot-nox pngquant" ;;
    format) echo "clang-format-19" ;;
    lint) echo "$build shellcheck cppcheck" ;;
    flash) echo "avrdude pipx" ;;
    debian) echo "mmdebstrap git" ;;
    *)
        echo "deps.sh: error: no target '$1'; use build, demo, sim, unit, test, bench, attack, flips, prove, mutants, fuzz, report, golden, pictures, format, lint, flash or debian" >&2
        exit 2
        ;;
    esac
}

# What shows that a package's content is there, wherever it came from: programs, of which one is enough, or
# a header, or a file, or nothing to look for, because another package of the list needs it.
proof_of() {
    case $1 in
    libc6-dev) echo "<stdio.h>" ;;
    libinih-dev) echo "<ini.h>" ;;
    libcjson-dev) echo "<cjson/cJSON.h>" ;;
    libclang-dev) echo "/usr/lib/llvm-*/include/clang-c/Index.h" ;;
    sdcc-libraries | libclang-rt-* | octave-fuzzy-logic-toolkit) ;;
    sdcc-ucsim) echo "s51 ucsim_51" ;;
    gnuplot-nox) echo "gnuplot" ;;
    lld) echo "wasm-ld" ;;
    wasi-libc) echo "<wasm32-wasi/iso646.h>" ;;
    frama-c-base) echo "frama-c" ;;
    ocaml-findlib) echo "ocamlfind" ;;
    octave) echo "octave octave-cli" ;;
    *) echo "$1" ;;
    esac
}

is_there() {
    proof=$(proof_of "$1")
    case $proof in
    '') ;;
    '<'*) echo "#include $proof" | ${CC:-cc} -E - >/dev/null 2>&1 ;;
    /*)
        # shellcheck disable=SC2086  # a pattern
        ls $proof >/dev/null 2>&1
        ;;
    *)
        for program in $proof; do
            command -v "$program" >/dev/null && return 0
        done
        return 1
        ;;
    esac
}

may_install() {
    [ "${NO_INSTALL:-0}" != 1 ] && command -v apt-get >/dev/null
}

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# One line a missing thing.
missing_things() {
    for package in "$@"; do
        is_there "$package" || echo "    $(proof_of "$package" | sed 's/ / or /g')    (Debian package $package)"
    done
    if [ "$needs_unity" = 1 ] && [ ! -f "$unity/src/unity.c" ]; then
        echo "    Unity    (give a checkout of it: UNITY_DIR=...)"
    fi
}

as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        echo "deps.sh: error: not root and no sudo; run as root: $*" >&2
        exit 1
    fi
}

install_missing() {
    missing=
    for package in "$@"; do
        is_installed "$package" || missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    echo "deps.sh: installing$missing"
    as_root apt-get -qq update
    unknown=
    for package in $missing; do
        apt-cache show "$package" >/dev/null 2>&1 || unknown="$unknown $package"
    done
    [ -z "$unknown" ] || {
        echo "deps.sh: error: this Debian has no package$unknown; another one may: tools/in-debian bookworm make $target" >&2
        exit 1
    }
    # shellcheck disable=SC2086  # a list of words
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $missing >/dev/null
}

# Takes Unity from the checkout that UNITY_DIR names.
take_unity() {
    [ -f "$unity/src/unity.c" ] && return 0
    [ -f "$UNITY_DIR/src/unity.c" ] || {
        echo "deps.sh: error: UNITY_DIR=$UNITY_DIR has no src/unity.c; name a checkout of Unity" >&2
        exit 1
    }
    mkdir -p "$unity"
    cp -R "$UNITY_DIR/src" "$unity/"
}

# Unity is in no package of its own, but whole inside the source package of cJSON. apt fetches and
# checks it, with a source list of our own made from the machine's, so that its set-up stays as it is.
fetch_unity() {
    [ -f "$unity/src/unity.c" ] && return 0
    echo "deps.sh: fetching Unity (Debian source package cjson)"
    work=$PWD/build/deps/apt
    rm -rf "$work"
    mkdir -p "$work/sources" "$work/lists/partial" "$work/download"
    # The main list stays the first that apt reads: what a later one says of the same source may add to
    # it, and would contradict it the other way about.
    to_source='s/^deb\( \|\t\)/deb-src\1/p'
    : >"$work/sources.list"
    [ ! -f /etc/apt/sources.list ] || sed -n "$to_source" /etc/apt/sources.list >"$work/sources.list"
    for list in /etc/apt/sources.list.d/*.list; do
        [ ! -f "$list" ] || sed -n "$to_source" "$list" >"$work/sources/$(basename "$list")"
    done
    for list in /etc/apt/sources.list.d/*.sources; do
        [ -f "$list" ] && sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/sources/$(basename "$list")"
    done
    set -- -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts="$work/sources" \
        -o Dir::State::lists="$work/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= \
        -o APT::Sandbox::User=root
    # A list without sources (a third party's) is no reason to stop: the next step decides.
    apt-get -qq "$@" update 2>"$work/log" || true
    if ! (cd "$work/download" && apt-get -qq "$@" --download-only source cjson >>"$work/log" 2>&1); then
        cat "$work/log" >&2
        echo "deps.sh: error: cannot fetch Unity; give a checkout of it: UNITY_DIR=... make test" >&2
        exit 1
    fi
    tar -xf "$work"/download/cjson_*.orig.tar.gz -C "$work/download" --wildcards '*/tests/unity/*'
    rm -rf "$unity"
    mv "$work"/download/*/tests/unity "$unity"
    rm -rf "$work"
}

for target in "${@:-build}"; do
    packages=$(packages_for "$target")
    needs_unity=0
    case $target in unit | test | mutants | lint) needs_unity=1 ;; esac
    if [ $needs_unity = 1 ] && [ -n "${UNITY_DIR:-}" ]; then take_unity; fi
    # shellcheck disable=SC2086  # a list of words
    if may_install; then
        install_missing $packages
        if [ $needs_unity = 1 ]; then fetch_unity; fi
    else
        missing=$(missing_things $packages)
        [ -z "$missing" ] || {
            echo "deps.sh: error: these are missing; install them and call make again:" >&2
            echo "$missing" >&2
            exit 1
        }
    fi
done
