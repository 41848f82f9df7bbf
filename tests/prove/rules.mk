# SPDX-License-Identifier: MIT
# Proofs by Frama-C: `make prove`. The units are C files of tests/prove; prove.sh says what each kind is. Each
# controller is proved with the table that it ships with, the brake with those of the tuned law and the lidar,
# too;
# NAME_packed is what a small board makes of NAME's.
PROVED_IMAGES := $(CONTROLLERS) tuned brake_far
PACKED_IMAGES := brake tuned
PROVE_TABLES  := $(foreach name,$(PROVED_IMAGES) $(PACKED_IMAGES:%=%_packed),build/prove/$(name)/lut_table.h)
define prove_table
build/prove/$(1)$(2)/lut_table.h: $$($(1)_TABLE) build/fistab
	$$(folder)
	$$(Q)build/fistab table $$< --name=lut $(filter-out --encoding=%,$($(1)_FISTAB)) $(2:_%=--encoding=%) -o $$@
endef
$(foreach name,$(PROVED_IMAGES),$(eval $(call prove_table,$(name))))
$(foreach name,$(PACKED_IMAGES),$(eval $(call prove_table,$(name),_packed)))

# The machine, as a module for Frama-C.
build/prove/mcs51.cmxs: tests/prove/mcs51.ml
	$(folder)
	$(Q)cp $< $(@D)
	$(Q)ocamlfind ocamlopt -shared -w -a -package zarith -I "$$(frama-c -print-lib-path)" -o $@ $(@D)/mcs51.ml

.PHONY: run-prove
run-prove: $(PROVE_TABLES) build/prove/mcs51.cmxs
	@tests/prove/prove.sh

.PHONY: run-test-prove
run-test-prove: $(PROVE_TABLES) build/prove/mcs51.cmxs
	@tests/prove/test_prove.sh
