# SPDX-License-Identifier: MIT
# Every bit of the chip: `make flips`.
FLIPS_BOARDS := $(or $(BOARD),at89s52 generic8052)
.PHONY: run-flips run-flips-all
run-flips: build/flip
	@tests/flips/flips.sh $(FLIPS_BOARDS)

# At every cycle of a control period, in place of some instants.
run-flips-all: build/flip
	@WINDOW=60 tests/flips/flips.sh $(FLIPS_BOARDS)
