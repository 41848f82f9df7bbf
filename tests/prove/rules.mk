# SPDX-License-Identifier: MIT
# Proofs by Frama-C: `make prove`. The units are tests/prove/wp_*.c, eva_*.c and tried.c; prove.sh says what each
# kind is. Each controller is proved with the table that it ships with.
PROVE_TABLES := $(CONTROLLERS:%=build/prove/%/lut_table.h)
define prove_table
build/prove/$(1)/lut_table.h: $$($(1)_TABLE) build/fistab
	@mkdir -p $$(@D)
	$$(Q)build/fistab table $$< --name=lut $(filter-out --encoding=%,$($(1)_FISTAB)) -o $$@
endef
$(foreach name,$(CONTROLLERS),$(eval $(call prove_table,$(name))))

build/prove/tried: tests/prove/tried.c $(wildcard firmware/lib/*.[ch])
	@mkdir -p $(@D)
	$(Q)$(CC) -O3 -flto -std=c11 -Wall -Wextra -Werror -Ifirmware/lib $< firmware/lib/fixed.c firmware/lib/mul_u16.c -o $@

.PHONY: run-prove
run-prove: $(PROVE_TABLES) build/prove/tried
	@tests/prove/prove.sh

.PHONY: run-test-prove
run-test-prove: $(PROVE_TABLES)
	@tests/prove/test_prove.sh
