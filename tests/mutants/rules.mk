# SPDX-License-Identifier: MIT
# Mutants: tests, linked with all mutants of what they test (mutate.c); run.c judges each. A room is what one
# list of mutants is made of: the firmware's logic, and each part of the tools that judges the firmware.
LLVM       := $(patsubst %/include/clang-c/Index.h,%,$(lastword $(wildcard /usr/lib/llvm-*/include/clang-c/Index.h)))
MUTANT_DIR := build/mutants

$(MUTANT_DIR)/mutate: tests/mutants/mutate.c
	$(folder)
	$(Q)$(CC) -O2 $(HOST_FLAGS) -isystem $(LLVM)/include $< -L$(LLVM)/lib -Wl,-rpath,$(LLVM)/lib -lclang -o $@
$(MUTANT_DIR)/run: tests/mutants/run.c
	$(folder)
	$(Q)$(CC) -O2 $(HOST_FLAGS) $< -o $@
$(MUTANT_DIR)/mutant.o: tests/mutants/mutant.c
	$(folder)
	$(Q)$(CC) -O2 $(HOST_FLAGS) $(UNITY_FLAGS) -c $< -o $@
$(MUTANT_DIR)/unity.o: $(UNITY)/unity.c
	$(folder)
	$(Q)$(CC) -O2 -w -c $< -o $@

# Undefined behaviour ends a program, so that it finds a mutant; what has no value gets an odd one. Sweeps
# take each seventh step (tests/unit/sweep.h): they find as many mutants, and one that survives takes less time.
MUTANT_C     := clang -std=gnu11 -D_GNU_SOURCE -DSWEEP=7 -w -ftrivial-auto-var-init=pattern
MUTANT_TRAPS := -fsanitize=undefined -fsanitize-trap=undefined
# Unity jumps out of a case that fails; here that ends the program (mutant.c).
MUTANT_LINK  := $(CC) -Wl,--wrap=longjmp,--wrap=UnityDefaultTestRun

# The firmware. A unit test may include a file of the firmware as source, so mutants are in the tests' objects, too.
MUTANT_ROOMS := firmware
firmware_PLACES   := firmware/lib/ firmware/frames/ $(CONTROLLERS:%=firmware/%/)
firmware_FILES    := $(LOGIC_SRC) $(UNIT_TESTS:build/%=tests/%.c)
firmware_PROGRAMS := $(UNIT_TESTS:build/%=$(MUTANT_DIR)/firmware/%)

