# Images that time an image's control step: a main of the bench in place of brake/main or frames/frames,
# linked without a limit of code size. A controller fed by frames has its payloads in tests/bench/NAME.c.
ifneq ($(BOARD),)
define bench_rules
$(call compile_rules,$(1),)
$(OUT)/bench/$(1).ihx: $(patsubst %,$(OUT)/$(1)/%.rel,tests/bench/step \
        $(if $(filter frames/frames,$($(1)_MODULES)),tests/bench/frames) tests/bench/$(call controller_of,$(1)) \
        $(filter-out brake/main frames/frames,$($(1)_MODULES)))
	@mkdir -p $$(@D)
	$$(Q)$(SDCC) $(SDCC_LINK) --code-size 65536 $$^ -o $$@
endef
$(foreach image,$(ALL_IMAGES),$(eval $(call bench_rules,$(image))))
endif

# The payloads as frames, as the chip's UART gets them.
BENCH_LINES := $(patsubst %,build/bench/line_%,$(filter-out brake,$(CONTROLLERS)))
$(BENCH_LINES): build/bench/line_%: tests/bench/line.c tests/bench/%.c tests/bench/step.h tools/drive/plant/head.c tools/drive/plant/random.c | all
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) -std=c11 -D_GNU_SOURCE -Itools/common $(DRIVE_ROOMS) -Ibuild $(patsubst %,-Ifirmware/%,lib frames mcu $*) \
	    $(filter %.c,$^) -lm -o $@

.PHONY: run-bench
# What it prints stays for the report's page.
run-bench: all $(LUT_IMAGES) $(BENCH_LINES)
	@mkdir -p build/bench
	@{ missed=0; for bench in tests/bench/*.sh; do echo "== $$bench"; $$bench || missed=1; done; exit $$missed; } | tee build/bench/bench.txt
