/*
 * Inner loops are compiled once for each set of instructions, all to the same bits: a table of them is
 * called NAME_plain for any machine and NAME_avx2 for one with vectors of four.
 *
 *     extern const struct solver_kernels solver_plain, solver_avx2;
 *     solver->kernels = FOR_THIS_MACHINE(solver);
 */
#ifndef SIM_INSTRUCTIONS_H
#define SIM_INSTRUCTIONS_H

#ifdef SIM_HAS_AVX2
#define FOR_THIS_MACHINE(name) (__builtin_cpu_supports("avx2") ? &name##_avx2 : &name##_plain)
#else
#define FOR_THIS_MACHINE(name) (&name##_plain)
#endif

#endif
