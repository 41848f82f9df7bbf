/* SPDX-License-Identifier: MIT */
/* A controller as a program of the host: the brake with the settings of one image, in a shared
 * object, so that several can be in one process. */
#ifndef FUZZY51_IMAGE_H
#define FUZZY51_IMAGE_H

#include "../../firmware/brake/brake.h"

struct image {
    const char *path;
    struct brake_output *brake;
    void (*init)(uint8_t fault);
    void (*expect)(uint8_t elapsed_cs);
    void (*step)(uint8_t kind, uint16_t dist_mm);
    void (*finish)(void);
    void (*tick)(bool override_held);
    bool (*must_stop)(uint16_t dist_mm);
    uint16_t (*range_mm)(uint16_t raw); /* machine cycles of an echo, or mm */
    uint8_t (*range_kind)(uint16_t dist_mm);
    /* Of a sensor that sends frames, else NULL: forgets all bytes, takes one (true: it completes a
     * good frame), and says what range_mm makes a distance of. */
    void (*restart)(void);
    bool (*push)(uint8_t byte);
    uint16_t (*raw)(void);
    const unsigned *rows, *cols; /* of its table, along the distance and the speed */
    uint8_t *cells;              /* row by row; may be written over */
};

/* Whether its sensor is a TF-Luna, not an HC-SR04. */
bool image_is_tfluna(const struct image *image);

/* Loads PATH. Returns EXIT_FINE, or EXIT_INPUT after a message. It stays loaded to the end. */
int image_load(struct image *image, const char *path);

#endif