# The tools: their files without the tables of a scenario's keys, and their tests, which are those that include one
# of their headers, where there is nothing else said.
sensors_FILES      := $(addprefix tools/drive/plant/,head.c sensor.c sonar.c tfluna.c)
plants_FILES       := $(filter-out %_keys.c $(sensors_FILES),$(wildcard tools/drive/plant/*.c))
expectations_FILES := $(addprefix tools/drive/,scenario/expect.c world/pace.c world/rig.c)
bound_FILES        := $(filter-out %/main.c,$(wildcard tools/bound/*.c))
bound_TESTS        := $(filter-out %_runs.c,$(wildcard tests/tools/test_bound*.c))
bound_NEEDS        := firmware-$(DEFAULT_BOARD)# its listings
mcs52_FILES        := $(wildcard tools/drive/sim/mcs52*.c)
mcs52_TESTS        := $(wildcard tests/tools/test_mcs52*.c)
# Where there are many thousands of mutants, so many percent of them, drawn by chance.
bound_SHARE        := 20
mcs52_SHARE        := 12
TOOL_ROOMS         := plants sensors expectations bound mcs52
MUTANT_ROOMS       += $(TOOL_ROOMS)

define tool_room
$(1)_PLACES   := $$($(1)_FILES:%.c=%.)
$(1)_TESTS    ?= $$(shell grep -lE '"(.*/)?($$(subst $$() ,|,$$(notdir $$(basename $$($(1)_FILES)))))\.h"' tests/tools/test_*.c)
$(1)_PROGRAMS := $$($(1)_TESTS:%.c=$(MUTANT_DIR)/$(1)/%)
$(MUTANT_DIR)/$(1)/%.i: MUTANT_FLAGS := $$(TOOL_MUTANT_FLAGS)
$$($(1)_PROGRAMS): $(MUTANT_DIR)/$(1)/%: $(MUTANT_DIR)/plain/%.o $$($(1)_FILES:%.c=$(MUTANT_DIR)/$(1)/%.o) $(MUTANT_DIR)/plain/tools.a
endef
TOOL_MUTANT_FLAGS = $(filter -I% -D%,$(HOST_FLAGS)) -I$(UNITY) -Itools $(DRIVE_ROOMS) -Ifirmware/lib -Ifirmware/frames -DIDENTITY_AT=$(IDENTITY_AT)
$(foreach room,$(TOOL_ROOMS),$(eval $(call tool_room,$(room))))
$(MUTANT_DIR)/plain/%.o: %.c | build/boards.h build/worlds.h
	$(folder)
	$(Q)$(MUTANT_C) -O1 -MMD -MP $(TOOL_MUTANT_FLAGS) $(MUTANT_TRAPS) -c $< -o $@
MUTANT_PLAIN := $(filter-out %/main.c,$(COMMON_SRC) $(foreach tool,drive bound,$(filter tools/$(tool)/%,$($(tool)_SRC))))
$(MUTANT_DIR)/plain/tools.a: $(MUTANT_PLAIN:%.c=$(MUTANT_DIR)/plain/%.o)
	$(Q)rm -f $@; ar rcs $@ $^

define mutant_room
$(MUTANT_DIR)/$(1)/%.i: %.c build/unit/lut_table.h | build/boards.h build/worlds.h
	$$(folder)
	$$(Q)$(MUTANT_C) -E -MMD -MP $$(MUTANT_FLAGS) $$< -o $$@
$(MUTANT_DIR)/$(1)/list: $(MUTANT_DIR)/mutate $$($(1)_FILES:%.c=$(MUTANT_DIR)/$(1)/%.i)
	$$(Q)$$< $$@ $$(subst $$() ,:,$$($(1)_PLACES)) $$(foreach file,$$(filter %.i,$$^),$$(file) $$(file:%.i=%.mutants.c))
$$($(1)_FILES:%.c=$(MUTANT_DIR)/$(1)/%.mutants.c): $(MUTANT_DIR)/$(1)/list ;
$$($(1)_FILES:%.c=$(MUTANT_DIR)/$(1)/%.o): %.o: %.mutants.c tests/mutants/mutant.h
	$$(Q)$(MUTANT_C) -O1 -I. $(MUTANT_TRAPS) -c $$< -o $$@
$$($(1)_PROGRAMS): $(MUTANT_DIR)/unity.o $(MUTANT_DIR)/mutant.o
	$$(folder)
	$$(Q)$(MUTANT_LINK) $$^ $(drive_LIBS) -o $$@
.PHONY: run-mutants-$(1)
run-mutants-$(1): $(MUTANT_DIR)/run $$($(1)_PROGRAMS) $$($(1)_NEEDS)
	@mkdir -p build/tests
	@$(MUTANT_DIR)/run $(if $(filter-out $(MUTANT_ROOMS),$(MUTANTS)),--only='$(MUTANTS)',--share=$(or $($(1)_SHARE),100)) $(1) $(MUTANT_DIR)/$(1)/list \
	    tests/mutants/survivors/$(1).txt $$($(1)_PROGRAMS)
endef
$(foreach room,$(MUTANT_ROOMS),$(eval $(call mutant_room,$(room))))

$(MUTANT_DIR)/firmware/%.i: MUTANT_FLAGS := $(UNIT_FLAGS)
$(foreach image,$(UNIT_TABLES),$(eval $(MUTANT_DIR)/firmware/tests/unit/test_$(image).i: MUTANT_FLAGS := -Ibuild/unit/$(image) $(UNIT_FLAGS)))
$(foreach image,$(UNIT_TABLES),$(eval $(MUTANT_DIR)/firmware/tests/unit/test_$(image).i: build/unit/$(image)/lut_table.h))
$(MUTANT_DIR)/firmware/logic.a: $(LOGIC_SRC:%.c=$(MUTANT_DIR)/firmware/%.o)
	$(Q)rm -f $@; ar rcs $@ $^
$(firmware_PROGRAMS): $(MUTANT_DIR)/firmware/unit/%: $(MUTANT_DIR)/firmware/tests/unit/%.o $(MUTANT_DIR)/firmware/logic.a

# MUTANTS may name a room.
.PHONY: run-mutants
run-mutants:
	@status=0; for room in $(or $(filter $(MUTANT_ROOMS),$(MUTANTS)),$(MUTANT_ROOMS)); do \
	    $(MAKE) -j$$(nproc) run-mutants-$$room || status=1; \
	done; exit $$status

-include $(wildcard $(MUTANT_DIR)/*/*/*/*.d $(MUTANT_DIR)/*/*/*/*/*.d)
