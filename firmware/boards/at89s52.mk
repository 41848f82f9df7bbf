# AT89S52: 8 KB of code in all, so the table is packed; a watchdog of 16,384 machine cycles.
CHIP       := AT89S52
S51_TYPE   := 51R
CLK_HZ     := 12000000
CODE_BYTES := 8192
IRAM_BYTES := 256
ENCODING   := packed
WATCHDOG   := at89s52
FAULT_PCT  := 60
APPS       := brake tuned classic first none radar gap follow park

# Pins by their bit address: 0x90 is P1.0, 0xB2 is P3.2. All are high during reset, which is full
# brake and stop, throttle cut, lamp and buzzer off, no lane asked for. The echo must be P3.2: it gates timer 0.
PIN_PWM      := 0x90
PIN_STOP     := 0x91
PIN_TRIGGER  := 0x92
PIN_LAMP     := 0x93
PIN_BUZZER   := 0x94
PIN_SERVO    := 0x95
PIN_CUT      := 0x96
PIN_LANE     := 0x97
PIN_ECHO     := 0xB2
PIN_OVERRIDE := 0xB3

# An STK500-style programmer: an ArduinoISP is one. avrdude 7.1 needs the part explained.
FLASH      = avrdude -C +firmware/boards/at89s52.conf -c $(PROGRAMMER) -b 19200 -P $(PORT) -p AT89S52 -U flash:w:$(HEX):i
FLASH_GET := tools/deps.sh flash
FLASH_HOW := Wire MOSI P1.5, MISO P1.6, SCK P1.7, RST (high while programming), ground; a crystal must be fitted.
PROGRAMMER ?= avrisp
