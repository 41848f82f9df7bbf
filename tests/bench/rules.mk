# SPDX-License-Identifier: MIT
# Images that time an image's control step, linked without a limit of code size. For the brake
# tests/bench/brake takes the place of brake/main; for a frame-fed controller tests/bench/frames takes
# the place of frames/frames, and its payloads are in tests/bench/NAME.c. The object with main is first.
ifneq ($(BOARD),)
define bench_rules
$(call compile_rules,$(1),)
$(OUT)/bench/$(1).ihx: $(patsubst %,$(OUT)/$(1)/%.rel, \
        $(if $(filter frames/frames,$($(1)_MODULES)), \
            $(patsubst frames/frames,tests/bench/frames tests/bench/$(call controller_of,$(1)),$($(1)_MODULES)), \
            $(patsubst brake/main,tests/bench/brake,$($(1)_MODULES))) \
        tests/bench/step)
	$$(link_of_any_size)
	$$(Q)tools/identify.sh $$@ $(IDENTITY_AT)
endef
$(foreach image,$(ALL_IMAGES),$(eval $(call bench_rules,$(image))))
endif

# The payloads as frames, as the chip's UART gets them.
BENCH_LINES := $(patsubst tests/bench/%.c,build/bench/line_%,$(wildcard $(CONTROLLERS:%=tests/bench/%.c)))
BENCH_LINES := $(filter-out build/bench/line_brake,$(BENCH_LINES))
$(BENCH_LINES): build/bench/line_%: tests/bench/line.c tests/bench/%.c tests/bench/step.h $(addprefix build/host/tools/drive/plant/,head.o random.o) | all
	$(folder)
	$(Q)$(CC) $(CFLAGS) -O0 -std=c11 -D_GNU_SOURCE -Itools/common $(DRIVE_ROOMS) -Ibuild $(patsubst %,-Ifirmware/%,lib frames mcu $*) \
	    $(filter %.c %.o,$^) -lm -o $@

.PHONY: run-bench
# What it prints stays for the report's page.
run-bench: SHELL := /bin/bash
run-bench: all $(LUT_IMAGES) $(BENCH_LINES)
	@mkdir -p build/bench
	@set -o pipefail; { missed=0; for bench in tests/bench/*.sh; do echo "== $$bench"; $$bench || missed=1; done; exit $$missed; } | tee build/bench/bench.txt
