# What the controllers fed by frames share.
FRAME_MODULES := frames/frames $(LIB_MODULES) frames/frame frames/link mcu/head
FRAME_CYCLES  := take_frame
