# SPDX-License-Identifier: MIT
# Fuzzing of fistab: reader, checks, inference and writers, from tests/fuzz/corpus and all our systems.
FUZZ_SRC := tests/fuzz/fuzz_fis.c $(filter-out %/main.c,$(fistab_SRC))
build/fuzz/fuzz_fis: $(FUZZ_SRC) $(wildcard tools/*/*.h)
	@mkdir -p $(@D)
	$(Q)clang -g -O1 -std=c11 -D_GNU_SOURCE -Itools/common -Itools -DFUZZY51_VERSION='"$(VERSION)"' -fsanitize=fuzzer,address,undefined \
	    -fno-sanitize-recover=all $(FUZZ_SRC) -lm -o $@
.PHONY: run-fuzz
run-fuzz: build/fuzz/fuzz_fis
	@mkdir -p build/fuzz/corpus
	@build/fuzz/fuzz_fis -dict=tests/fuzz/fis.dict -max_total_time=$(FUZZ_SECONDS) -timeout=60 -max_len=4096 \
	    -close_fd_mask=2 -print_final_stats=1 -artifact_prefix=build/fuzz/ \
	    build/fuzz/corpus tests/fuzz/corpus tests/good tests/bad tests/golden tables
