# SPDX-License-Identifier: MIT
# Builds one example: main.c, the table that fistab makes of NAME.fis, and modules of firmware/lib. Its
# Makefile sets
#     NAME      the example's name, and its .fis
#     FISTAB    options of `fistab table`
#     LIB       modules of firmware/lib beside lut; may be empty
# and includes this file. The result is build/examples/NAME/NAME.ihx and .hex, in the top folder.
TOP := ../../..
OUT := $(TOP)/build/examples/$(NAME)
MODULES := main lut $(LIB)

.DELETE_ON_ERROR:
$(OUT)/$(NAME).hex: $(OUT)/$(NAME).ihx
	packihx $< >$@
$(OUT)/$(NAME).ihx: $(MODULES:%=$(OUT)/%.rel)
	sdcc -mmcs51 $^ -o $@

# The table is made first: lut.h includes it.
vpath %.c . $(TOP)/firmware/lib
$(OUT)/%.rel: %.c $(OUT)/lut_table.h
	sdcc -mmcs51 --std-c11 --Werror -I$(OUT) -I$(TOP)/firmware/lib -c $< -o $@
$(OUT)/lut_table.h: $(NAME).fis Makefile $(TOP)/build/fistab
	@mkdir -p $(@D)
	$(TOP)/build/fistab table $< --name=lut $(FISTAB) -o $@
$(TOP)/build/fistab:
	$(MAKE) -C $(TOP) build/fistab

.PHONY: clean
clean:
	rm -rf $(OUT)
