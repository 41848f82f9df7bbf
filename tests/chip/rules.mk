# SPDX-License-Identifier: MIT
# Images for the tests of the chip: one file of theirs in place of brake/main.
ifneq ($(BOARD),)
$(eval $(call compile_rules,brake,))
$(OUT)/tests/%.ihx: $(OUT)/brake/tests/%.rel $(patsubst %,$(OUT)/brake/%.rel,$(filter-out brake/main,$(brake_MODULES)))
	@mkdir -p $(@D)
	$(Q)tools/check_asm.sh $(^:.rel=.asm)
	$(Q)$(SDCC) $(SDCC_LINK) $^ -o $@
endif
