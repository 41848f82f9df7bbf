# SPDX-License-Identifier: MIT
# drive: its rooms see each other's headers.
drive_SRC  := $(filter-out tools/drive/sim/canary_image.c,$(drive_SRC))
drive_LIBS := -linih -lcjson -lm
build/host/tools/drive/%.o build/sanitized/tools/drive/%.o: HOST_FLAGS += $(DRIVE_ROOMS) -DIDENTITY_AT=$(IDENTITY_AT)

# What drive must know of a board comes from the fragment that builds the board's firmware, and from the
# pins that all boards share, in the order of enum board_pin.
PINS := PWM STOP TRIGGER LAMP BUZZER SERVO CUT LANE ECHO OVERRIDE
build/boards.h: tools/drive/rules.mk tools/drive/boards.awk firmware/pins.mk firmware/boards $(wildcard firmware/boards/*.mk)
	$(folder)
	$(Q)for board in $(filter firmware/boards/%.mk,$^); do \
	    awk -v pins="$(PINS)" -f tools/drive/boards.awk firmware/pins.mk $$board; \
	done >$@.part; mv $@.part $@

# The list of worlds: each file world/NAME_world.c is one.
build/worlds.h: tools/drive/rules.mk $(wildcard tools/drive/world/*_world.c) tools/drive/world
	$(folder)
	$(Q)printf 'WORLD(%s)\n' $(sort $(patsubst tools/drive/world/%_world.c,%,$(wildcard tools/drive/world/*_world.c))) >$@.part
	$(Q)mv $@.part $@

# The image that drive runs to see whether a simulator keeps time.
tools: build/canary.ihx
build/canary.ihx: tools/drive/sim/canary_image.c firmware/mcu/phase.h
	@mkdir -p build/canary
	$(Q)sdcc -mmcs51 --std-c11 --Werror -Ifirmware/mcu $< -o build/canary/canary.ihx
	$(Q)mv build/canary/canary.ihx $@
