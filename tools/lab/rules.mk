# SPDX-License-Identifier: MIT
# The laboratory: drive's world around control logic that runs on the host. Each law of the brake is a
# shared object, build/lab-images/NAME.so; with SENSOR=tfluna build/lab-images/tfluna/NAME.so.
lab_SRC  := $(filter-out tools/lab/lut.c,$(lab_SRC)) \
    $(filter-out %/main.c $(COMMON_SRC),$(fistab_SRC) $(filter-out tools/drive/sim/canary_image.c,$(drive_SRC)))
lab_LIBS := -linih -lcjson -ldl -lm
build/host/tools/lab/%.o: HOST_FLAGS += $(DRIVE_ROOMS) -Itools/fistab -Ifirmware/lib

LAB_OUT    = build/lab-images$(SENSOR_FOLDER)
LAB_IMAGES = $(IMAGES_OF_brake:%=$(LAB_OUT)/%.so)
.PHONY: lab-images
tools: lab-images
define lab_image
lab-images: $(LAB_OUT)/$(1).so
$(LAB_OUT)/$(1)/lut_table.h: $$($(1)_TABLE) build/fistab
	$$(folder)
	$$(Q)build/fistab table $$< --name=lut $$(filter --grid=%,$$($(1)_FISTAB)) -o $$@
$(LAB_OUT)/$(1).so: tools/lab/lut.c $(patsubst %,firmware/%.c,lib/fixed $(filter-out brake/main,$(filter brake/%,$($(1)_MODULES)))) \
        $(wildcard firmware/brake/*.h firmware/lib/*.h) $(LAB_OUT)/$(1)/lut_table.h
	$$(Q)$$(CC) -O2 -std=c11 -fPIC -shared -DCLK_HZ=12000000UL -DFAULT_PCT=60 $($(1)_FLAGS) -Ifirmware/brake -Ifirmware/lib \
	    -I$(LAB_OUT)/$(1) $$(filter %.c,$$^) -o $$@
endef

# A random search for drives in which a controller does what nobody expects. Less than one drive in a
# thousand may be flagged: two stray echoes that agree, or noise that repeats a reading (docs/brake.md).
ATTACK_RUNS := 10000
# The same for the frame-fed controllers, with their real images in the fast engine (docs/controllers.md).
HEAD_ATTACK_RUNS   := 400
HEAD_ATTACK_IMAGES := $(patsubst %,build/$(DEFAULT_BOARD)/%.ihx,radar gap follow park)
.PHONY: run-attack
run-attack: build/lab lab-images
	@build/lab attack --runs $(ATTACK_RUNS) build/lab-images/first.so $(patsubst %,build/lab-images/%.so,brake tuned classic)
	@$(MAKE) BOARD=$(DEFAULT_BOARD) $(HEAD_ATTACK_IMAGES)
	@build/lab attack --runs $(HEAD_ATTACK_RUNS) $(HEAD_ATTACK_IMAGES)

# Looks anew for the tables that say how they were found; leaves what it finds in build/tune. A walk takes ten
# minutes or more.
.PHONY: tune
tune: build/lab lab-images
	@mkdir -p build/tune
	@for table in $$(grep -lE '^% *build/lab tune ' tables/*.fis); do \
	    found=build/tune/$${table##*/}; \
	    $$(sed -n 's|^% *\(build/lab tune .*\) -o FILE$$|\1|p' $$table) -o $$found; \
	    echo "tune: $$found, in place of $$table"; \
	done
