# SPDX-License-Identifier: MIT
# Firmware: for each board and each image of each controller, build/BOARD/IMAGE.ihx, .hex, .map, .mem
# and .bound.

# A controller is a folder with a main.c and a NAME.mk, which says what its images are made of.
LIB_MODULES := $(addprefix lib/,fixed lamp lut selftest telemetry) $(addprefix mcu/,start pwm baud identity)
CONTROLLERS := $(patsubst firmware/%/main.c,%,$(wildcard firmware/*/main.c))
include firmware/pins.mk firmware/frames/frames.mk $(foreach name,$(CONTROLLERS),firmware/$(name)/$(name).mk)
ALL_SENSORS := $(sort $(patsubst BRAKE_FILES_%,%,$(filter BRAKE_FILES_%,$(.VARIABLES))))
ifeq ($(filter $(SENSOR),$(ALL_SENSORS)),)
$(error no sensor '$(SENSOR)'; the sensors are: $(ALL_SENSORS))
endif
# Another sensor than the first one: only the images that have a range sensor to choose, in a folder of its own.
OTHER_SENSOR := $(filter-out hcsr04,$(SENSOR))
ALL_IMAGES  := $(if $(OTHER_SENSOR),$(IMAGES_OF_brake),$(foreach name,$(CONTROLLERS),$(IMAGES_OF_$(name))))
SENSOR_FOLDER := $(OTHER_SENSOR:%=/%)
# The boards that hold the brake with this sensor.
HOLDING     := $(basename $(notdir $(shell grep -lE '^SENSORS .*\<$(SENSOR)\>' firmware/boards/*.mk)))

ifneq ($(filter flash sim,$(MAKECMDGOALS)),)
ifeq ($(filter $(APP),$(ALL_IMAGES)),)
$(error no app '$(APP)'; the apps are: $(ALL_IMAGES))
endif
endif

# The controller that an image belongs to, and the folders where its files find their headers.
controller_of = $(patsubst %/main,%,$(filter %/main,$($(1)_MODULES)))
includes_of   = $(patsubst %,-Ifirmware/%,$(sort lib mcu $(dir $($(1)_MODULES:%=%))))

SDCC := sdcc -mmcs51 --std-c11 --model-small --Werror

ifeq ($(BOARD),)
# All boards: one make for each.
.PHONY: flash $(BOARDS:%=firmware-%)
flash:
	$(error say which board: make flash BOARD=NAME PORT=DEVICE; the boards are: $(BOARDS))
firmware: $(HOLDING:%=firmware-%)
	$(if $(filter-out $(HOLDING),$(BOARDS)),@echo "SENSOR=$(SENSOR) does not fit these boards: $(filter-out $(HOLDING),$(BOARDS))")
$(BOARDS:%=firmware-%): firmware-%: build/fistab build/bound $(filter build/%,$(foreach image,$(ALL_IMAGES),$($(image)_TABLE)))
	@$(MAKE) BOARD=$* firmware
else
include firmware/boards/$(BOARD).mk
ifeq ($(filter $(SENSOR),$(SENSORS)),)
$(error $(BOARD) does not hold the brake with SENSOR=$(SENSOR); the boards that do: $(HOLDING))
endif
OUT := build/$(BOARD)$(SENSOR_FOLDER)
# Without those that are for a sensor which this board does not hold.
ALL_IMAGES := $(foreach image,$(ALL_IMAGES),$(if $(filter $(or $($(image)_SENSOR),$(SENSOR)),$(SENSORS)),$(image)))
ifneq ($(filter flash sim,$(MAKECMDGOALS)),)
ifeq ($(filter $(APP),$(ALL_IMAGES)),)
$(error $(BOARD) does not hold $(APP); it holds: $(ALL_IMAGES))
endif
endif

SDCC_FLAGS = --i-code-in-asm -DCLK_HZ=$(CLK_HZ)UL -DWATCHDOG_$(WATCHDOG) -DESTIMATOR_$(ESTIMATOR) \
    -DFAULT_PCT=$(or $(FAULT_PCT),$(BOARD_FAULT_PCT)) $(foreach pin,$(PINS),-DPIN_$(pin)=$(PIN_$(pin)))
# The identity of an image without its table (identity.h).
identity_of  = fuzzy51 $(VERSION) $(if $(filter $(1),$(controller_of)),$(1),$(controller_of)/$(1)) $(BOARD) $(CLK_HZ) Hz$(foreach sensor,$(filter-out hcsr04,$(ALL_SENSORS)),$(if $(filter mcu/$(sensor),$($(1)_MODULES)), $(sensor)))
SDCC_LINK   := --code-size $(CODE_BYTES) --iram-size $(IRAM_BYTES) --xram-size 0
SDCC_VERSION := $(shell sdcc --version 2>/dev/null | head -n 1 | tr -cd '[:alnum:]. ')
# How SDCC calls its preprocessor, for tools/compile.sh; empty if SDCC does not say.
SDCPP := $(shell $(SDCC) -V -E firmware/lib/mul_u16.c 2>&1 | sed -n 's|^+ *\(.*sdcpp.*\) "*firmware/lib/mul_u16\.c"* *$$|\1|p')
export SDCC_VERSION SDCPP
# All that decides on an image beside its sources: knobs, flags, modules, who it is, the compiler.
settings_of  = $(subst ',,$(SDCC_VERSION) $(SDCC) $(SDCC_FLAGS) $(SDCC_LINK) $($(1)_FLAGS) $($(1)_TABLE) $($(1)_FISTAB) $($(1)_MODULES) \
    $($(1)_CYCLES) $(identity_of) $(IDENTITY_AT))

firmware: $(ALL_IMAGES:%=$(OUT)/%.hex)

# Compiles any C file of the tree with the settings of one image, also one that only a test links. What
# makes a part of an image removes the image first: a build that fails leaves none behind.
define compile_rules
$(OUT)/$(1)/%.rel: $(2)%.c $(OUT)/$(1)/lut_table.h $(OUT)/$(1)/image.stamp tools/compile.sh tools/no_atomics.sh
	$$(Q)$$(if $$(and $$(filter $$@,$$($(1)_MODULES:%=$(OUT)/$(1)/%.rel)),$$(wildcard $(OUT)/$(1).ihx $(OUT)/$(1).hex)),rm -f $(OUT)/$(1).ihx $(OUT)/$(1).hex; )tools/compile.sh $$< $$@ $(SDCC) $(SDCC_FLAGS) $$(IDENTITY_FLAGS) $($(1)_FLAGS) $(includes_of) -I$(OUT)/$(1)
endef
# The stamp changes when a setting does, so that objects of other settings are never linked.
define image_rules
$(OUT)/$(1)/image.stamp: FORCE
	$$(if $$(wildcard $$(@D)/.),,@mkdir -p $$(sort $$(dir $$($(1)_MODULES:%=$(OUT)/$(1)/%))))
	@echo '$(settings_of)' | cmp -s - $$@ || { rm -f $(OUT)/$(1).ihx $(OUT)/$(1).hex; echo '$(settings_of)' >$$@; }
$(OUT)/$(1)/lut_table.h: $$($(1)_TABLE) build/fistab $(OUT)/$(1)/image.stamp
	$$(folder)
	@rm -f $(OUT)/$(1).ihx $(OUT)/$(1).hex
	$$(Q)build/fistab table $$< --name=lut $($(1)_FISTAB) -o $$@
$(call compile_rules,$(1),firmware/)
$(OUT)/$(1)/mcu/identity.rel: IDENTITY_FLAGS = -DIDENTITY='"$(identity_of)"'
$(OUT)/$(1).ihx: $$(patsubst %,$(OUT)/$(1)/%.rel,$$($(1)_MODULES)) build/bound
	@rm -f $$@ $$(@:.ihx=.hex) $$(@:.ihx=.mem)
	$$(Q)tools/check_asm.sh $$(patsubst %.rel,%.asm,$$(filter %.rel,$$^))
	$$(Q)if $(SDCC) $(SDCC_LINK) $$(filter %.rel,$$^) -o $$@ 2>$$(@:.ihx=.log); then cat $$(@:.ihx=.log) >&2; \
	    else rm -f $$@; tools/no_fit.sh $$(@:.ihx=) $(BOARD) $(CODE_BYTES) '$(strip $($(1)_SMALLER))' >&2; exit 1; fi
	$$(Q)tools/identify.sh $$@ $(IDENTITY_AT)
	$$(Q)build/bound --iram=$(IRAM_BYTES) $($(1)_CYCLES:%=--cycles=%) --round=main $$@ $$(@:.ihx=.map) \
	    $$(patsubst %.rel,%.rst,$$(filter %.rel,$$^)) >$$(@:.ihx=.bound)
endef
$(foreach image,$(ALL_IMAGES),$(eval $(call image_rules,$(image))))
# What links a test's image, which may be too large for the chip: of copies, because the linker writes its addresses
# into the listings beside what it links, and those are the image's own.
define link_of_any_size
$(Q)mkdir -p $(@:.ihx=) && cp --parents $^ $(^:.rel=.lst) $(@:.ihx=)
$(Q)$(SDCC) $(SDCC_LINK) --code-size 65536 $(addprefix $(@:.ihx=)/,$^) -o $@
endef

$(OUT)/%.hex: $(OUT)/%.ihx
	$(Q)packihx $< >$@ 2>/dev/null
	@tools/memory.sh $(BOARD) $(OUT) $*

# The flasher that suits the chip, its wiring and, when it is missing, where to get it.
HEX = $(OUT)/$(APP).hex
FLASH_COMMAND = $(or $(FLASH),$(BOARD_FLASH))
.PHONY: flash
flash: $(OUT)/$(APP).hex
	@[ -n "$(FLASH_COMMAND)" ] || { echo "make flash: error: $(BOARD) has no flasher of its own; write $(HEX) with your chip's tool" >&2; exit 1; }
	@command -v $(firstword $(FLASH_COMMAND)) >/dev/null || { echo "make flash: error: $(firstword $(FLASH_COMMAND)) is missing: $(FLASH_GET)" >&2; exit 1; }
	@[ -n "$(PORT)" ] || { echo "make flash: error: say where the chip is: make flash BOARD=$(BOARD) PORT=/dev/ttyUSB0" >&2; exit 1; }
	@echo "$(FLASH_HOW)"
	$(FLASH_COMMAND)

# The same as a page of a release says it.
.PHONY: flash-page
flash-page:
	@echo '$(or $(FLASH_HOW),This board has no flasher of its own.)'
	@[ -z "$(FLASH_COMMAND)" ] || { echo; echo '    $(FLASH_COMMAND)'; }

-include $(wildcard $(OUT)/*/*/*.d $(OUT)/*/tests/*/*.d)
endif

# What the host builds of the controllers' logic.
$(foreach law,$(IMAGES_OF_brake),$(eval $(call lab_image,$(law))))
$(foreach name,$(CONTROLLERS),$(foreach grid,$(GRIDS_OF_$(name)),$(eval $(call grid_rules,$(name),$(grid)))))
-include $(wildcard build/grid/*/*/*/*.d build/grid/*/*/*/*/*.d)
