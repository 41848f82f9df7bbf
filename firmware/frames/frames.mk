# SPDX-License-Identifier: MIT
# What the frame-fed controllers share: their modules after NAME/main, and the function whose worst time
# build/BOARD/APP.bound states.
FRAME_MODULES := frames/frames $(LIB_MODULES) frames/frame frames/link mcu/head
FRAME_CYCLES  := take_frame
