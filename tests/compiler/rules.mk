# SPDX-License-Identifier: MIT
# Chip against host (steps.h): for each image, build/compiler/BOARD/IMAGE/steps.ihx from the very objects that
# its firmware is linked of, and steps beside it, the host's program. The objects are copied first with their
# listings, because the linker writes its addresses into them. What is the same for all images of a board is
# compiled once, in build/compiler/BOARD; if an image's flags did change such a part, chip and host would differ.

# What is compared of an image: all but the machine and the main loop; and the one part of lib that not each image has.
steps_modules = $(sort lib/mul_u16 $(filter-out mcu/% %/main frames/frames,$($(1)_MODULES)))

STEPS_SAME    := $(addprefix firmware/,lib/mul_u16 lib/fixed lib/lamp lib/telemetry frames/frame frames/link) $(addprefix tests/compiler/,host words)

# The images with a decision of their own.
STEPS_IMAGES := $(foreach image,$(ALL_IMAGES),$(if $(filter $(call controller_of,$(image))/%,$(call steps_modules,$(image))),$(image)))

ifneq ($(BOARD),)
STEPS_OUT := build/compiler/$(BOARD)
# The simulator, and what encodes frames.
STEPS_SIM := $(patsubst %.c,build/host/%.o,$(wildcard tools/drive/sim/mcs52*.c) tools/drive/plant/head.c tools/drive/plant/random.c $(COMMON_SRC))

# The objects of an image: what all have, and its own.
steps_objects = $(patsubst %,$(STEPS_OUT)/%.o,$(filter $(STEPS_SAME),$(2))) $(patsubst %,$(STEPS_OUT)/$(1)/%.o,$(filter-out $(STEPS_SAME),$(2)))

compiler-images: $(STEPS_IMAGES:%=$(STEPS_OUT)/%/steps.ihx) $(STEPS_IMAGES:%=$(STEPS_OUT)/%/steps)
$(STEPS_OUT)/%.rel: tests/compiler/%.c $(STEPS_IMAGES:%=$(OUT)/%/image.stamp)
	$(folder)
	$(Q)$(SDCC) $(SDCC_FLAGS) -Ifirmware/lib -MMD -c $< -o $@
$(STEPS_OUT)/%.o: %.c $(STEPS_IMAGES:%=$(OUT)/%/image.stamp)
	$(folder)
	$(Q)$(STEPS_CC) -Ifirmware/lib -Ifirmware/frames $(DRIVE_ROOMS) -c $< -o $@
define steps_rules
$(STEPS_OUT)/$(1)/%.rel: tests/compiler/%.c $(OUT)/$(1)/lut_table.h $(OUT)/$(1)/image.stamp
	$$(folder)
	$$(Q)$(SDCC) $(SDCC_FLAGS) $($(1)_FLAGS) $(includes_of) -I$(OUT)/$(1) -MMD -c $$< -o $$@
$(STEPS_OUT)/$(1)/shipped/%.rel: $(OUT)/$(1)/%.rel
	$$(folder)
	$$(Q)cp $$< $$(<:.rel=.lst) $$(@D)
$(STEPS_OUT)/$(1)/shipped/%.rel: $(STEPS_OUT)/%.rel
	$$(folder)
	$$(Q)cp $$< $$(<:.rel=.lst) $$(@D)
$(STEPS_OUT)/$(1)/steps.ihx: $(patsubst %,$(STEPS_OUT)/$(1)/%.rel,lib $(controller_of)) \
        $(patsubst %,$(STEPS_OUT)/$(1)/shipped/%.rel,chip words $(steps_modules))
	$$(Q)$(SDCC) $$^ -o $$@
$(STEPS_OUT)/$(1)/%.o: %.c $(OUT)/$(1)/lut_table.h $(OUT)/$(1)/image.stamp
	$$(folder)
	$$(Q)$(STEPS_CC) $($(1)_FLAGS) $(includes_of) $(DRIVE_ROOMS) -I$(OUT)/$(1) -c $$< -o $$@
$(STEPS_OUT)/$(1)/steps: $(call steps_objects,$(1),$(addprefix tests/compiler/,host words lib $(controller_of)) $(steps_modules:%=firmware/%)) $(STEPS_SIM)
	$$(Q)$(CC) $(CFLAGS) $$^ -lm -o $$@
endef
# With SDCC's flags, but for those of the compiler itself.
STEPS_CC = $(CC) -O0 $(HOST_FLAGS) -Wno-sign-conversion $(filter -D%,$(SDCC_FLAGS))
$(foreach image,$(STEPS_IMAGES),$(eval $(call steps_rules,$(image))))
-include $(wildcard $(STEPS_OUT)/*.d $(STEPS_OUT)/*/*.d $(STEPS_OUT)/*/*/*.d $(STEPS_OUT)/*/*/*/*.d)
endif

# With BOARD, of that one; else of the default board. `make test-long` makes the long run on all boards.
.PHONY: compiler-build compiler-build-all compiler-images
compiler-build: tools firmware
	@$(MAKE) BOARD=$(or $(BOARD),$(DEFAULT_BOARD)) compiler-images
compiler-build-all: tools firmware
	@for board in $(or $(BOARD),$(BOARDS)); do $(MAKE) BOARD=$$board compiler-images; done

STEPS_SUITES      := $(STEPS_IMAGES:%='tests/compiler/run.sh $(or $(BOARD),$(DEFAULT_BOARD)) % 50000') tests/compiler/test_finds.sh
STEPS_LONG_SUITES := $(foreach board,$(or $(BOARD),$(BOARDS)),$(STEPS_IMAGES:%='tests/compiler/run.sh $(board) % 1000000'))
