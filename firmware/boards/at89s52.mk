# SPDX-License-Identifier: MIT
# AT89S52: 8 KB of code in all, so the table is packed; a watchdog of 16,384 machine cycles.
CHIP       := AT89S52
S51_TYPE   := 51R
CLK_HZ     := 12000000
CODE_BYTES := 8192
IRAM_BYTES := 256
ENCODING   := packed
WATCHDOG   := at89s52
SENSORS    := hcsr04
BOARD_FAULT_PCT := 60

# The default programmer is an Arduino with the sketch ArduinoISP; a USBasp (PROGRAMMER=usbasp) needs no
# PORT. avrdude 7.1 does not know the chip, so the .conf file beside this one describes it.
PORT := $(or $(PORT),$(if $(filter usb%,$(PROGRAMMER)),usb))
BOARD_FLASH = avrdude -C +firmware/boards/at89s52.conf -c $(PROGRAMMER) -b 19200 -P $(PORT) -p AT89S52 -U flash:w:$(HEX):i
FLASH_GET  := tools/deps.sh flash
FLASH_HOW  := Wire MOSI P1.5, MISO P1.6, SCK P1.7, RST (high while programming), ground; a crystal must be fitted.
