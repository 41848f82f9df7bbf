# STC89C516RD+ on a common development board: the default board.
CHIP       := STC89C516RD+
S51_TYPE   := C52
CLK_HZ     := 12000000
CODE_BYTES := 63488
IRAM_BYTES := 256
ENCODING   := plain
WATCHDOG   := stc89
FAULT_PCT  := 60
APPS       := brake tuned classic first none radar radar_mom gap follow follow_paper park park_late

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

FLASH      = stcgal -P stc89 -p $(PORT) $(HEX)
FLASH_GET := tools/deps.sh flash && pipx install stcgal
FLASH_HOW := Wire RXD P3.0, TXD P3.1, ground to a 5 V serial adapter; start, then switch the chip off and on.
