# SPDX-License-Identifier: MIT
# The radar: brakes behind a target of a millimetre-wave radar.
IMAGES_OF_radar := radar radar_mom

radar_TABLE   := tables/radar.fis
radar_FISTAB  := --grid=13x13 --samples=7 --levels=240 --half-down
radar_CYCLES  := $(FRAME_CYCLES)
radar_MODULES := radar/main $(FRAME_MODULES) $(addprefix radar/,radar fmcw lane safe) lib/mul_u16

# The same with the mean of maxima, to compare with: it misses the second published case.
radar_mom_TABLE   := build/radar_mom.fis
radar_mom_FISTAB  := $(radar_FISTAB)
radar_mom_CYCLES  := $(FRAME_CYCLES)
radar_mom_MODULES := $(radar_MODULES)
build/radar_mom.fis: tables/radar.fis
	@mkdir -p $(@D)
	$(Q)sed "0,/^Name=/s/^Name=.*/Name='radar_mom'/; s/'centroid'/'mom'/" $< >$@
