#include "sim/kernels.h"

extern const struct sim_kernels kernels_plain;
#ifdef SIM_HAS_AVX2
extern const struct sim_kernels kernels_avx2;
#endif

const struct sim_kernels *kernels_find(void)
{
#ifdef SIM_HAS_AVX2
    if (__builtin_cpu_supports("avx2"))
        return &kernels_avx2;
#endif
    return &kernels_plain;
}
