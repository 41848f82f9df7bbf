# SPDX-License-Identifier: MIT
# For a freshly wired board: shows each pin by itself, then the distances (docs/wiring.md). It carries the
# brake's table, so that it also shows whether the flash memory holds what was written.
IMAGES_OF_bringup := bringup

bringup_TABLE   := $(TABLE)
bringup_FISTAB   = $(BRAKE_FISTAB)
bringup_SMALLER := $(BRAKE_SMALLER)
bringup_FLAGS   := $(BRAKE_KNOBS)
bringup_CYCLES  := every_tick
bringup_MODULES := bringup/main $(LIB_MODULES) brake/range mcu/echo mcu/uart
