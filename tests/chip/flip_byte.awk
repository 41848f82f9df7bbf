# SPDX-License-Identifier: MIT
# Inverts the lowest bit of the byte at `address` in an Intel HEX file and mends the record's sum:
#     awk -v address=4660 -f flip_byte.awk IN.ihx >OUT.ihx
function number(hex,    i, n) {
    n = 0
    for (i = 1; i <= length(hex); i++) {
        n = n * 16 + index("0123456789ABCDEF", toupper(substr(hex, i, 1))) - 1
    }
    return n
}
{
    sub(/\r$/, "")
    count = number(substr($0, 2, 2))
    start = number(substr($0, 4, 4))
    if (substr($0, 8, 2) == "00" && address >= start && address < start + count) {
        place = 10 + 2 * (address - start)
        byte = number(substr($0, place, 2))
        byte += byte % 2 == 0 ? 1 : -1
        $0 = substr($0, 1, place - 1) sprintf("%02X", byte) substr($0, place + 2)
        sum = 0
        for (i = 2; i < length($0) - 2; i += 2) {
            sum += number(substr($0, i, 2))
        }
        $0 = substr($0, 1, length($0) - 2) sprintf("%02X", (256 - sum % 256) % 256)
        flipped++
    }
    print
}
END { exit flipped != 1 }
