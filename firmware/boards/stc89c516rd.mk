# SPDX-License-Identifier: MIT
# STC89C516RD+ on a common development board: the default board.
CHIP       := STC89C516RD+
S51_TYPE   := C52
CLK_HZ     := 12000000
CODE_BYTES := 63488
IRAM_BYTES := 256
ENCODING   := plain
WATCHDOG   := stc89
SENSORS    := hcsr04 tfluna
BOARD_FAULT_PCT := 60

BOARD_FLASH = stcgal -P stc89 -p $(PORT) $(HEX)
FLASH_GET  := tools/deps.sh flash && pipx install stcgal
FLASH_HOW  := Wire RXD P3.0, TXD P3.1, ground to a 5 V serial adapter; start, then switch the chip off and on.
