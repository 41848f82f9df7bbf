# SPDX-License-Identifier: MIT
# The look-up on the chip: an image a table, compiled as it ships.
LUT_plain           := tables/brake.fis
LUT_plain-repaired  := tables/brake.fis --repair=-1,+2
LUT_packed          := tables/brake.fis --encoding=packed
LUT_packed-repaired := tables/brake.fis --encoding=packed --repair=-1,+2
LUT_packed-tuned    := tables/brake_tuned.fis --encoding=packed --grid=$(TUNED_GRID)
# Other paths of lut.c: one input, 256 cells along either axis, no rows alike at the start, many blocks.
LUT_plain-one-input := tests/lut/one_input.fis
LUT_plain-256       := tables/brake.fis --grid=40x256
LUT_packed-256      := tables/brake.fis --encoding=packed --grid=256x40
LUT_packed-gap      := tables/gap.fis --encoding=packed
LUT_packed-wide     := tables/gap.fis --encoding=packed --levels=200
LUT_CASES  := $(patsubst LUT_%,%,$(filter LUT_p%,$(.VARIABLES)))
LUT_IMAGES := $(LUT_CASES:%=build/lut/%/all_cells.ihx) $(LUT_CASES:%=build/lut/%/host)

define lut_rules
build/lut/$(1)/lut_table.h: $(firstword $(LUT_$(1))) build/fistab
	$$(folder)
	$$(Q)build/fistab table $(LUT_$(1)) --name=lut --csv=$$(@D)/cells.csv -o $$@ 2>$$(@D)/fistab.log || \
	    { cat $$(@D)/fistab.log >&2; false; }
build/lut/$(1)/%.rel: %.c build/lut/$(1)/lut_table.h
	$$(folder)
	$$(Q)$(SDCC) -Ifirmware/lib -Ibuild/lut/$(1) -MMD -c $$< -o $$@
build/lut/$(1)/all_cells.ihx: build/lut/$(1)/tests/lut/all_cells.rel build/lut/$(1)/firmware/lib/lut.rel
	$$(Q)$(SDCC) $$^ -o $$@
build/lut/$(1)/host: tests/lut/host.c firmware/lib/lut.c build/lut/$(1)/lut_table.h
	$$(Q)$(CC) -g1 -Og $(SANITIZE) $(HOST_FLAGS) -Ifirmware/lib -Ibuild/lut/$(1) tests/lut/host.c firmware/lib/lut.c -o $$@
endef
$(foreach case,$(LUT_CASES),$(eval $(call lut_rules,$(case))))

-include $(wildcard build/lut/*/*/*/*.d)
