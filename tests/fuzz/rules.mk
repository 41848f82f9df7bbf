# SPDX-License-Identifier: MIT
# Fuzzing for FUZZ_SECONDS in all: a third for fistab (readers, checks, inference, writers), a third for the
# readers of images, listings, scenarios, dumps and serial lines, a sixth for command lines, a sixth for the fast
# simulator, which gets any code.
FUZZ_CC := clang -g -O1 -std=c11 -D_GNU_SOURCE -Itools/common -Itools -Ibuild -DFUZZY51_VERSION='"$(VERSION)"' \
    -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all
FUZZ_RUN := -timeout=120 -close_fd_mask=2 -print_final_stats=1 -artifact_prefix=build/fuzz/
FUZZ_FIS_SRC     := tests/fuzz/fuzz_fis.c $(filter-out %/main.c,$(fistab_SRC))
FUZZ_READERS_SRC := tests/fuzz/fuzz_readers.c $(filter-out %/main.c,$(sort $(drive_SRC) $(bound_SRC)))
build/fuzz/fuzz_fis: $(FUZZ_FIS_SRC) $(wildcard tools/*/*.h)
	$(folder)
	$(Q)$(FUZZ_CC) $(FUZZ_FIS_SRC) -lm -o $@
build/fuzz/fuzz_readers: $(FUZZ_READERS_SRC) $(wildcard tools/*/*.h tools/*/*/*.h) | build/boards.h build/worlds.h
	$(folder)
	$(Q)$(FUZZ_CC) $(DRIVE_ROOMS) -DIDENTITY_AT=$(IDENTITY_AT) $(FUZZ_READERS_SRC) $(drive_LIBS) -o $@
FUZZ_MCS52_SRC := tests/fuzz/fuzz_mcs52.c $(wildcard tools/drive/sim/mcs52*.c)
build/fuzz/fuzz_mcs52: $(FUZZ_MCS52_SRC) $(wildcard tools/drive/sim/mcs52*.h)
	$(folder)
	$(Q)$(FUZZ_CC) -Itools/drive/sim $(FUZZ_MCS52_SRC) -lm -o $@
.PHONY: run-fuzz
run-fuzz: tools build/fuzz/fuzz_fis build/fuzz/fuzz_readers build/fuzz/fuzz_mcs52
	@mkdir -p build/fuzz/corpus build/fuzz/readers build/fuzz/mcs52
	@tests/fuzz/readers.sh build/fuzz/readers_first
	@tests/fuzz/command_lines.sh $$(($(FUZZ_SECONDS) / 6))
	@build/fuzz/fuzz_readers $(FUZZ_RUN) -max_total_time=$$(($(FUZZ_SECONDS) / 3)) -max_len=16384 \
	    build/fuzz/readers build/fuzz/readers_first $(wildcard tests/fuzz/readers)
	@build/fuzz/fuzz_fis $(FUZZ_RUN) -max_total_time=$$(($(FUZZ_SECONDS) / 3)) -dict=tests/fuzz/fis.dict -max_len=4096 \
	    build/fuzz/corpus tests/fuzz/corpus tests/good tests/bad tests/golden tables
	@build/fuzz/fuzz_mcs52 $(FUZZ_RUN) -max_total_time=$$(($(FUZZ_SECONDS) / 6)) -max_len=4096 build/fuzz/mcs52
