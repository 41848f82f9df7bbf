# SPDX-License-Identifier: MIT
.PHONY: run-report
run-report: all grid surfaces build/wasm/page.wasm
	@IMAGES='$(IMAGES)' tools/report/report.sh $(or $(BOARD),$(DEFAULT_BOARD))

# The table of each image as numbers.
.PHONY: surfaces
surfaces: all
	@mkdir -p build/surface
	$(Q)$(foreach image,$(ALL_IMAGES),build/fistab table $($(image)_TABLE) $(filter-out --encoding=%,$($(image)_FISTAB)) \
	    --csv=build/surface/$(image).csv -o build/surface/$(image).h;)

# The chip in the page: what of drive a page needs, for WebAssembly, with Debian's wasi-libc. inih has no such
# build, so its header is that of this machine. The warnings are the host build's business.
WASM_SRC := tools/report/wasm/page.c tools/common/hexfile.c tools/drive/identity.c tools/drive/run.c $(wildcard tools/drive/plant/*.c tools/drive/world/*.c) \
    $(filter-out %/canary_image.c %/canary.c %/cpu.c %/s51.c %/vcd.c,$(wildcard tools/drive/sim/*.c)) \
    $(addprefix tools/drive/,scenario/board.c scenario/expect.c scenario/scenario.c scenario/sections.c show/picture.c show/telemetry.c)
WASM_FLAGS := --target=wasm32-wasi -O2 -DIDENTITY_AT=$(IDENTITY_AT) $(filter-out -W%,$(HOST_FLAGS)) $(DRIVE_ROOMS) -idirafter /usr/include
build/wasm/%.o: %.c | build/boards.h build/worlds.h
	$(folder)
	$(Q)clang $(WASM_FLAGS) -c $< -o $@
build/wasm/page.wasm: $(WASM_SRC:%.c=build/wasm/%.o)
	$(Q)clang --target=wasm32-wasi -mexec-model=reactor -Wl,-z,stack-size=262144,--strip-debug $^ -o $@
-include $(wildcard build/wasm/tools/*/*.d build/wasm/tools/*/*/*.d)
