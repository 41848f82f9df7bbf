# SPDX-License-Identifier: MIT
# A TF-Luna's frames of a drive of chance, as octal escapes for printf '%b':
#     awk -v count=FRAMES -f tfluna.awk
# Targets of 0..35 m/s either way, jumps, clear roads, light that blinds, the dead zone, lost bytes.
function chance(below) {
    seed = (seed * 16807) % 2147483647
    return seed % below
}
function send(byte) {
    byte %= 256
    sum += byte
    text = text sprintf("\\0%03o", byte)
}
function send_word(word) {
    send(word)
    send(int(word / 256))
}
BEGIN {
    seed = 51
    place_mm = 7900
    nearer_mm = 50
    for (k = 0; k < count; k++) {
        what = chance(100)
        if (what < 3) {
            place_mm = 100 + chance(8000)
            nearer_mm = chance(700) - 350
        }
        place_mm -= nearer_mm
        if (place_mm < 20 || place_mm > 8200) {
            nearer_mm = -nearer_mm
            place_mm = place_mm < 20 ? 300 : 7800
        }
        text = ""
        sum = 0
        send_word(89 * 257) # 59 59
        send_word(int(place_mm / 10))
        send_word(what == 99 ? 65535 : what >= 90 ? 50 : 1000)
        send_word((25 + 256) * 8)
        send(sum)
        printf "%s", what == 89 ? substr(text, 6) : text # one byte is lost
    }
}
