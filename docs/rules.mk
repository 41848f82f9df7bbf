# SPDX-License-Identifier: MIT
# `make pictures`: the pictures of README.md and these pages.
PICTURE_BOARD    := $(DEFAULT_BOARD)
PICTURE_SCENARIO := tests/loop/standing_car_3mps.scn

.PHONY: run-pictures
run-pictures: tools
	@$(MAKE) BOARD=$(PICTURE_BOARD) build/$(PICTURE_BOARD)/brake.ihx
	@$(MAKE) docs/pictures/live.svg docs/pictures/surface.png

# drive in a terminal of its own, with 80 columns and no UTF-8; the terminal's output as an animation.
docs/pictures/live.svg: docs/pictures/live.awk FORCE
	@mkdir -p build/pictures
	$(Q)LC_ALL=C TERM=xterm script -qec "build/drive run --live --board $(PICTURE_BOARD) --scenario $(PICTURE_SCENARIO)" /dev/null \
	    </dev/null >build/pictures/live.txt
	$(Q)awk -f $< build/pictures/live.txt >$@

# In 48 colours the picture takes a quarter of the space. Beside it stand the sums of the table that it shows
# and of itself, so that a test finds a picture of another table.
docs/pictures/surface.png: tables/brake.fis FORCE
	@mkdir -p build/pictures
	$(Q)build/fistab table $< --csv=build/pictures/surface.csv -o build/pictures/surface.h
	$(Q)build/fistab plot $< -o build/pictures/surface.png
	$(Q)pngquant --force --strip --speed 1 48 -o $@ build/pictures/surface.png
	$(Q)for file in build/pictures/surface.csv $@; do cksum <$$file; done >docs/pictures/surface.sums
