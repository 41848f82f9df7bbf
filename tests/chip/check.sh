# Test lines for shell tests: check NAME COMMAND...
checks_failed=0
check() {
    local name=$1 place="$0:${BASH_LINENO[0]}"
    shift
    if "$@"; then
        echo "$place:$name:PASS"
    else
        echo "$place:$name:FAIL: $*"
        checks_failed=$((checks_failed + 1))
    fi
}

check_end() {
    [ "$checks_failed" -eq 0 ]
    exit
}
