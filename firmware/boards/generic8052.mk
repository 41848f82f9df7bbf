# SPDX-License-Identifier: MIT
# Any 8052 with 32 KB of code, at the crystal that most UART boards carry; no watchdog. It has no
# flasher: give the command of yours, FLASH='mytool $(HEX)'.
CHIP       := 8052
S51_TYPE   := C52
CLK_HZ     := 11059200
CODE_BYTES := 32768
IRAM_BYTES := 256
ENCODING   := plain
WATCHDOG   := none
SENSORS    := hcsr04 tfluna
BOARD_FAULT_PCT := 60
