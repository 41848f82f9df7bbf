# fuzzy51: see `make help`, README.md and, for one board, firmware/boards/.

# --- knobs ------------------------------------------------------------------------------------
BOARD    ?=#                   one board of firmware/boards; empty: all of them
APP      ?= brake#             what flash writes
PORT     ?=#                   where the flasher finds the chip
TABLE    ?= tables/brake.fis#  the brake's fuzzy system
ESTIMATOR ?= difference#       what gives the brake its closing speed: difference or smooth
V        ?=#                   V=1 prints each command
FUZZ_SECONDS ?= 600#           how long `make fuzz` looks for trouble
UNITY_DIR ?=#                  a checkout of Unity in place of Debian's copy
CFLAGS   ?= -O2 -g

# --- the rest ---------------------------------------------------------------------------------
MAKEFLAGS += --no-builtin-rules --no-print-directory
SHELL     := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.SECONDARY:
.DEFAULT_GOAL := all
Q := $(if $(V),,@)
export UNITY_DIR

ifeq ($(wildcard $(TABLE)),)
$(error no file '$(TABLE)'; TABLE names the brake's fuzzy system, a .fis)
endif
ifeq ($(filter $(ESTIMATOR),difference smooth),)
$(error no estimator '$(ESTIMATOR)'; use difference or smooth)
endif

BOARDS := $(sort $(basename $(notdir $(wildcard firmware/boards/*.mk))))
ifneq ($(BOARD),)
ifeq ($(filter $(BOARD),$(BOARDS)),)
$(error no board '$(BOARD)'; the boards are: $(BOARDS))
endif
endif

.PHONY: all tools firmware format demo bench report test test-long help clean deps
all: tools firmware

help:
	@echo "make                 tools and firmware of all boards, with the memory each takes"
	@echo "make BOARD=NAME      one board: $(BOARDS)"
	@echo "make TABLE=FILE.fis  the brake with a table of your own; ESTIMATOR=smooth with the other closing speed"
	@echo "make demo            a car stops behind another one, with the real firmware in the simulator"
	@echo "make report          every controller on every scenario, as build/report/index.html; knobs: BOARD, JOBS,"
	@echo "                     MAP=coarse|normal|fine, ONLY='GLOB...', IMAGES='APP...', SSHLOGIN=host1,host2,: (GNU parallel)"
	@echo "make test            the tests; ends with 'N passed, N failed'"
	@echo "make test-long       the other controllers' drives, ten minutes at the stop line, all with the smooth estimator"
	@echo "make flash BOARD=NAME PORT=DEVICE   writes APP=$(strip $(APP)) to a chip"
	@echo "make bench           cycles, bytes and stack of each app; the estimators in the loop; fistab beside fuzzylite;"
	@echo "                     drive beside free s51"
	@echo "make fuzz            feeds fistab with ever odder files for FUZZ_SECONDS=$(FUZZ_SECONDS)"
	@echo "make format          lays out all C by .clang-format"
	@echo "make deps            installs what the build needs"
	@echo "make clean           removes build/"

deps:
	@tools/deps.sh build

clean:
	$(Q)rm -rf build

# The one style of all C: .clang-format.
format:
	@tools/deps.sh format
	$(Q)clang-format-19 -i $$(git ls-files '*.c' '*.h')

# --- host tools -------------------------------------------------------------------------------
HOST_FLAGS := -std=c11 -D_GNU_SOURCE -Wall -Wextra -Wconversion -Wshadow -Wstrict-prototypes -Werror -MMD -Itools/common -Ibuild
SANITIZE   := -fsanitize=address,undefined -fno-sanitize-recover=all

COMMON_SRC := $(wildcard tools/common/*.c)
FISTAB_SRC := $(wildcard tools/fistab/*.c) $(COMMON_SRC)
DRIVE_SRC  := $(wildcard tools/drive/*.c) $(COMMON_SRC)
DRIVE_LIBS := -linih -lcjson

BOUND_SRC  := $(wildcard tools/bound/*.c) $(COMMON_SRC)

tools: build/fistab build/drive build/bound build/canary.ihx

build/fistab: $(FISTAB_SRC:%.c=build/host/%.o)
	$(Q)$(CC) $(CFLAGS) $^ -lm -o $@
build/bound: $(BOUND_SRC:%.c=build/host/%.o)
	$(Q)$(CC) $(CFLAGS) $^ -o $@
build/drive: $(DRIVE_SRC:%.c=build/host/%.o)
	$(Q)$(CC) $(CFLAGS) $^ $(DRIVE_LIBS) -lm -o $@
# The laboratory: drive's world around control logic on the host, each law in a shared object.
LAB_SRC    := $(filter-out %/lut.c,$(wildcard tools/lab/*.c)) \
    $(filter-out %/main.c,$(FISTAB_SRC) $(filter tools/drive/%,$(DRIVE_SRC)))
LAB_IMAGES := $(patsubst %,build/lab-images/%.so,brake tuned classic first none)
tools: build/lab $(LAB_IMAGES)
build/lab: $(LAB_SRC:%.c=build/host/%.o)
	$(Q)$(CC) $(CFLAGS) $^ $(DRIVE_LIBS) -ldl -lm -o $@
build/host/tools/lab/%.o: HOST_FLAGS += -Itools/drive -Itools/fistab
# The image that drive runs to see whether a simulator keeps time.
build/canary.ihx: tools/drive/canary/image.c
	@mkdir -p build/canary
	$(Q)sdcc -mmcs51 --std-c11 --Werror $< -o build/canary/canary.ihx
	$(Q)mv build/canary/canary.ihx $@
build/host/%.o: %.c | build/boards.h
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(HOST_FLAGS) -c $< -o $@
build/sanitized/%.o: %.c | build/boards.h
	@mkdir -p $(@D)
	$(Q)$(CC) -g -O1 $(SANITIZE) $(HOST_FLAGS) -c $< -o $@

# What drive must know of a board, taken from the fragment that builds its firmware; the pins in
# the order of enum board_pin.
DRIVE_PINS := PWM STOP TRIGGER LAMP BUZZER SERVO CUT LANE ECHO OVERRIDE
build/boards.h: Makefile firmware/boards $(wildcard firmware/boards/*.mk)
	@mkdir -p $(@D)
	$(Q)for board in $(filter %.mk,$^); do \
	    awk -v name="$$(basename $$board .mk)" -v pins="$(DRIVE_PINS)" '$$2 == ":=" { value[$$1] = $$3 } \
	        function of(key) { if (key in value) return value[key]; \
	            print FILENAME ": error: a board states " key " := ..., as the others do" >"/dev/stderr"; exit 1 } \
	        END { printf "BOARD(%s, %s, \"%s\"", name, of("CLK_HZ"), of("S51_TYPE"); count = split(pins, pin, " "); \
	        for (i = 1; i <= count; i++) printf ", %s", of("PIN_" pin[i]); print ")" }' $$board; \
	done >$@.part; mv $@.part $@

# --- controllers ------------------------------------------------------------------------------
# Of each: its table, how fistab makes that (not said: as the board encodes it), SDCC's flags, and its
# modules, the one with main first, as SDCC's manual asks.
ANY_MODULES   := $(addprefix core/,fixed lamp lut selftest telemetry) $(addprefix mcu/,start pwm baud)
FRAME_MODULES := apps/frames $(ANY_MODULES) core/frame core/link mcu/head
# The functions of such a program whose time its .bound tells: one control step, from what came in to the
# pins, and the other jobs of a round of the brake.
BOUND_CYCLES = $(if $(filter apps/brake,$($(1)_MODULES)),control_step talk listen advance_clock brake_tick hal_stack_is_good apply show,take_frame)

brake_TABLE   := $(TABLE)
BRAKE_MODULES := apps/brake $(ANY_MODULES) $(addprefix core/,brake closing range) mcu/echo mcu/uart
brake_MODULES := $(BRAKE_MODULES) core/law_fuzzy core/cell

# The same car under another law (firmware/core/law.h), to compare with. All carry a table, so that all
# boot alike; only tuned looks into it.
LAWS          := tuned classic first none
tuned_TABLE   := tables/brake_tuned.fis
tuned_FLAGS   := -DESTIMATOR_smooth
tuned_MODULES := $(BRAKE_MODULES) core/law_tuned core/cell core/ease
none_FLAGS    := -DBRAKE_STOP_MM=0U -UFAULT_PCT -DFAULT_PCT=0
$(foreach law,classic first none,$(eval $(law)_TABLE := $(TABLE))$(eval $(law)_MODULES := $(BRAKE_MODULES) core/law_$(law)))

radar_TABLE := tables/radar.fis
radar_GRID  := --grid=13x13 --samples=7 --levels=240 --half-down
radar_MODULES := $(FRAME_MODULES) apps/radar $(addprefix core/,radar fmcw lane safe mul_u16)

# The same with the mean of maxima, for comparison: it misses the second published case.
radar_mom_TABLE   := build/radar_mom.fis
radar_mom_GRID    := $(radar_GRID)
radar_mom_MODULES := $(radar_MODULES)
build/radar_mom.fis: tables/radar.fis
	@mkdir -p $(@D)
	$(Q)sed "s/^Name=.*/Name='radar_mom'/; s/'centroid'/'mom'/" $< >$@

park_TABLE  := tables/park.fis
park_GRID   := --grid=256 --levels=255
park_FLAGS  := -DSERVO
park_MODULES := $(FRAME_MODULES) apps/park $(addprefix core/,park cordic) mcu/servo

# The same, blended at 2..4 m in place of the published 3..7 m: of make grid's 3,780 starts 8 more succeed,
# but no longer all from 20 m on.
park_late_TABLE   := tables/park_late.fis
park_late_GRID    := $(park_GRID)
park_late_FLAGS   := $(park_FLAGS)
park_late_MODULES := $(park_MODULES)

gap_TABLE   := tables/gap.fis
gap_GRID    := --nodes --grid=33x33 --levels=200
gap_FLAGS   := -DSERVO
gap_MODULES := $(FRAME_MODULES) apps/gap core/gap core/mul_u16 mcu/servo

follow_TABLE := tables/follow.fis
follow_GRID  := --grid=5x3x3 --levels=4
follow_FLAGS := -DSERVO
follow_MODULES := $(FRAME_MODULES) apps/follow core/follow mcu/servo

# The same with the rules as published, for comparison: most approaches end in contact.
follow_paper_TABLE := tables/follow_paper.fis
follow_paper_GRID  := $(follow_GRID)
follow_paper_FLAGS := $(follow_FLAGS) -DFOLLOW_AS_PUBLISHED
follow_paper_MODULES := $(follow_MODULES)

LAB_CORE := $(addprefix firmware/core/,brake closing range fixed)
define lab_image
build/lab-images/$(1)/lut_table.h: $$($(1)_TABLE) build/fistab
	@mkdir -p $$(@D)
	$$(Q)build/fistab table $$< --name=lut -o $$@
build/lab-images/$(1).so: tools/lab/lut.c $(LAB_CORE:%=%.c) $(patsubst %,%.c,$(filter firmware/core/law_% firmware/core/cell firmware/core/ease,$($(1)_MODULES:%=firmware/%))) $(wildcard firmware/core/*.h) build/lab-images/$(1)/lut_table.h
	$$(Q)$$(CC) -O2 -g -std=c11 -fPIC -shared -DCLK_HZ=12000000UL -DFAULT_PCT=60 $($(1)_FLAGS) -Ifirmware/core \
	    -Ibuild/lab-images/$(1) $$(filter %.c,$$^) -o $$@
endef
$(foreach law,brake $(LAWS),$(eval $(call lab_image,$(law))))

SDCC := sdcc -mmcs51 --std-c11 --model-small --Werror

# --- firmware: one board in this make, or one make a board ------------------------------------
ifeq ($(BOARD),)
.PHONY: flash $(BOARDS:%=firmware-%)
flash:
	$(error say which board: make flash BOARD=NAME PORT=DEVICE; the boards are: $(BOARDS))
firmware: $(BOARDS:%=firmware-%)
$(BOARDS:%=firmware-%): firmware-%: build/fistab
	@$(MAKE) BOARD=$* firmware
else
include firmware/boards/$(BOARD).mk
OUT := build/$(BOARD)

SDCC_FLAGS := --i-code-in-asm -DCLK_HZ=$(CLK_HZ)UL -DWATCHDOG_$(WATCHDOG) -DESTIMATOR_$(ESTIMATOR) -DFAULT_PCT=$(FAULT_PCT) -DBOARD_NAME='"$(BOARD)"' \
    $(foreach pin,$(DRIVE_PINS),-DPIN_$(pin)=$(PIN_$(pin)))
SDCC_LINK  := --code-size $(CODE_BYTES) --iram-size $(IRAM_BYTES) --xram-size 0

.PHONY: firmware
firmware: $(APPS:%=$(OUT)/%.hex)
	@for app in $(APPS); do tools/memory.sh $(BOARD) $$app; done

define app_rules
$(OUT)/$(1)/lut_table.h: $$($(1)_TABLE) build/fistab $(OUT)/board.stamp
	@mkdir -p $$(@D)
	$$(Q)build/fistab table $$< --name=lut $(or $($(1)_GRID),--encoding=$(ENCODING)) -o $$@
$(OUT)/$(1)/%.rel: firmware/%.c $(OUT)/$(1)/lut_table.h $(OUT)/board.stamp
	@mkdir -p $$(@D)
	$$(Q)$(SDCC) $(SDCC_FLAGS) -DAPP_NAME='"$(1)"' $($(1)_FLAGS) -Ifirmware/core -Ifirmware/mcu -I$(OUT)/$(1) -MMD -c $$< -o $$@
$(OUT)/$(1).ihx: $$(patsubst %,$(OUT)/$(1)/%.rel,$$($(1)_MODULES)) build/bound
	$$(Q)tools/check_asm.sh $$(patsubst %.rel,%.asm,$$(filter %.rel,$$^))
	$$(Q)$(SDCC) $(SDCC_LINK) $$(filter %.rel,$$^) -o $$@ || { echo '$$@: error: does not fit board $(BOARD): $(CODE_BYTES) bytes of code, $(IRAM_BYTES) of RAM; see $$(@:.ihx=.mem)' >&2; exit 1; }
	$$(Q)build/bound --iram=$(IRAM_BYTES) $(patsubst %,--cycles=%,$(call BOUND_CYCLES,$(1))) --round=main $$@ $$(@:.ihx=.map) \
	    $$(patsubst %.rel,%.rst,$$(filter %.rel,$$^)) >$$(@:.ihx=.bound)
endef
$(foreach app,$(APPS),$(eval $(call app_rules,$(app))))

# An image that times APP's control step: a main of its own in place of apps/brake or apps/frames. What
# it does not have to fit is the chip.
BENCH_LINK := $(SDCC_LINK) --code-size 65536
define bench_rules
$(OUT)/bench/$(1).ihx: $$(patsubst %,$(OUT)/$(1)/%.rel,tests/bench/step $(addprefix tests/bench/,$(if $(filter apps/brake,$($(1)_MODULES)),brake,frames $(firstword $(subst _, ,$(1))))) $$(filter-out apps/brake apps/frames,$$($(1)_MODULES)))
	@mkdir -p $$(@D)
	$$(Q)$(SDCC) $(BENCH_LINK) $$^ -o $$@
$(OUT)/$(1)/tests/%.rel: tests/%.c $(OUT)/$(1)/lut_table.h $(OUT)/board.stamp
	@mkdir -p $$(@D)
	$$(Q)$(SDCC) $(SDCC_FLAGS) -DAPP_NAME='"$(1)"' $($(1)_FLAGS) -Ifirmware/apps -Ifirmware/core -Ifirmware/mcu -I$(OUT)/$(1) -MMD -c $$< -o $$@
endef
$(foreach app,$(APPS),$(eval $(call bench_rules,$(app))))

# Images for tests and bench: one file of theirs in place of apps/brake.
$(OUT)/tests/%.ihx: $(OUT)/brake/tests/%.rel $(patsubst %,$(OUT)/brake/%.rel,$(filter-out apps/brake,$(brake_MODULES)))
	@mkdir -p $(@D)
	$(Q)tools/check_asm.sh $(^:.rel=.asm)
	$(Q)$(SDCC) $(SDCC_LINK) $^ -o $@

# The flasher that suits the chip, its wiring and, when it is missing, where to get it.
HEX = $(OUT)/$(APP).hex
ifneq ($(filter flash,$(MAKECMDGOALS)),)
ifeq ($(filter $(APP),$(APPS)),)
$(error board $(BOARD) has no app '$(APP)'; its apps are: $(APPS))
endif
endif
.PHONY: flash
flash: $(OUT)/$(APP).hex
	@[ -n "$(FLASH)" ] || { echo "make flash: error: $(BOARD) has no flasher of its own; write $(HEX) with your chip's tool" >&2; exit 1; }
	@command -v $(firstword $(FLASH)) >/dev/null || { echo "make flash: error: $(firstword $(FLASH)) is missing: $(FLASH_GET)" >&2; exit 1; }
	@[ -n "$(PORT)" ] || { echo "make flash: error: say where the chip is: make flash BOARD=$(BOARD) PORT=/dev/ttyUSB0" >&2; exit 1; }
	@echo "$(FLASH_HOW)"
	$(FLASH)

$(OUT)/%.hex: $(OUT)/%.ihx
	$(Q)packihx $< >$@ 2>/dev/null

KNOBS = $(TABLE) $(ENCODING) $(ESTIMATOR) $(call BOUND_CYCLES,brake) $(subst ',,$(SDCC_FLAGS))
# Changes when a knob does, so that objects of other settings are never linked.
$(OUT)/board.stamp: FORCE
	@mkdir -p $(@D); echo '$(KNOBS)' | cmp -s - $@ || echo '$(KNOBS)' >$@
.PHONY: FORCE

-include $(wildcard $(OUT)/*/*/*.d $(OUT)/*/tests/*/*.d)
endif

# --- grids: a controller's own decision, compiled for the host, from many starts ------------------
# The follower with both rule sets, and with the safe rules but no brake when a change is refused.
FOLLOW_GRIDS := follow follow_paper follow_unyielding
follow_unyielding_TABLE := $(follow_TABLE)
follow_unyielding_GRID  := $(follow_GRID)
follow_unyielding_FLAGS := $(follow_paper_FLAGS)
FOLLOW_GRID_SRC := tools/grid/follow.c tools/drive/robots.c $(addprefix firmware/core/,follow.c lut.c frame.c)
# The parking map, with the published blend and the later one.
PARK_GRIDS := park park_late
PARK_GRID_SRC := tools/grid/park.c tools/drive/truck.c $(addprefix firmware/core/,park.c cordic.c lut.c frame.c fixed.c)
define grid_rules
build/grid/$(1)/lut_table.h: $($(1)_TABLE) build/fistab
	@mkdir -p $$(@D)
	$$(Q)build/fistab table $$< --name=lut $($(1)_GRID) -o $$@
build/grid/$(1)/%.o: %.c build/grid/$(1)/lut_table.h
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(CFLAGS) $$(HOST_FLAGS) $($(1)_FLAGS) -Ifirmware/core -Ibuild/grid/$(1) -c $$< -o $$@
build/grid/$(1)/run: $(2:%.c=build/grid/$(1)/%.o)
	$$(Q)$$(CC) $$(CFLAGS) $$^ -lm -o $$@
build/grid/$(1).csv: build/grid/$(1)/run
	$$(Q)$$< >$$@
endef
$(foreach grid,$(FOLLOW_GRIDS),$(eval $(call grid_rules,$(grid),$(FOLLOW_GRID_SRC))))
$(foreach grid,$(PARK_GRIDS),$(eval $(call grid_rules,$(grid),$(PARK_GRID_SRC))))

.PHONY: grid
grid: $(patsubst %,build/grid/%.csv,$(FOLLOW_GRIDS) $(PARK_GRIDS))

# --- tests ------------------------------------------------------------------------------------
# Every suite prints PLACE:LINE:NAME:PASS|FAIL lines; tests/run.sh adds them up.
UNITY       := build/deps/unity/src
UNITY_FLAGS := -I$(UNITY) -Itools -Wno-conversion

# Host tools: each tests/tools/test_X.c is a Unity program against the tools' own objects, sanitized.
TOOL_TESTS := $(patsubst %.c,build/%,$(wildcard tests/tools/test_*.c))
define sanitized_library
build/sanitized/lib$(1).a: $(patsubst %.c,build/sanitized/%.o,$(filter-out %/main.c,$(wildcard tools/$(1)/*.c)))
	$$(Q)rm -f $$@; ar rcs $$@ $$^
endef
$(foreach tool,common fistab drive bound,$(eval $(call sanitized_library,$(tool))))
build/sanitized/tests/%.o: HOST_FLAGS += $(UNITY_FLAGS)
build/sanitized/unity.o: $(UNITY)/unity.c
	@mkdir -p $(@D)
	$(Q)$(CC) -g -O1 $(SANITIZE) -c $< -o $@
$(TOOL_TESTS): build/%: build/sanitized/%.o build/sanitized/unity.o $(patsubst %,build/sanitized/lib%.a,fistab drive bound common)
	@mkdir -p $(@D)
	$(Q)$(CC) -g $(SANITIZE) $^ $(DRIVE_LIBS) -lm -o $@

# firmware/core: each tests/unit/test_X.c is built twice, for the host, sanitized, and for the chip.
# There Unity needs the large model with --stack-auto, so that is the model core is tested in.
UNIT_TESTS := $(patsubst tests/%.c,build/%,$(wildcard tests/unit/test_*.c))
CHIP_TESTS := $(UNIT_TESTS:build/unit/%=build/chip/%.ihx)
UNIT_FLAGS := -DCLK_HZ=12000000UL -I$(UNITY) -Ifirmware/core -Ibuild/unit
# The test of a controller whose #error wants its own table takes it, and lut.c, in as source.
UNIT_TABLES := radar park gap follow follow_paper tuned
CORE_SRC   := $(filter-out $(UNIT_TABLES:%=firmware/core/%.c) $(LAWS:%=firmware/core/law_%.c),$(wildcard firmware/core/*.c))
SDCC_UNIT  := sdcc -mmcs51 --std-c11 --model-large --stack-auto
CHIP_FLAGS := -DUNITY_INT_WIDTH=16 -DUNITY_LONG_WIDTH=32 -DUNITY_POINTER_WIDTH=16 \
    $(patsubst %,-DUNITY_EXCLUDE_%,FLOAT DOUBLE SETJMP_H MATH_H) \
    -DUNITY_OUTPUT_CHAR=chip_print -DUNITY_OUTPUT_COMPLETE=chip_end \
    '-DUNITY_OUTPUT_CHAR_HEADER_DECLARATION=chip_print(int), chip_end(void)'

build/unit/lut_table.h: $(TABLE) build/fistab
	@mkdir -p $(@D)
	$(Q)build/fistab table $< --name=lut -o $@
define unit_table
build/unit/$(1)/lut_table.h: $($(1)_TABLE) build/fistab
	@mkdir -p $$(@D)
	$$(Q)build/fistab table $$< --name=lut $($(1)_GRID) -o $$@
build/unit/tests/unit/test_$(1).o build/chip/tests/unit/test_$(1).rel: build/unit/$(1)/lut_table.h
build/unit/tests/unit/test_$(1).o build/chip/tests/unit/test_$(1).rel: UNIT_FLAGS := -Ibuild/unit/$(1) $(UNIT_FLAGS)
endef
$(foreach app,$(UNIT_TABLES),$(eval $(call unit_table,$(app))))
build/unit/%.o: %.c build/unit/lut_table.h
	@mkdir -p $(@D)
	$(Q)$(CC) -g -O1 $(SANITIZE) $(HOST_FLAGS) $(UNIT_FLAGS) -c $< -o $@
build/unit/%.o: HOST_FLAGS += -Wno-sign-conversion
build/unit/tests/%.o build/unit/$(UNITY)/%.o: HOST_FLAGS += -Wno-conversion
build/unit/libcore.a: $(CORE_SRC:%.c=build/unit/%.o)
	$(Q)rm -f $@; ar rcs $@ $^
$(UNIT_TESTS): build/unit/%: build/unit/tests/unit/%.o build/unit/$(UNITY)/unity.o build/unit/libcore.a
	$(Q)$(CC) -g $(SANITIZE) $^ -lm -o $@
build/chip/%.rel: %.c build/unit/lut_table.h
	@mkdir -p $(@D)
	$(Q)$(SDCC_UNIT) $(UNIT_FLAGS) $(CHIP_FLAGS) -MMD -c $< -o $@
build/chip/core.lib: $(CORE_SRC:%.c=build/chip/%.rel)
	$(Q)rm -f $@; sdar -rc $@ $^
$(CHIP_TESTS): build/chip/%.ihx: $(addprefix build/chip/,tests/unit/%.rel tests/unit/chip.rel $(UNITY)/unity.rel core.lib)
	$(Q)$(SDCC_UNIT) $^ -o $@

# The look-up on the chip: an image a table, compiled as it ships.
LUT_plain           := tables/brake.fis
LUT_plain-repaired  := tables/brake.fis --repair=-1,+2
LUT_packed          := tables/brake.fis --encoding=packed
LUT_packed-repaired := tables/brake.fis --encoding=packed --repair=-1,+2
LUT_packed-tuned    := tables/brake_tuned.fis --encoding=packed
# Other paths of lut.c: one input, 256 cells along either, no rows alike at the start, many blocks.
LUT_plain-one-input := tests/lut/one_input.fis
LUT_plain-256       := tables/brake.fis --grid=40x256
LUT_packed-256      := tables/brake.fis --encoding=packed --grid=256x40
LUT_packed-gap      := tables/gap.fis --encoding=packed
LUT_packed-wide     := tables/gap.fis --encoding=packed --levels=200
LUT_CASES := plain packed plain-repaired packed-repaired packed-tuned plain-one-input plain-256 packed-256 packed-gap packed-wide
LUT_IMAGES := $(LUT_CASES:%=build/lut/%/all_cells.ihx) $(LUT_CASES:%=build/lut/%/host)
define lut_rules
build/lut/$(1)/lut_table.h: $(firstword $(LUT_$(1))) build/fistab
	@mkdir -p $$(@D)
	$$(Q)build/fistab table $(LUT_$(1)) --name=lut --csv=$$(@D)/cells.csv -o $$@ 2>$$(@D)/fistab.log || \
	    { cat $$(@D)/fistab.log >&2; false; }
build/lut/$(1)/%.rel: %.c build/lut/$(1)/lut_table.h
	@mkdir -p $$(@D)
	$$(Q)$(SDCC) -Ifirmware/core -Ibuild/lut/$(1) -MMD -c $$< -o $$@
build/lut/$(1)/all_cells.ihx: build/lut/$(1)/tests/lut/all_cells.rel build/lut/$(1)/firmware/core/lut.rel
	$$(Q)$(SDCC) $$^ -o $$@
build/lut/$(1)/host: tests/lut/host.c firmware/core/lut.c build/lut/$(1)/lut_table.h
	$$(Q)$(CC) -g -O1 $(SANITIZE) $(HOST_FLAGS) -Ifirmware/core -Ibuild/lut/$(1) tests/lut/host.c firmware/core/lut.c -o $$@
endef
$(foreach case,$(LUT_CASES),$(eval $(call lut_rules,$(case))))

LONG_TESTS := tests/tools/test_frame_seeds.sh
TEST_SUITES := $(TOOL_TESTS) $(filter-out $(LONG_TESTS),$(wildcard tests/tools/test_*.sh)) $(UNIT_TESTS) $(CHIP_TESTS:%='tests/run_chip.sh %') \
    $(wildcard tests/chip/test_*.sh) $(patsubst %,'tests/run_loop.sh %',$(or $(BOARD),$(BOARDS))) \
    $(foreach law,$(LAWS),'APP=$(law) tests/run_loop.sh $(or $(BOARD),stc89c516rd) tests/loop/$(law)')

# What takes longer than one likes to wait: the sister controllers' drives, on the default board only; ten
# simulated minutes on each board; every drive of the brake with the other estimator.
SISTER_LOOPS := $(wildcard $(addprefix tests/loop/,radar gap follow park))
LONG_SUITES := $(LONG_TESTS) $(patsubst %,'tests/run_loop.sh stc89c516rd %',$(if $(filter-out stc89c516rd,$(BOARD)),,$(SISTER_LOOPS))) \
    $(patsubst %,'tests/run_loop.sh % tests/loop/long',$(or $(BOARD),$(BOARDS))) \
    'IMAGE=build/smooth/brake.ihx tests/run_loop.sh stc89c516rd'

.PHONY: run-test run-test-long
run-test-long: all
	@$(MAKE) BOARD=stc89c516rd ESTIMATOR=smooth OUT=build/smooth build/smooth/brake.ihx
	@tests/run.sh $(LONG_SUITES)
run-test: all grid $(TOOL_TESTS) $(UNIT_TESTS) $(CHIP_TESTS) $(LUT_IMAGES)
	@tests/run.sh $(TEST_SUITES)

# --- fuzzing: reader, checks, inference and writers of fistab, from tests/fuzz/corpus and all our systems ---
FUZZ_SRC := tests/fuzz/fuzz_fis.c $(filter-out %/main.c,$(wildcard tools/fistab/*.c)) $(COMMON_SRC)
build/fuzz/fuzz_fis: $(FUZZ_SRC) $(wildcard tools/*/*.h)
	@mkdir -p $(@D)
	$(Q)clang -g -O1 -std=c11 -D_GNU_SOURCE -Itools/common -Itools -fsanitize=fuzzer,address,undefined \
	    -fno-sanitize-recover=all $(FUZZ_SRC) -lm -o $@
.PHONY: run-fuzz
run-fuzz: build/fuzz/fuzz_fis
	@mkdir -p build/fuzz/corpus
	@build/fuzz/fuzz_fis -dict=tests/fuzz/fis.dict -max_total_time=$(FUZZ_SECONDS) -timeout=60 -max_len=4096 \
	    -close_fd_mask=2 -print_final_stats=1 -artifact_prefix=build/fuzz/ \
	    build/fuzz/corpus tests/fuzz/corpus tests/good tests/bad tests/golden tables

# --- the demo ---------------------------------------------------------------------------------
.PHONY: run-demo
run-demo: tools
	@$(MAKE) BOARD=stc89c516rd firmware
	@tools/demo.sh stc89c516rd

# --- the report -------------------------------------------------------------------------------
.PHONY: run-report
run-report: all grid
	@tools/report/report.sh $(or $(BOARD),stc89c516rd)

# --- bench ------------------------------------------------------------------------------------
# The frames of a bench's payloads, as the chip's UART gets them.
BENCH_LINES := $(patsubst %,build/bench/line_%,radar gap follow park)
$(BENCH_LINES): build/bench/line_%: tests/bench/line.c tests/bench/%.c tests/bench/step.h tools/drive/head.c tools/drive/random.c | all
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) -std=c11 -D_GNU_SOURCE -I. -Itools/common -Itools/drive -Ibuild $(patsubst %,-Ifirmware/%,apps core mcu) \
	    $(filter %.c,$^) -lm -o $@
.PHONY: run-bench
run-bench: all $(LUT_IMAGES) $(BENCH_LINES)
	@missed=0; for bench in tests/bench/*.sh; do echo "== $$bench"; $$bench || missed=1; done; exit $$missed

# --- targets that install what they need first -------------------------------------------------
demo fuzz report test test-long:
	@tools/deps.sh $(@:-long=)
	@$(MAKE) run-$@

# What bench prints stays for the report's page.
bench:
	@tools/deps.sh $@
	@mkdir -p build/bench
	@$(MAKE) run-$@ | tee build/bench/bench.txt

-include $(wildcard build/host/tools/*/*.d build/sanitized/*/*/*.d build/unit/*/*/*.d build/chip/*/*/*.d build/lut/*/*/*/*.d build/grid/*/*/*/*.d)
