# SPDX-License-Identifier: MIT
# Host tools: each folder of tools/ with a main.c becomes build/NAME. A folder's own rules.mk says
# what else is to be linked.
# Where an image has the address of the text that says who it is (firmware/mcu/identity.h).
IDENTITY_AT := 0x06
HOST_FLAGS := -std=c11 -D_GNU_SOURCE -Wall -Wextra -Wconversion -Wshadow -Wstrict-prototypes -Werror -MMD -MP \
    -Itools/common -Ibuild -DFUZZY51_VERSION='"$(VERSION)"'
SANITIZE   := -fsanitize=address,undefined -fno-sanitize-recover=all

# At fixed addresses, which makes the fast simulator an eighth faster; also with a user's own CFLAGS.
override CFLAGS += -fno-pie -no-pie

TOOLS      := $(patsubst tools/%/main.c,%,$(wildcard tools/*/main.c))
COMMON_SRC := $(wildcard tools/common/*.c)
$(foreach tool,$(TOOLS),$(eval $(tool)_SRC := $(wildcard tools/$(tool)/*.c tools/$(tool)/*/*.c) $(COMMON_SRC)))
DRIVE_ROOMS := $(addprefix -I,tools/drive $(patsubst %/,%,$(wildcard tools/drive/*/)))
fistab_LIBS := -lm

include $(wildcard tools/*/rules.mk)

tools: $(TOOLS:%=build/%)

define tool_rules
build/$(1): $$($(1)_SRC:%.c=build/host/%.o)
	$$(Q)$$(CC) $$(CFLAGS) $$^ $($(1)_LIBS) -o $$@
endef
$(foreach tool,$(TOOLS),$(eval $(call tool_rules,$(tool))))

build/host/%.o: %.c | build/boards.h build/worlds.h
	$(folder)
	$(Q)$(CC) $(CFLAGS) $(HOST_FLAGS) -c $< -o $@
build/sanitized/%.o: %.c | build/boards.h build/worlds.h
	$(folder)
	$(Q)$(CC) -g1 -Og $(SANITIZE) $(HOST_FLAGS) -c $< -o $@

.PHONY: run-demo
run-demo: tools
	@$(MAKE) BOARD=$(or $(BOARD),$(DEFAULT_BOARD)) firmware
	@tools/demo.sh $(or $(BOARD),$(DEFAULT_BOARD)) $(APP)

SIM_BOARD := $(or $(BOARD),$(DEFAULT_BOARD))
.PHONY: run-sim
run-sim: tools
	@$(MAKE) BOARD=$(SIM_BOARD) build/$(SIM_BOARD)/$(APP).hex
	@tools/sim.sh $(SIM_BOARD) $(APP) $(SCENARIO)

-include $(wildcard build/host/tools/*/*.d build/host/tools/*/*/*.d)
