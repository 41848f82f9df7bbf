# SPDX-License-Identifier: MIT
# Tests. Every suite prints PLACE:LINE:NAME:PASS|FAIL lines; tests/run.sh adds them up.
UNITY       := build/deps/unity/src
UNITY_FLAGS := -I$(UNITY) -Itools -Wno-conversion $(DRIVE_ROOMS)

# The unit tests first: others build on them.
include tests/unit/rules.mk $(filter-out tests/unit/rules.mk,$(wildcard tests/*/rules.mk))

# Suites: the tests of the tools; the unit tests on the host and on the chip; the scripts for the chip; the
# drives of each board, law and controller, and the long ones. What takes longest begins first. s51 drives
# the brake on the default board, and what is about s51 says so itself. The fast engine runs all else, unless
# ENGINE names another.
LOOP_FOLDERS := $(patsubst tests/loop/%/,%,$(wildcard tests/loop/*/))
BRAKE_LOOPS  := $(filter $(IMAGES_OF_brake),$(filter $(ALL_IMAGES),$(LOOP_FOLDERS)))
LONG_LOOPS   := long ten_minutes
OTHER_LOOPS  := $(filter-out $(IMAGES_OF_brake) $(LONG_LOOPS),$(LOOP_FOLDERS))
OTHER_BOARDS := $(filter-out $(DEFAULT_BOARD),$(or $(BOARD),$(BOARDS)))
ON_DEFAULT   := $(filter $(DEFAULT_BOARD),$(or $(BOARD),$(BOARDS)))
LAW_BOARD    := $(or $(BOARD),$(DEFAULT_BOARD))
LONG_TESTS   := tests/tools/test_frame_seeds.sh
SHELL_TESTS  := $(filter-out $(LONG_TESTS),$(wildcard tests/tools/test_*.sh tests/chip/test_*.sh))
TEST_SUITES  := $(ON_DEFAULT:%='ENGINE=$(or $(ENGINE),s51) tests/run_loop.sh %') $(COVERAGE_SUITE) \
    $(SHELL_TESTS) $(TOOL_TESTS) $(UNIT_TESTS) $(CHIP_TESTS:%='tests/run_chip.sh %') \
    $(OTHER_BOARDS:%='tests/run_loop.sh %') \
    $(if $(ON_DEFAULT),$(OTHER_LOOPS:%='tests/run_loop.sh $(DEFAULT_BOARD) tests/loop/%')) \
    $(foreach law,$(BRAKE_LOOPS),'APP=$(law) tests/run_loop.sh $(LAW_BOARD) tests/loop/$(law)') \
    'APP=tuned tests/run_loop.sh $(LAW_BOARD) tests/loop/brake' \
    $(if $(filter brake_far,$(BRAKE_LOOPS)),'tests/run_otherwise.sh $(LAW_BOARD) brake_far tests/loop tests/loop/brake tests/loop/tuned tests/loop/long/*_noise.scn') \
    $(patsubst %,'tests/run_loop.sh % tests/loop/long',$(or $(BOARD),$(BOARDS))) \
    'tests/run_loop.sh $(LAW_BOARD) tests/loop/ten_minutes' $(STEPS_SUITES)

# tests/loop/brake holds what befalls the chip, which only the fast engine can do; both laws of the brake drive it.
# brake_far, with the other sensor, takes all these drives, too.
# Slow tests: in s51 what the fast engine runs in `test`, drives with their outcomes compared, the long ones
# on one board; the ten minutes on the other boards; every drive of the brake with the other estimator; all
# drives of `make attack`; the long run of chip against host.
ENGINE_TESTS  = $(shell grep -lE 'build/drive|run_image|lut/run|chip/lib' $(SHELL_TESTS))
LONG_SUITES   = $(LONG_TESTS) 'ATTACK_RUNS=$(ATTACK_RUNS) tests/tools/test_trouble.sh' \
    $(if $(filter brake_far,$(BRAKE_LOOPS)),'tests/run_otherwise.sh $(LAW_BOARD) brake_far $(LONG_LOOPS:%=tests/loop/%)') \
    $(ENGINE_TESTS:%='ENGINE=s51 %') $(CHIP_TESTS:%='ENGINE=s51 tests/run_chip.sh %') \
    $(OTHER_BOARDS:%='tests/compare_engines.sh %') \
    $(if $(ON_DEFAULT),$(patsubst %,'tests/compare_engines.sh $(DEFAULT_BOARD) tests/loop/%',$(OTHER_LOOPS) $(LONG_LOOPS))) \
    $(OTHER_BOARDS:%='ENGINE=fast tests/run_loop.sh % tests/loop/ten_minutes') \
    $(foreach law,$(filter-out brake,$(BRAKE_LOOPS)),'APP=$(law) tests/compare_engines.sh $(LAW_BOARD) tests/loop/$(law)') \
    'IMAGE=build/smooth/brake.ihx tests/compare_engines.sh $(DEFAULT_BOARD)' \
    $(patsubst %,'ENGINE=fast IMAGE=build/smooth/brake.ihx tests/run_loop.sh $(DEFAULT_BOARD) tests/loop/%',$(LONG_LOOPS)) $(STEPS_LONG_SUITES)

# `make unit TEST=NAME` runs one file, tests/unit/test_NAME.c or tests/tools/test_NAME.c; without TEST
# those of tests/unit.
ifneq ($(and $(TEST),$(filter %unit %unit-chip,$(MAKECMDGOALS))),)
ifeq ($(filter %/test_$(TEST),$(UNIT_TESTS) $(TOOL_TESTS)),)
$(error no test '$(TEST)'; the tests are: $(patsubst test_%,%,$(notdir $(UNIT_TESTS) $(TOOL_TESTS))))
endif
endif
WANTED_UNITS := $(if $(TEST),$(filter %/test_$(TEST),$(UNIT_TESTS) $(TOOL_TESTS)),$(UNIT_TESTS))
WANTED_CHIPS := $(if $(TEST),$(filter %/test_$(TEST).ihx,$(CHIP_TESTS)),$(CHIP_TESTS))
.PHONY: run-unit run-unit-chip
run-unit: $(WANTED_UNITS)
	@tests/run.sh $^
run-unit-chip: $(WANTED_CHIPS) $(FAST_CHIPS)
	$(if $(WANTED_CHIPS),,$(error test '$(TEST)' is not one of the chip's; these are: $(patsubst test_%.ihx,%,$(notdir $(CHIP_TESTS)))))
	@tests/run.sh $(WANTED_CHIPS:%='tests/run_chip.sh %')

.PHONY: test-build run-test run-test-long
test-build: all grid surfaces $(TOOL_TESTS) $(UNIT_TESTS) $(CHIP_TESTS) $(LUT_IMAGES) $(FAST_CHIPS) $(BENCH_LINES) compiler-build build/wasm/page.wasm $(COVERAGE_TESTS)
run-test:
	@$(MAKE) -j$$(nproc) test-build
	@ENGINE=$(or $(ENGINE),fast) tests/run.sh $(TEST_SUITES)
run-test-long:
	@$(MAKE) -j$$(nproc) test-build compiler-build-all
	@$(MAKE) BOARD=$(DEFAULT_BOARD) ESTIMATOR=smooth OUT=build/smooth build/smooth/brake.ihx
	@tests/run.sh $(LONG_SUITES)
	@tools/deps.sh mutants
	@$(MAKE) run-mutants
