# SPDX-License-Identifier: MIT
# Coverage: the unit tests once more, as gcov wants them, with shorter sweeps; run.sh adds up what they reached.
COVERAGE       := build/coverage
COVERAGE_TESTS := $(UNIT_TESTS:build/%=$(COVERAGE)/%)

$(COVERAGE)/%.o: %.c build/unit/lut_table.h
	$(folder)
	$(Q)$(CC) -O0 --coverage -std=c11 -w -MMD -MP -DSWEEP=7 $(UNIT_FLAGS) -c $< -o $@
$(foreach image,$(UNIT_TABLES),$(eval $(COVERAGE)/tests/unit/test_$(image).o: UNIT_FLAGS := -Ibuild/unit/$(image) $(UNIT_FLAGS)))
$(foreach image,$(UNIT_TABLES),$(eval $(COVERAGE)/tests/unit/test_$(image).o: build/unit/$(image)/lut_table.h))
$(COVERAGE)/unity.o: $(UNITY)/unity.c
	$(folder)
	$(Q)$(CC) -O1 -w -c $< -o $@
$(COVERAGE)/liblogic.a: $(LOGIC_SRC:%.c=$(COVERAGE)/%.o)
	$(Q)rm -f $@; ar rcs $@ $^
$(COVERAGE_TESTS): $(COVERAGE)/unit/%: $(COVERAGE)/tests/unit/%.o $(COVERAGE)/unity.o $(COVERAGE)/liblogic.a
	$(folder)
	$(Q)$(CC) --coverage $^ -lm -o $@

# And the instructions that only the chip has: of each controller on each board, the default board first.
COMMA := ,
ASKED_BOARDS   := $(or $(BOARD),$(BOARDS))
COVERED_BOARDS := $(subst $() ,$(COMMA),$(strip $(filter $(DEFAULT_BOARD),$(ASKED_BOARDS)) $(filter-out $(DEFAULT_BOARD),$(ASKED_BOARDS))))
COVERAGE_SUITE := 'tests/coverage/test_coverage.sh $(COVERAGE_TESTS)' \
    'tests/coverage/test_chip_coverage.sh $(COVERED_BOARDS) $(CONTROLLERS) brake_far'

-include $(wildcard $(COVERAGE)/*/*/*.d)
