# SPDX-License-Identifier: MIT
# Unit tests of the firmware's logic: each test_X.c is built twice, for the host, sanitized, and for the
# chip. On the chip Unity needs the large model with --stack-auto, so that is the model tested there.
UNIT_TESTS := $(patsubst tests/%.c,build/%,$(wildcard tests/unit/test_*.c))
CHIP_TESTS := $(UNIT_TESTS:build/unit/%=build/chip/%.ihx)
UNIT_FLAGS := -DCLK_HZ=12000000UL -I$(UNITY) -Ibuild/unit -Ifirmware/lib -Ifirmware/frames $(CONTROLLERS:%=-Ifirmware/%)

# The test of an image with a table of its own includes the image's decision, and lut.c, as source.
UNIT_TABLES := $(filter-out brake,$(filter $(ALL_IMAGES),$(UNIT_TESTS:build/unit/test_%=%)))
UNIT_TABLES := $(foreach image,$(UNIT_TABLES),$(if $(filter-out $(TABLE),$($(image)_TABLE)),$(image)))
LOGIC_SRC   := $(filter-out %/main.c firmware/frames/frames.c firmware/brake/law_%.c %_tfluna.c,$(wildcard firmware/lib/*.c firmware/frames/*.c $(CONTROLLERS:%=firmware/%/*.c)))
LOGIC_SRC   := $(filter-out $(foreach image,$(UNIT_TABLES),%/$(image).c),$(LOGIC_SRC)) firmware/brake/law_fuzzy.c

SDCC_UNIT  := sdcc -mmcs51 --std-c11 --model-large --stack-auto
CHIP_FLAGS := -DUNITY_INT_WIDTH=16 -DUNITY_LONG_WIDTH=32 -DUNITY_POINTER_WIDTH=16 \
    $(patsubst %,-DUNITY_EXCLUDE_%,FLOAT DOUBLE SETJMP_H MATH_H) \
    -DUNITY_OUTPUT_CHAR=chip_print -DUNITY_OUTPUT_COMPLETE=chip_end \
    '-DUNITY_OUTPUT_CHAR_HEADER_DECLARATION=chip_print(int), chip_end(void)'

build/unit/lut_table.h: $(TABLE) build/fistab
	$(folder)
	$(Q)build/fistab table $< --name=lut -o $@
define unit_table
build/unit/$(1)/lut_table.h: $($(1)_TABLE) build/fistab
	$$(folder)
	$$(Q)build/fistab table $$< --name=lut $(filter-out --encoding=%,$($(1)_FISTAB)) -o $$@
build/unit/tests/unit/test_$(1).o build/chip/tests/unit/test_$(1).rel: build/unit/$(1)/lut_table.h
build/unit/tests/unit/test_$(1).o build/chip/tests/unit/test_$(1).rel: UNIT_FLAGS := -Ibuild/unit/$(1) $(UNIT_FLAGS)
endef
$(foreach image,$(UNIT_TABLES),$(eval $(call unit_table,$(image))))

build/unit/%.o: %.c build/unit/lut_table.h
	$(folder)
	$(Q)$(CC) -g1 -Og $(SANITIZE) $(HOST_FLAGS) $(UNIT_FLAGS) -c $< -o $@
build/unit/%.o: HOST_FLAGS += -Wno-sign-conversion
build/unit/tests/%.o build/unit/$(UNITY)/%.o: HOST_FLAGS += -Wno-conversion
build/unit/liblogic.a: $(LOGIC_SRC:%.c=build/unit/%.o)
	$(Q)rm -f $@; ar rcs $@ $^
$(UNIT_TESTS): build/unit/%: build/unit/tests/unit/%.o build/unit/$(UNITY)/unity.o build/unit/liblogic.a
	$(Q)$(CC) -g $(SANITIZE) $^ -lm -o $@

build/chip/%.rel: %.c build/unit/lut_table.h
	$(folder)
	$(Q)$(SDCC_UNIT) $(UNIT_FLAGS) $(CHIP_FLAGS) -MMD -c $< -o $@
build/chip/logic.lib: $(LOGIC_SRC:%.c=build/chip/%.rel)
	$(Q)rm -f $@; sdar -rc $@ $^
$(CHIP_TESTS): build/chip/%.ihx: $(addprefix build/chip/,tests/unit/%.rel tests/unit/chip.rel $(UNITY)/unity.rel logic.lib)
	$(Q)$(SDCC_UNIT) $^ -o $@

-include $(wildcard build/unit/*/*/*.d build/chip/*/*/*.d)
