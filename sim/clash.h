/* Which names of files and folders cannot be had together. */
#ifndef SIM_CLASH_H
#define SIM_CLASH_H

#include "common/scene.h"
#include "sim/options.h"

/* No output takes the place of what is read, or of another; but a checkpoint may be the one that is gone on
 * with. Errors: those of file_check_clash(). */
enum status clash_check(const struct options *options, const struct scene *scene, struct error *err);

#endif
