# SPDX-License-Identifier: MIT
# The instructions of firmware/mcu and of the main loops in images, from the listings (.rst) of their modules. Prints
# for each the image, its address there, and what names it in every image: file and line, its number in that line, and
# its text without numbers and labels, which differ from image to image:
#     at89s52/brake<tab>0836<tab>firmware/mcu/start.c:94 12 mov dpl, #
#     awk -f instructions.awk build/BOARD/IMAGE/ROOM/MODULE.rst...
FNR == 1 {
    where = ""
    image = FILENAME
    sub(/^build\//, "", image)
    sub(/\/[^\/]*\/[^\/]*$/, "", image)
    delete number
}
match($0, /;\t[^ ]+\.[ch]:[0-9]+: /) {
    where = substr($0, RSTART + 2, RLENGTH - 4)
    if (where !~ /^firmware\/(mcu\/|[a-z]*\/main\.c|frames\/frames\.c)/) where = ""
}
where != "" && match($0, /^ +00[0-9A-F]+ ([0-9A-F][0-9A-F] )+ +\[[0-9]+\] +[0-9]+ /) {
    address = substr($1, length($1) - 3)
    text = substr($0, RLENGTH + 1)
    sub(/ *;.*/, "", text)
    gsub(/[ \t]+/, " ", text)
    gsub(/[0-9]+\$/, "label", text)
    gsub(/(#|\+ ?)(0x)?[0-9a-fA-F]+/, "#", text)
    sub(/^ /, "", text)
    print image "\t" address "\t" where " " ++number[where] " " text
}
