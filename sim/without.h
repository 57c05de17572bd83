/*
 * A scene without one of the effects that it calls for: what the effect's block adds is left
 * out, and all else stays.
 *
 *     struct without without;
 *     if (without_open(&without, &scene, effect, err)) ...        the reason why that cannot be
 *     without_close(&without);
 */
#ifndef SIM_WITHOUT_H
#define SIM_WITHOUT_H

#include "sim/effect.h"

struct without {
    struct scene scene;  /* what it points to is the given one's, all but the balloons; for sim_open() */
    const char *instead; /* what does its work then; NULL: nothing */
};

/* Leaves the effect out of a checked scene, which must stay as long. Errors: STATUS_NO_MEMORY; STATUS_INPUT
 * where that would be no scene: another block needs it, or it adds nothing but says what something else
 * means. It must be closed in any case. */
enum status without_open(struct without *without, const struct scene *scene, const struct effect *effect,
                         struct error *err);
void without_close(struct without *without);

#endif
