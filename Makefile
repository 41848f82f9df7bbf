# SPDX-License-Identifier: MIT
# fuzzy51. `make help` lists the knobs and the targets; the rules stand beside the code, in rules.mk.

# --- knobs: `make NAME=value ...`; help prints these lines ------------------------------------
BOARD        ?=#                  one board of firmware/boards; empty: all of them
APP          ?= brake#            the image that `flash` writes and `sim` runs
SCENARIO     ?=#                  what `sim` drives, a file of tests/loop; empty: the simulator's console
ENGINE       ?=#                  what runs images, s51 or fast; empty: as suits the target, mostly s51
TEST         ?=#                  the test that `unit` runs, such as brake; empty: all of them
PORT         ?=#                  where the flasher finds the chip, such as /dev/ttyUSB0
PROGRAMMER   ?= avrisp#           avrdude's name of the programmer: avrisp (an Arduino with ArduinoISP), usbasp, ...
FLASH        ?=#                  a command that writes $(HEX), instead of the board's own
TABLE        ?= tables/brake.fis# the brake's fuzzy system
GRID         ?=#                  cells of the brake's table, such as 50x50; empty: 100x100
LEVELS       ?=#                  steps of the brake force in that table, 1 to 100; empty: 100
REPAIR       ?=#                  makes the brake's table monotone: -1,+2
SENSOR       ?= hcsr04#           the brake's range sensor: hcsr04, or tfluna (images in build/BOARD/tfluna)
ESTIMATOR    ?= difference#       how the brake gets its closing speed: difference or smooth
CLK_HZ       ?=#                  crystal in Hz, such as 11059200; empty: the board's
STOP_MM      ?=#                  the brake's full STOP from this distance on; empty: 1000
RELEASE_MM   ?=#                  STOP ends only beyond this distance; empty: 1300
STEP_MS      ?=#                  time between two readings of the brake's sensor, 50 to 310; empty: 60
FAULT_PCT    ?=#                  brake force in FAULT; empty: the board's
NO_INSTALL   ?=#                  NO_INSTALL=1: install nothing, name what is missing
UNITY_DIR    ?=#                  a checkout of Unity, instead of Debian's copy
MUTANTS      ?=#                  what `mutants` looks at, a list's name, or text of a file's name, a function or a line; empty: all
FUZZ_SECONDS ?= 600#              how long `fuzz` runs
CFLAGS       ?= -O2#              of the host's programs
V            ?=#                  V=1 prints each command
PREFIX       ?= /usr/local#       where `install` puts the tools
DESTDIR      ?=#                  a folder in front of PREFIX, for packages
# Knobs of `report`, which reads them from the environment.
MAP          ?= normal#           fineness of the avoidance map: coarse, normal or fine
ONLY         ?= *#                scenarios of these names only: 'GLOB...'
IMAGES       ?=#                  these images only: 'NAME...'
JOBS         ?=#                  runs at a time; empty: one a core
SSHLOGIN     ?= :#                machines for GNU parallel: host1,host2,: (: is this one)

# --- what all rules share ---------------------------------------------------------------------
MAKEFLAGS += --no-builtin-rules --no-print-directory
# With these, make runs a plain command without a shell in between.
SHELL     := /bin/sh
.SHELLFLAGS := -ec
.DELETE_ON_ERROR:
.SECONDARY:
.DEFAULT_GOAL := all
Q := $(if $(V),,@)
# A recipe's first line, where the target's folder may be missing; a thousand times it is there.
folder = $(if $(wildcard $(@D)/.),,@mkdir -p $(@D))
VERSION := $(shell sed -n 's/^\#\# \([0-9][0-9.]*\).*/\1/p;T;q' CHANGELOG.md)
export ENGINE NO_INSTALL UNITY_DIR MAP ONLY JOBS SSHLOGIN

