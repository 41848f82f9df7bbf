# Test lines for shell tests that judge by a status: say NAME STATUS [why]; ends with `exit $failed`.
failed=0
say() {
    if [ "$2" = 0 ]; then
        echo "$0:${BASH_LINENO[0]}:$1:PASS"
    else
        echo "$0:${BASH_LINENO[0]}:$1:FAIL: $3"
        failed=1
    fi
}
