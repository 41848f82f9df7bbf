# SPDX-License-Identifier: MIT
# Mutants: the unit tests, linked with the firmware and all its mutants (mutate.c); run.c judges each.
LLVM       := $(patsubst %/include/clang-c/Index.h,%,$(lastword $(wildcard /usr/lib/llvm-*/include/clang-c/Index.h)))
MUTANT_DIR := build/mutants

# Where mutants are made.
MUTANT_ROOMS := firmware/brake/:firmware/frames/:firmware/lib/

$(MUTANT_DIR)/mutate: tests/mutants/mutate.c
	@mkdir -p $(@D)
	$(Q)$(CC) -O2 $(HOST_FLAGS) -isystem $(LLVM)/include $< -L$(LLVM)/lib -Wl,-rpath,$(LLVM)/lib -lclang -o $@
$(MUTANT_DIR)/run: tests/mutants/run.c
	@mkdir -p $(@D)
	$(Q)$(CC) -O2 $(HOST_FLAGS) $< -o $@
$(MUTANT_DIR)/mutant.o: tests/mutants/mutant.c
	@mkdir -p $(@D)
	$(Q)$(CC) -O2 $(HOST_FLAGS) -c $< -o $@

# Undefined behaviour ends a program, so that it finds a mutant; what has no value gets an odd one.
MUTANT_C     := clang -std=gnu11 -D_GNU_SOURCE -w -ftrivial-auto-var-init=pattern
MUTANT_TRAPS := -fsanitize=undefined -fsanitize-trap=undefined

# The unit tests and what they are linked of.
MUTANT_UNITS := $(UNIT_TESTS:build/%=$(MUTANT_DIR)/tests/%)
MUTANT_I     := $(patsubst %.c,$(MUTANT_DIR)/%.i,$(LOGIC_SRC) $(UNIT_TESTS:build/%=tests/%.c))
$(MUTANT_DIR)/%.i: %.c build/unit/lut_table.h
	@mkdir -p $(@D)
	$(Q)$(MUTANT_C) -E -MMD -MP $(UNIT_FLAGS) $< -o $@
$(foreach image,$(UNIT_TABLES),$(eval $(MUTANT_DIR)/tests/unit/test_$(image).i: UNIT_FLAGS := -Ibuild/unit/$(image) $(UNIT_FLAGS)))
$(foreach image,$(UNIT_TABLES),$(eval $(MUTANT_DIR)/tests/unit/test_$(image).i: build/unit/$(image)/lut_table.h))

$(MUTANT_DIR)/list: $(MUTANT_DIR)/mutate $(MUTANT_I)
	$(Q)$< $@ $(MUTANT_ROOMS) $(foreach file,$(MUTANT_I),$(file) $(file:%.i=%.mutants.c))
$(MUTANT_I:%.i=%.mutants.c): $(MUTANT_DIR)/list ;
$(MUTANT_I:%.i=%.o): %.o: %.mutants.c tests/mutants/mutant.h
	$(Q)$(MUTANT_C) -O2 -I. $(MUTANT_TRAPS) -c $< -o $@
$(MUTANT_DIR)/unity.o: $(UNITY)/unity.c
	@mkdir -p $(@D)
	$(Q)$(CC) -O2 -w -c $< -o $@
$(MUTANT_DIR)/logic.a: $(LOGIC_SRC:%.c=$(MUTANT_DIR)/%.o)
	$(Q)rm -f $@; ar rcs $@ $^
# Unity jumps out of a case that fails; here that ends the program (mutant.c).
$(MUTANT_UNITS): %: %.o $(MUTANT_DIR)/unity.o $(MUTANT_DIR)/logic.a $(MUTANT_DIR)/mutant.o
	$(Q)$(CC) -Wl,--wrap=longjmp $^ -lm -o $@

.PHONY: run-mutants
run-mutants:
	@$(MAKE) -j$$(nproc) $(MUTANT_DIR)/run $(MUTANT_UNITS)
	@$(MUTANT_DIR)/run $(if $(MUTANTS),--only='$(MUTANTS)') $(MUTANT_DIR)/list tests/mutants/equivalent.txt $(MUTANT_UNITS)

-include $(wildcard $(MUTANT_DIR)/*/*/*.d)
