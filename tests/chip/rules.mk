# SPDX-License-Identifier: MIT
# Images for the tests of the chip: one file of theirs in place of brake/main, linked without a limit of code size.
ifneq ($(BOARD),)
$(eval $(call compile_rules,brake,))
$(OUT)/tests/%.ihx: $(OUT)/brake/tests/%.rel $(patsubst %,$(OUT)/brake/%.rel,$(filter-out brake/main,$(brake_MODULES)))
	$(Q)tools/check_asm.sh $(^:.rel=.asm)
	$(link_of_any_size)
	$(Q)tools/identify.sh $@ $(IDENTITY_AT)
endif

# Our own simulator for these images: fast_pins drives pins at exact times, fast_image runs an image that
# tests itself.
FAST_CHIPS := build/tests/fast_image build/tests/fast_pins
$(FAST_CHIPS): build/tests/fast_%: build/host/tests/chip/fast_%.o $(patsubst %.c,build/host/%.o,$(wildcard tools/drive/sim/mcs52*.c) $(COMMON_SRC))
	$(folder)
	$(Q)$(CC) $(CFLAGS) $^ -lm -o $@
build/host/tests/%.o: HOST_FLAGS += $(DRIVE_ROOMS)
-include $(wildcard build/host/tests/chip/*.d)
