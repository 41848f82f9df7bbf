# SPDX-License-Identifier: MIT
# The brake. One image a law (law.h): `brake` is the published table, the others are there to compare
# with. For each image: its table, how fistab makes that table, SDCC's flags, and the modules, the one
# with main first, as SDCC's manual asks. Each carries a table, so that all start alike.
IMAGES_OF_brake := brake tuned brake_far classic first none

# What each range sensor (SENSOR) takes the place of.
BRAKE_FILES_hcsr04 := brake/closing brake/range mcu/echo mcu/uart
BRAKE_FILES_tfluna := brake/closing_tfluna brake/range_tfluna mcu/tfluna

brake_modules  = brake/main $(filter-out lib/selftest,$(LIB_MODULES)) $(addprefix brake/,brake target latch fault warning) $(BRAKE_FILES_$(1)) $(addprefix mcu/,round registers outputs code ram)
BRAKE_MODULES := $(call brake_modules,$(SENSOR))
BRAKE_FISTAB   = --encoding=$(ENCODING) $(GRID:%=--grid=%) $(LEVELS:%=--levels=%) $(REPAIR:%=--repair=%)
# What to try when an image is too large for its board.
BRAKE_SMALLER := GRID=80x80, LEVELS=50 or REPAIR=-1,+2 makes the table smaller
# What the make line can change: FAULT_PCT beside these. The image without a controller has no STOP.
STOP_KNOBS    := $(STOP_MM:%=-DBRAKE_STOP_MM=%U) $(RELEASE_MM:%=-DLATCH_NEAR_MM=%U)
BRAKE_KNOBS   := -DSENSOR_$(SENSOR) $(STOP_KNOBS) $(if $(STEP_MS),-DRANGE_PERIOD_MS=$(STEP_MS)U)
# The functions whose worst time build/BOARD/APP.bound states.
BRAKE_CYCLES  := control_step talk listen advance_clock brake_tick hal_registers_restore brake_sum hal_code_test hal_ram_test hal_begin_round hal_stack_is_good apply show

brake_TABLE   := $(TABLE)
brake_FISTAB   = $(BRAKE_FISTAB)
brake_SMALLER := $(BRAKE_SMALLER)
brake_FLAGS   := $(BRAKE_KNOBS)
brake_MODULES := $(BRAKE_MODULES) brake/law_fuzzy brake/cell

tuned_TABLE   := tables/brake_tuned.fis
# Cells of 8 cm and 0.125 m/s drive as well as 100x100 ones and take 1,400 bytes less. cell.c finds both by bytes.
TUNED_GRID    := 50x56
tuned_FISTAB   = --encoding=$(ENCODING) --grid=$(TUNED_GRID)
tuned_FLAGS   := -DESTIMATOR_smooth $(BRAKE_KNOBS)
tuned_MODULES := $(BRAKE_MODULES) brake/law_tuned brake/cell brake/ease

# For the lidar alone, whatever SENSOR says: its table goes as far as that sees.
brake_far_SENSOR  := tfluna
brake_far_TABLE   := tables/brake_far.fis
# Cells of 12.5 cm and 0.125 m/s, which cell.c finds by bytes.
brake_far_FISTAB   = --encoding=$(ENCODING) --grid=60x72
brake_far_FLAGS   := -DSENSOR_tfluna -DESTIMATOR_smooth -DBRAKE_RISE_PCT=3U $(STOP_KNOBS)
brake_far_MODULES := $(call brake_modules,tfluna) brake/law_tuned brake/cell brake/ease

classic_FLAGS := $(BRAKE_KNOBS)
first_FLAGS   := $(BRAKE_KNOBS)
none_FLAGS    := -DSENSOR_$(SENSOR) -DBRAKE_STOP_MM=0U -UFAULT_PCT -DFAULT_PCT=0

define brake_law
$(1)_TABLE    := $(TABLE)
$(1)_FISTAB    = $$(BRAKE_FISTAB)
$(1)_SMALLER  := $(BRAKE_SMALLER)
$(1)_MODULES  := $(BRAKE_MODULES) brake/law_$(1)
endef
$(foreach law,classic first none,$(eval $(call brake_law,$(law))))
$(foreach image,$(IMAGES_OF_brake),$(eval $(image)_FLAGS += -DLUT_NO_CRC16)$(eval $(image)_CYCLES := $(BRAKE_CYCLES)))
