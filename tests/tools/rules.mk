# SPDX-License-Identifier: MIT
# Tests of the host tools: each test_X.c is a Unity program against the tools' own objects, sanitized.
TOOL_TESTS := $(patsubst %.c,build/%,$(wildcard tests/tools/test_*.c))

define sanitized_library
build/sanitized/lib$(1).a: $(patsubst %.c,build/sanitized/%.o,$(filter-out %/main.c,$(filter tools/$(1)/%,$($(1)_SRC))))
	$$(Q)rm -f $$@; ar rcs $$@ $$^
endef
common_SRC := $(COMMON_SRC)
$(foreach tool,common fistab drive bound,$(eval $(call sanitized_library,$(tool))))

build/sanitized/tests/%.o: HOST_FLAGS += $(UNITY_FLAGS) -Ifirmware/lib -Ifirmware/frames
build/sanitized/unity.o: $(UNITY)/unity.c
	$(folder)
	$(Q)$(CC) -g1 -Og $(SANITIZE) -c $< -o $@
$(TOOL_TESTS): build/%: build/sanitized/%.o build/sanitized/unity.o $(patsubst %,build/sanitized/lib%.a,fistab drive bound common)
	$(folder)
	$(Q)$(CC) -g $(SANITIZE) $^ $(drive_LIBS) -o $@
# It runs the program.
build/tests/tools/test_tfluna_setup: | build/tfluna

-include $(wildcard build/sanitized/*/*/*.d build/sanitized/*/*/*/*.d)
