# SPDX-License-Identifier: MIT
# STC89C52RC: the commonest STC. 8 KB of code in all, so the table is packed.
CHIP       := STC89C52RC
S51_TYPE   := C52
CLK_HZ     := 12000000
CODE_BYTES := 8192
IRAM_BYTES := 256
ENCODING   := packed
WATCHDOG   := stc89
SENSORS    := hcsr04
BOARD_FAULT_PCT := 60

BOARD_FLASH = stcgal -P stc89 -p $(PORT) $(HEX)
FLASH_GET  := tools/deps.sh flash && pipx install stcgal
FLASH_HOW  := Wire RXD P3.0, TXD P3.1, ground to a 5 V serial adapter; start, then switch the chip off and on.
