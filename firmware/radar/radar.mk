# SPDX-License-Identifier: MIT
# The radar: brakes behind a target of a millimetre-wave radar.
IMAGES_OF_radar := radar radar_mom radar_gauss

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
	$(folder)
	$(Q)sed "0,/^Name=/s/^Name=.*/Name='radar_mom'/; s/'centroid'/'mom'/" $< >$@

# The same with the printed formula of the sets, exp(-0.25 (x - a)^2), in place of the printed table of
# memberships, to compare with: these are not the same.
radar_gauss_TABLE   := build/radar_gauss.fis
radar_gauss_FISTAB  := $(radar_FISTAB)
radar_gauss_CYCLES  := $(FRAME_CYCLES)
radar_gauss_MODULES := $(radar_MODULES)
build/radar_gauss.fis: tables/radar.fis
	$(folder)
	$(Q)sed "0,/^Name=/s/^Name=.*/Name='radar_gauss'/; s/'pwlmf',.*/'gaussmf',[1.4142136 CENTRE]/; \
	    /gaussmf/{/'NB'/s/CENTRE/-6/; /'NM'/s/CENTRE/-4/; /'NS'/s/CENTRE/-2/; /'ZE'/s/CENTRE/0/; \
	    /'PS'/s/CENTRE/2/; /'PM'/s/CENTRE/4/; /'PB'/s/CENTRE/6/}" $< >$@