DEFAULT_BOARD := stc89c516rd
BOARDS := $(basename $(notdir $(wildcard firmware/boards/*.mk)))
ifneq ($(filter-out $(BOARDS),$(BOARD)),)
$(error no board '$(BOARD)'; the boards are: $(BOARDS))
endif
ifeq ($(wildcard $(TABLE)),)
$(error no file '$(TABLE)'; TABLE names the brake's fuzzy system, a .fis)
endif
ifeq ($(filter $(ESTIMATOR),difference smooth),)
$(error no estimator '$(ESTIMATOR)'; use difference or smooth)
endif
# A header that was removed does not stop the build: what included it is compiled again.
%.h: ;

# --- targets; help prints the lines with ## ----------------------------------------------------
.PHONY: all tools firmware dist compdb format lint deps clean help FORCE
all: tools firmware   ## tools, and the firmware of all boards with the memory that each image takes

include tools/rules.mk firmware/rules.mk tests/rules.mk docs/rules.mk
# These install what they need first.
TARGETS := demo sim unit unit-chip report bench test test-long attack flips flips-all prove test-prove mutants fuzz pictures
.PHONY: $(TARGETS)
demo:      ## the real firmware in the simulator, on a telling drive of APP, with a picture
sim:       ## one drive: make sim APP=park SCENARIO=tests/loop/park/t1_demo.scn
unit:      ## the unit tests alone, on this machine; one of them: make unit TEST=brake
unit-chip: ## the same on the simulated chip
report:    ## every controller on every scenario, as build/report/index.html
bench:     ## cycles, bytes and stack of each image; speed of fistab and drive
test:      ## the tests; ends with 'N passed, N failed'
test-long: ## the two engines beside each other on every drive; the brake with the other estimator
attack:    ## drives of chance, 10,000 for each law of the brake, 400 for each other controller; fails if one in a thousand is odd
flips:     ## flips every bit of the chip, in five drives of the brake, and says what came of it
flips-all: ## the same at every cycle of a control period; takes hours
prove:     ## proofs about the firmware by Frama-C; ends with 1 if one is open
test-prove: ## seeds faults into copies of the firmware, for which the proofs must fail
tune:      ## looks anew for tables/brake_tuned.fis and brake_far.fis, in build/tune
mutants:   ## changes the firmware, and what judges it, in thousands of ways; a unit test must find each
fuzz:      ## odd input for fistab, bound, drive and its simulator, for FUZZ_SECONDS in all
pictures:  ## the pictures in docs/pictures
$(TARGETS):
	@tools/deps.sh $(firstword $(subst -, ,$(@:test-prove=prove)))
	@$(MAKE) run-$@

flash:     ## writes build/BOARD/APP.hex to a chip: make flash BOARD=NAME PORT=DEVICE

dist: all  ## a release in build/dist: sources, images of all boards, how to flash them
	@tools/dist.sh $(VERSION)

compdb:    ## compile_commands.json, for editors
	@tools/compdb.sh

format:    ## lays out all C by .clang-format, and adds missing SPDX lines
	@tools/deps.sh format
	$(Q)clang-format-19 -i $$(git ls-files '*.c' '*.h')
	@tools/spdx.sh

lint:      ## looks for mistakes with shellcheck and cppcheck
	@tools/deps.sh lint
	@tools/lint.sh

deps:      ## installs what the build needs
	@tools/deps.sh build

install:   ## fistab, drive and bound with manual pages and bash completion, in PREFIX
uninstall: ## removes them

clean:     ## removes build/
	$(Q)rm -rf build

help:      ## this text
	@echo "make TARGET [KNOB=value ...]"
	@sed -n 's/^\([a-z-]*\):[^#]*## \(.*\)/  \1\t\2/p' $(MAKEFILE_LIST) | expand -t 14
	@echo "Knobs, with their default:"
	@sed -nE 's/^([A-Z_]+) +\?= ?([^#]*)# *(.*)/  \1=\2\t\3/p' Makefile | expand -t 30
	@echo "Boards: $(BOARDS)"
