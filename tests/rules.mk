# Tests. Every suite prints PLACE:LINE:NAME:PASS|FAIL lines; tests/run.sh adds them up.
UNITY       := build/deps/unity/src
UNITY_FLAGS := -I$(UNITY) -Itools -Wno-conversion $(DRIVE_ROOMS)

include $(wildcard tests/*/rules.mk)

# Suites: the tests of the tools; the unit tests on the host and on the chip; the scripts for the chip;
# the brake's drives on each board, and on the default board those of the brake's other laws.
LOOP_FOLDERS := $(patsubst tests/loop/%/,%,$(wildcard tests/loop/*/))
BRAKE_LOOPS  := $(filter $(IMAGES_OF_brake),$(LOOP_FOLDERS))
OTHER_LOOPS  := $(filter-out $(IMAGES_OF_brake) long,$(LOOP_FOLDERS))
LONG_TESTS   := tests/tools/test_frame_seeds.sh
TEST_SUITES  := $(TOOL_TESTS) $(filter-out $(LONG_TESTS),$(wildcard tests/tools/test_*.sh)) $(UNIT_TESTS) \
    $(CHIP_TESTS:%='tests/run_chip.sh %') $(wildcard tests/chip/test_*.sh) \
    $(patsubst %,'tests/run_loop.sh %',$(or $(BOARD),$(BOARDS))) \
    $(foreach law,$(BRAKE_LOOPS),'APP=$(law) tests/run_loop.sh $(or $(BOARD),$(DEFAULT_BOARD)) tests/loop/$(law)')

# Slow tests: the drives of the other controllers, on the default board; ten simulated minutes on each
# board; every drive of the brake with the other estimator.
LONG_SUITES := $(LONG_TESTS) \
    $(if $(filter-out $(DEFAULT_BOARD),$(BOARD)),,$(OTHER_LOOPS:%='tests/run_loop.sh $(DEFAULT_BOARD) tests/loop/%')) \
    $(patsubst %,'tests/run_loop.sh % tests/loop/long',$(or $(BOARD),$(BOARDS))) \
    'IMAGE=build/smooth/brake.ihx tests/run_loop.sh $(DEFAULT_BOARD)'

.PHONY: run-test run-test-long
run-test: all grid $(TOOL_TESTS) $(UNIT_TESTS) $(CHIP_TESTS) $(LUT_IMAGES)
	@tests/run.sh $(TEST_SUITES)
run-test-long: all
	@$(MAKE) BOARD=$(DEFAULT_BOARD) ESTIMATOR=smooth OUT=build/smooth build/smooth/brake.ihx
	@tests/run.sh $(LONG_SUITES)
