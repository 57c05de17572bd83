/* Runs the scene of all effects without one of them, or without all: off NAME STEPS. What it prints must not
 * depend on whether this program has the effect at all (meson.build builds it both ways). */
#include "scene_of_all.h"

#include <inttypes.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    struct scene_of_all s;
    struct error err = {0};
    if (argc != 3)
        return 2;
    enum status status = scene_of_all_open(&s, 3, argv[1], &err);
    size_t hooks = 0;
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        hooks += s.sim.hook_count[phase];
    printf("%zu hooks, %zu bytes, %u scalars\n", hooks, s.sim.bytes, s.sim.scalar_count);
    for (int i = 0; i < atoi(argv[2]) && !status; i++)
        status = sim_step(&s.sim, &err);
    if (!status)
        printf("%u broken, hash %016" PRIx64 "\n", s.sim.broken, sim_hash(&s.sim));
    scene_of_all_close(&s);
    if (status)
        fprintf(stderr, "%s\n", err.text);
    return status_exit_code(status);
}
