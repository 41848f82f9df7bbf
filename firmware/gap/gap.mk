# SPDX-License-Identifier: MIT
# The gap controller: keeps the safe distance to the car ahead.
IMAGES_OF_gap := gap

gap_TABLE   := tables/gap.fis
gap_FISTAB  := --nodes --grid=33x33 --levels=200
gap_FLAGS   := -DSERVO
gap_CYCLES  := $(FRAME_CYCLES)
gap_MODULES := gap/main $(FRAME_MODULES) gap/gap lib/mul_u16 mcu/servo
