#!/bin/bash
# SPDX-License-Identifier: MIT
# tools/compile.sh compiles each text once. Two of it at once, one that is stopped, and a header that changes
# meanwhile leave nothing wrong in build/objects.
. tests/lib.sh
mkdir -p "$out/build"
ln -s "$PWD/tools" "$out/tools"
cd "$out" || exit 1

# A compiler that notes each compilation and, while there is a file `held`, waits before it begins.
cat >cc <<'END'
#!/bin/sh
case " $* " in *" -c "*)
    echo compiled >>calls
    while [ -e held ]; do sleep 0.05; done
    ;;
esac
exec sdcc "$@"
END
chmod +x cc
: >calls
cat >text.c <<'END'
#include "text.h"
unsigned char text(void) { return VALUE; } /* first comment */
END
echo '#define VALUE 1' >text.h

start() { # FOLDER [FLAG...]: in place of the shell that calls it
    exec tools/compile.sh text.c "build/$1/text.rel" ./cc -mmcs51 "${@:2}"
}
compile() {
    (start "$@")
}
calls() {
    grep -c compiled calls
}
kept() { # all that is there of objects, whole or not
    find build/objects -mindepth 1 -maxdepth 1 | wc -l
}
await_calls() { # NUMBER
    for _ in $(seq 600); do
        [ "$(calls)" -lt "$1" ] || return 0
        sleep 0.05
    done
}

fault=$(compile one -DUNUSED=1 2>&1 && compile two -DUNUSED=2 2>&1)
faultless "both compile" "$fault"
[ "$(calls)" = 1 ] && [ "$(kept)" = 1 ] && cmp build/one/text.rel build/two/text.rel
say "one text is compiled once" $? "$(calls) compilations, $(kept) kept"
compile three --i-code-in-asm
[ "$(calls)" = 2 ] && [ "$(kept)" = 2 ]
say "other flags are compiled for themselves" $? "$(calls) compilations, $(kept) kept"
sed -i 's/first comment/second comment/' text.c
compile one
[ "$(calls)" = 3 ] && grep -q 'second comment' build/one/text.lst
say "the listing has the newest comments" $? "$(calls) compilations; $(grep comment build/one/text.lst)"

sed -i 's/VALUE 1/VALUE 2/' text.h
touch held
start one &
first=$!
start two &
second=$!
await_calls 5
rm held
wait $first
status=$?
wait $second || status=1
[ $status = 0 ] && cmp build/one/text.rel build/two/text.rel && [ "$(kept)" = 4 ]
say "two at once both get a whole object" $? "status $status, $(kept) kept"

sed -i 's/VALUE 2/VALUE 3/' text.h
touch held
start one 2>log &
stopped=$!
await_calls 6
kill -TERM $stopped
rm held
wait $stopped
status=$?
[ $status != 0 ] && [ "$(kept)" = 4 ]
say "one that is stopped keeps nothing" $? "status $status, $(kept) kept"

touch held
start one 2>log &
changed=$!
await_calls 7
echo '#define VALUE 4' >text.h
rm held
wait $changed
status=$?
[ $status != 0 ] && [ "$(kept)" = 4 ] && grep -q 'text.h: error: changed while text.c was compiled; run make again' log
say "a header that changes meanwhile is refused" $? "status $status, $(kept) kept: $(cat log)"
finish
