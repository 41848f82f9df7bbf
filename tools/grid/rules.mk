# SPDX-License-Identifier: MIT
# Grids: a controller's own decision, compiled for the host, from many starts. A controller's NAME.mk
# says which grids it has and what each is built from; tools/grid/NAME.c is the main.
define grid_rules
build/grid/$(2)/lut_table.h: $($(2)_TABLE) build/fistab
	$$(folder)
	$$(Q)build/fistab table $$< --name=lut $($(2)_FISTAB) -o $$@
build/grid/$(2)/%.o: %.c build/grid/$(2)/lut_table.h
	$$(folder)
	$$(Q)$$(CC) $$(CFLAGS) $$(HOST_FLAGS) $($(2)_FLAGS) $(DRIVE_ROOMS) -Ifirmware/$(1) -Ifirmware/lib -Ifirmware/frames \
	    -Ibuild/grid/$(2) -c $$< -o $$@
build/grid/$(2)/run: $(patsubst %.c,build/grid/$(2)/%.o,tools/grid/$(1).c $(GRID_SRC_OF_$(1)))
	$$(Q)$$(CC) $$(CFLAGS) $$^ -lm -o $$@
build/grid/$(2).csv: build/grid/$(2)/run
	$$(Q)$$< >$$@
grid: build/grid/$(2).csv
endef

.PHONY: grid
grid:
