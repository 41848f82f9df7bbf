#!/bin/sh
# Installs what a make target needs and the machine lacks; says what it does; does nothing when all
# is there. Packages come from the machine's own Debian sources by name. `make` calls it; by hand:
#     tools/deps.sh [build|demo|test|bench|fuzz|report|golden|pictures|format|lint|flash]...
set -eu
cd "$(dirname "$0")/.."
unity=build/deps/unity

packages_for() {
    build="gcc make libc6-dev sdcc sdcc-libraries sdcc-ucsim libinih-dev libcjson-dev"
    case $1 in
    build) echo "$build" ;;
    demo) echo "$build gnuplot-nox" ;;
    test) echo "$build gnuplot-nox parallel rsync chromium avrdude clang-format-19" ;;
    bench) echo "$build gnuplot-nox parallel fuzzylite" ;;
    fuzz) echo "$build clang libclang-rt-14-dev" ;;
    report) echo "$build gnuplot-nox parallel rsync" ;;
    golden) echo "$build octave octave-fuzzy-logic-toolkit fuzzylite" ;;
    pictures) echo "$build gnuplot-nox pngquant" ;;
    format) echo "clang-format-19" ;;
    lint) echo "$build shellcheck cppcheck" ;;
    flash) echo "avrdude pipx" ;;
    *)
        echo "deps.sh: error: no target '$1'; use build, demo, test, bench, fuzz, report, golden, pictures, format, lint or flash" >&2
        exit 2
        ;;
    esac
}

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
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
    # shellcheck disable=SC2086  # a list of words
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $missing >/dev/null
}

# Unity is in no package of its own, but whole inside the source package of cJSON. apt fetches and
# checks it, with a source list of our own made from the machine's, so that its set-up stays as it is.
fetch_unity() {
    [ -f "$unity/src/unity.c" ] && return 0
    if [ -n "${UNITY_DIR:-}" ]; then
        [ -f "$UNITY_DIR/src/unity.c" ] || {
            echo "deps.sh: error: UNITY_DIR=$UNITY_DIR has no src/unity.c; name a checkout of Unity" >&2
            exit 1
        }
        mkdir -p "$unity"
        cp -R "$UNITY_DIR/src" "$unity/"
        return 0
    fi
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
    # shellcheck disable=SC2086  # a list of words
    install_missing $packages
    if [ "$target" = test ]; then fetch_unity; fi
done
