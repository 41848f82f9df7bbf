/* SPDX-License-Identifier: MIT */
#include "image.h"

#include "diag.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* A function's address arrives as a data pointer, which ISO C does not convert. */
static bool find(void *object, const char *name, void *target)
{
    void *address = dlsym(object, name);

    memcpy(target, &address, sizeof address);
    return address != NULL;
}

bool image_is_tfluna(const struct image *image)
{
    return image->push != NULL;
}

int image_load(struct image *image, const char *path)
{
    char file[4096];
    void *object;
    void (*load)(void);

    /* A name without a slash is a file here, not a library of the system. */
    snprintf(file, sizeof file, "%s%s", strchr(path, '/') == NULL ? "./" : "", path);
    object = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    image->path = path;
    if (object == NULL) {
        return diag_error(path, 0, "cannot load this controller: %s; run make", dlerror());
    }
    if (!find(object, "brake", &image->brake) || !find(object, "brake_init", &image->init) ||
        !find(object, "brake_expect", &image->expect) ||
        !find(object, "brake_step", &image->step) ||
        !find(object, "brake_finish", &image->finish) ||
        !find(object, "brake_tick", &image->tick) ||
        !find(object, "brake_must_stop", &image->must_stop) ||
        !find(object, "range_mm", &image->range_mm) ||
        !find(object, "range_kind", &image->range_kind) ||
        !find(object, "lab_rows", &image->rows) || !find(object, "lab_cols", &image->cols) ||
        !find(object, "lab_cells", &image->cells) || !find(object, "lab_load", &load)) {
        return diag_error(path, 0,
                          "no controller of this laboratory; use build/lab-images/NAME.so");
    }
    find(object, "range_restart", &image->restart);
    find(object, "lab_push", &image->push);
    find(object, "range_raw", &image->raw);
    load();
    return EXIT_FINE;
}
