/*
 * Runs a program and lets one of its calls fail: calls of its own code by way of failing.so, which is loaded
 * into it, and system calls by way of the kernel (seccomp's notifications), which also meets those that the C
 * library and libpng make on their own. System calls count when they are about files of the current folder,
 * standard output or a pipe.
 */
#ifndef TESTS_FAULT_SUPERVISE_H
#define TESTS_FAULT_SUPERVISE_H

#include "../support/failing.h"

enum { SUPERVISE_HUNG = -1000, SUPERVISE_UNABLE = -1001 };

/* Runs command[] (NULL at its end) in the current folder as *failing says, `path` being the file that holds
 * it, and `library` failing.so. Output goes to .stdout and .stderr. Returns its exit status, minus the signal
 * that ended it, SUPERVISE_HUNG when it had to be ended, SUPERVISE_UNABLE when the kernel does not let us. */
int supervise(char *const *command, struct failing *failing, const char *path, const char *library);

#endif
