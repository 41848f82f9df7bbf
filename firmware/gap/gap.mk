# SPDX-License-Identifier: MIT
# The gap controller: keeps the safe distance to the car ahead.
IMAGES_OF_gap := gap gap_paper gap_fuzzy gap_lq

gap_TABLE   := tables/gap.fis
gap_FISTAB  := --nodes --grid=33x33 --levels=200
gap_FLAGS   := -DSERVO
gap_CYCLES  := $(FRAME_CYCLES)
gap_MODULES := gap/main $(FRAME_MODULES) gap/gap lib/mul_u16 mcu/servo

# The published law alone, to compare with: it hits a car that brakes as hard as its own model assumes.
gap_paper_TABLE   := $(gap_TABLE)
gap_paper_FISTAB  := $(gap_FISTAB)
gap_paper_FLAGS   := $(gap_FLAGS) -DGAP_AS_PUBLISHED
gap_paper_CYCLES  := $(FRAME_CYCLES)
gap_paper_MODULES := $(gap_MODULES)

# Half of the published law, to compare with: the fuzzy table alone.
gap_fuzzy_TABLE   := $(gap_TABLE)
gap_fuzzy_FISTAB  := $(gap_FISTAB)
gap_fuzzy_FLAGS   := $(gap_paper_FLAGS) -DGAP_FUZZY_ALONE
gap_fuzzy_CYCLES  := $(FRAME_CYCLES)
gap_fuzzy_MODULES := $(gap_MODULES)

# Half of the published law, to compare with: the optimal law alone.
gap_lq_TABLE   := $(gap_TABLE)
gap_lq_FISTAB  := $(gap_FISTAB)
gap_lq_FLAGS   := $(gap_paper_FLAGS) -DGAP_LQ_ALONE
gap_lq_CYCLES  := $(FRAME_CYCLES)
gap_lq_MODULES := $(gap_MODULES)
