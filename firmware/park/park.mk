# SPDX-License-Identifier: MIT
# The parking controller: parks backwards.
IMAGES_OF_park := park park_late park_paper

park_TABLE   := tables/park.fis
park_FISTAB  := --grid=256 --levels=255
park_FLAGS   := -DSERVO
park_CYCLES  := $(FRAME_CYCLES)
park_MODULES := park/main $(FRAME_MODULES) park/park park/plan park/cordic mcu/servo

# The same, blended at 2..4 m instead of the published 3..7 m: of the 3,780 starts of `make grid`, 8 more
# succeed, but no longer all from 20 m on.
park_late_TABLE   := tables/park_late.fis
park_late_FISTAB  := $(park_FISTAB)
park_late_FLAGS   := $(park_FLAGS)
park_late_CYCLES  := $(FRAME_CYCLES)
park_late_MODULES := $(park_MODULES)

# As published: it does not check its start, and drives into its dead zone.
park_paper_TABLE   := $(park_TABLE)
park_paper_FISTAB  := $(park_FISTAB)
park_paper_FLAGS   := $(park_FLAGS) -DPARK_AS_PUBLISHED
park_paper_CYCLES  := $(FRAME_CYCLES)
park_paper_MODULES := $(park_MODULES)

# `make grid`: the decision on the host, from many starts.
GRIDS_OF_park := park park_late
GRID_SRC_OF_park := tools/drive/plant/truck.c tools/drive/plant/random.c tools/common/diag.c $(addprefix firmware/,park/park.c park/plan.c park/cordic.c lib/lut.c frames/frame.c lib/fixed.c)
