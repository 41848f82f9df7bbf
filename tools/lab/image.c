#include "image.h"

#include "diag.h"

#include <dlfcn.h>
#include <string.h>

/* A function's address arrives as a data pointer, which ISO C does not convert. */
static bool find(void *object, const char *name, void *target)
{
    void *address = dlsym(object, name);

    memcpy(target, &address, sizeof address);
    return address != NULL;
}

int image_load(struct image *image, const char *path)
{
    void *object = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void (*load)(void);

    image->path = path;
    if (object == NULL)
        return diag_error(path, 0, "cannot load this controller: %s; run make", dlerror());
    if (!find(object, "brake", &image->brake) || !find(object, "brake_init", &image->init) ||
        !find(object, "brake_expect", &image->expect) || !find(object, "brake_step", &image->step) ||
        !find(object, "brake_finish", &image->finish) || !find(object, "brake_tick", &image->tick) ||
        !find(object, "brake_must_stop", &image->must_stop) ||
        !find(object, "range_mm", &image->range_mm) ||
        !find(object, "range_kind", &image->range_kind) ||
        !find(object, "lab_cells", &image->cells) || !find(object, "lab_load", &load))
        return diag_error(path, 0,
                          "no controller of this laboratory; use build/lab-images/NAME.so");
    load();
    return EXIT_FINE;
}
