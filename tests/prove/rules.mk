# SPDX-License-Identifier: MIT
# Proofs by Frama-C: `make prove`. The units are tests/prove/wp_*.c, eva_*.c and tried.c; prove.sh says what each
# kind is. Each controller is proved with the table that it ships with, the brake with
# that of the tuned law, too.
PROVE_TABLES := $(patsubst %,build/prove/%/lut_table.h,$(CONTROLLERS) tuned)
define prove_table
build/prove/$(1)/lut_table.h: $$($(1)_TABLE) build/fistab
	@mkdir -p $$(@D)
	$$(Q)build/fistab table $$< --name=lut $(filter-out --encoding=%,$($(1)_FISTAB)) -o $$@
endef
$(foreach name,$(CONTROLLERS) tuned,$(eval $(call prove_table,$(name))))

build/prove/tried: tests/prove/tried.c build/prove/brake/lut_table.h $(wildcard firmware/lib/*.[ch] firmware/brake/cell.[ch])
	@mkdir -p $(@D)
	$(Q)$(CC) -O3 -flto -std=c11 -Wall -Wextra -Werror -Ifirmware/lib -Ifirmware/brake -Ibuild/prove/brake $< $(addprefix firmware/,lib/fixed.c lib/mul_u16.c lib/lut.c brake/cell.c) -o $@

.PHONY: run-prove
run-prove: $(PROVE_TABLES) build/prove/tried
	@tests/prove/prove.sh

.PHONY: run-test-prove
run-test-prove: $(PROVE_TABLES)
	@tests/prove/test_prove.sh
