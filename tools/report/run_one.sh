#!/bin/sh
# SPDX-License-Identifier: MIT
# One run of the report, on this machine or another: run_one.sh KEY HEX BOARD SCENARIO SECONDS ENGINE FOLDER
# FOLDER/KEY appears when the run has ended, whatever came of it, and holds what drive wrote
# (result.json), what it said (log) and its exit status (exit). Says one line, and always succeeds:
# a run that failed is a result like another; report.sh counts them.
set -u
key=$1 hex=$2 board=$3 scenario=$4 seconds=$5 engine=$6 folder=$7
work=$folder/$key.part
rm -rf "${work:?}" "${folder:?}/$key"
mkdir -p "$work"
# In the foreground, so that who ends this script's group ends drive; its simulator ends with it.
timeout --foreground -k 5 "$seconds" "${DRIVE:-build/drive}" run --engine "$engine" --hex "$hex" --board "$board" --scenario "$scenario" \
    --json "$work/result.json" >"$work/log" 2>&1
status=$?
# A verdict counts only with a complete result.
case $status in
0 | 1) grep -q '"series"' "$work/result.json" 2>/dev/null || { echo "drive ended with $status but left no result" >>"$work/log" && status=2; } ;;
124 | 137) echo "not done after $seconds s" >>"$work/log" ;;
esac
echo "$status" >"$work/exit"
mv "$work" "$folder/$key"
case $status in
0 | 1) echo "ran $key" ;;
*) echo "failed $key" ;;
esac
exit 0
