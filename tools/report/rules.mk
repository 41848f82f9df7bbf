# SPDX-License-Identifier: MIT
.PHONY: run-report
run-report: all grid
	@IMAGES='$(IMAGES)' tools/report/report.sh $(or $(BOARD),$(DEFAULT_BOARD))
