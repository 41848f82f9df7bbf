#!/bin/bash
# SPDX-License-Identifier: MIT
# Makes tests/golden/*_octave.csv anew; takes a few minutes. `tools/deps.sh golden` installs what it needs.
set -eu
cd "$(dirname "$0")/../.."
tools/deps.sh golden
mkdir -p build/golden
GOLDEN=$PWD/tests/golden BUILD=$PWD/build/golden octave-cli --no-gui --quiet tests/golden/make_octave.m
