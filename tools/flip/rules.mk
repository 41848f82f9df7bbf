# SPDX-License-Identifier: MIT
# flip: bits of the chip that change, thousands of times, in drive's world.
flip_SRC  += $(filter-out %/main.c $(COMMON_SRC) tools/drive/sim/canary_image.c,$(drive_SRC))
flip_LIBS := -linih -lcjson -lm
build/host/tools/flip/%.o build/sanitized/tools/flip/%.o: HOST_FLAGS += $(DRIVE_ROOMS)
