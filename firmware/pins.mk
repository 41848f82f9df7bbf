# SPDX-License-Identifier: MIT
# The pins that all boards share, by their bit address: 0x90 is P1.0, 0xB2 is P3.2. A board with
# another wiring sets a pin again in its fragment.
# During reset all pins are high. That means full brake, STOP, throttle cut, lamp and buzzer off, and
# no request for the next lane. The echo must be at P3.2, because it gates timer 0.
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
