# SPDX-License-Identifier: MIT
# The follower: follows a robot and asks for the next lane.
IMAGES_OF_follow := follow follow_paper

follow_TABLE   := tables/follow.fis
follow_FISTAB  := --grid=5x3x3 --levels=4
follow_FLAGS   := -DSERVO
follow_CYCLES  := $(FRAME_CYCLES)
follow_MODULES := follow/main $(FRAME_MODULES) follow/follow mcu/servo

# The same with the rules as published, to compare with: most approaches end in contact.
follow_paper_TABLE   := tables/follow_paper.fis
follow_paper_FISTAB  := $(follow_FISTAB)
follow_paper_FLAGS   := $(follow_FLAGS) -DFOLLOW_AS_PUBLISHED
follow_paper_CYCLES  := $(FRAME_CYCLES)
follow_paper_MODULES := $(follow_MODULES)

# `make grid`: the decision on the host, from many starts. Beside both images, the safe rules without
# the brake for a refused change.
GRIDS_OF_follow := follow follow_paper follow_unyielding
GRID_SRC_OF_follow := tools/drive/plant/robots.c $(addprefix firmware/,follow/follow.c lib/lut.c frames/frame.c)
follow_unyielding_TABLE  := $(follow_TABLE)
follow_unyielding_FISTAB := $(follow_FISTAB)
follow_unyielding_FLAGS  := $(follow_paper_FLAGS)
