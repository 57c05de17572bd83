#include "supervise.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATH_SIZE = 4096, NO_ARGUMENT = -1, HANG_MS = 120000 };

/* The system calls that can fail: which argument is a file's number or else its name, and how. */
static const struct call {
    const char *name;
    int number, file, path, problem;
} calls[] = {
#ifdef SYS_open
    {"open", SYS_open, NO_ARGUMENT, 0, EMFILE},        {"rename", SYS_rename, NO_ARGUMENT, 1, EIO},
    {"link", SYS_link, NO_ARGUMENT, 1, EIO},           {"mkdir", SYS_mkdir, NO_ARGUMENT, 0, ENOSPC},
#endif
    {"openat", SYS_openat, NO_ARGUMENT, 1, EMFILE},    {"renameat", SYS_renameat, NO_ARGUMENT, 3, EIO},
    {"renameat2", SYS_renameat2, NO_ARGUMENT, 3, EIO}, {"linkat", SYS_linkat, NO_ARGUMENT, 3, EIO},
    {"mkdirat", SYS_mkdirat, NO_ARGUMENT, 1, ENOSPC},  {"read", SYS_read, 0, NO_ARGUMENT, EIO},
    {"pread64", SYS_pread64, 0, NO_ARGUMENT, EIO},     {"write", SYS_write, 0, NO_ARGUMENT, ENOSPC},
    {"writev", SYS_writev, 0, NO_ARGUMENT, ENOSPC},    {"ftruncate", SYS_ftruncate, 0, NO_ARGUMENT, EIO},
    {"fsync", SYS_fsync, 0, NO_ARGUMENT, EIO},         {"close", SYS_close, 0, NO_ARGUMENT, EIO},
};
enum { CALL_COUNT = sizeof calls / sizeof *calls };

struct run {
    struct failing *failing;
    pid_t program;
    int listener;
    char folder[PATH_SIZE];
};

/* Asks the kernel to ask us about each of the calls; the number to listen at, or -1. */
static int install_filter(void)
{
    struct sock_filter code[CALL_COUNT + 3];
    size_t count = 0;
    code[count++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr));
    for (size_t i = 0; i < CALL_COUNT; i++)
        code[count++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)calls[i].number,
                                                     (uint8_t)(CALL_COUNT - i), 0);
    code[count++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    code[count++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF);
    const struct sock_fprog program = {(unsigned short)count, code};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))
        return -1;
    return (int)syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &program);
}

union control {
    struct cmsghdr align;
    char bytes[CMSG_SPACE(sizeof(int))];
};

static void send_file(int socket, int file)
{
    char byte = 0;
    union control control = {0};
    struct iovec data = {&byte, 1};
    struct msghdr message = {.msg_iov = &data, .msg_iovlen = 1};
    if (file >= 0) {
        message.msg_control = control.bytes;
        message.msg_controllen = sizeof control.bytes;
        struct cmsghdr *head = CMSG_FIRSTHDR(&message);
        *head = (struct cmsghdr){CMSG_LEN(sizeof file), SOL_SOCKET, SCM_RIGHTS};
        memcpy(CMSG_DATA(head), &file, sizeof file);
    }
    sendmsg(socket, &message, 0);
}

static int receive_file(int socket)
{
    char byte;
    int file = -1;
    union control control = {0};
    struct iovec data = {&byte, 1};
    struct msghdr message = {.msg_iov = &data,
                             .msg_iovlen = 1,
                             .msg_control = control.bytes,
                             .msg_controllen = sizeof control.bytes};
    if (recvmsg(socket, &message, MSG_CMSG_CLOEXEC) > 0 && CMSG_FIRSTHDR(&message))
        memcpy(&file, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof file);
    return file;
}

static void redirect(int from, const char *path)
{
    const int file = open(path, O_RDWR | O_CREAT | O_TRUNC, 0666);
    dup2(file, from);
    close(file);
}

_Noreturn static void become(char *const *command, const char *path, const char *library, bool filtered,
                             int socket)
{
    redirect(STDIN_FILENO, "/dev/null");
    redirect(STDOUT_FILENO, ".stdout");
    redirect(STDERR_FILENO, ".stderr");
    setenv("FAILING", path, 1);
    setenv("LD_PRELOAD", library, 1);
    send_file(socket, filtered ? install_filter() : -1);
    execvp(*command, command);
    _exit(127);
}

static bool in_folder(const struct run *run, const char *path)
{
    const size_t length = strlen(run->folder);
    return !strncmp(path, run->folder, length) && path[length] == '/';
}

/* What a call is about, as words; false when that is nothing of the case's. */
static bool name_subject(const struct run *run, const struct call *call, const struct seccomp_data *data,
                         char *name)
{
    char link[64];
    if (call->path != NO_ARGUMENT) {
        struct iovec here = {name, PATH_SIZE - 1},
                     there = {(void *)(uintptr_t)data->args[call->path], PATH_SIZE - 1};
        const size_t page = 4096 - (uintptr_t)there.iov_base % 4096;
        ssize_t got = process_vm_readv(run->program, &here, 1, &there, 1, 0);
        there.iov_len = page < PATH_SIZE - 1 ? page : PATH_SIZE - 1;
        if (got < 0)
            got = process_vm_readv(run->program, &here, 1, &there, 1, 0);
        name[got > 0 ? got : 0] = '\0';
        return *name && (*name != '/' || in_folder(run, name));
    }
    const int file = (int)data->args[call->file];
    snprintf(link, sizeof link, "/proc/%d/fd/%d", (int)run->program, file);
    const ssize_t length = readlink(link, name, PATH_SIZE - 1);
    name[length > 0 ? length : 0] = '\0';
    /* a pipe's end is closed whatever the kernel says, or else its reader waits for ever */
    const bool pipe = !strncmp(name, "pipe:", 5) && call->number != SYS_close;
    return file != STDERR_FILENO && (in_folder(run, name) || pipe);
}

static bool is_program(const struct run *run, pid_t thread)
{
    char path[64];
    snprintf(path, sizeof path, "/proc/%d/task/%d", (int)run->program, (int)thread);
    return !access(path, F_OK);
}

/* 0: the call goes on; else the errno it gets. */
static int judge(struct run *run, const struct seccomp_notif *asked)
{
    char name[PATH_SIZE];
    const struct call *call = calls;
    while (call->number != asked->data.nr)
        call++;
    if (!is_program(run, (pid_t)asked->pid) || !name_subject(run, call, &asked->data, name) ||
        !failing_counts(run->failing, FAILING_FILES))
        return 0;
    const char *base = strrchr(name, '/');
    if (!*run->failing->failed)
        snprintf(run->failing->failed, sizeof run->failing->failed, "%s %.60s", call->name,
                 base ? base + 1 : name);
    return call->problem;
}

static void answer(struct run *run)
{
    struct seccomp_notif asked = {0};
    if (ioctl(run->listener, SECCOMP_IOCTL_NOTIF_RECV, &asked))
        return;
    struct seccomp_notif_resp reply = {.id = asked.id};
    reply.error = -judge(run, &asked);
    reply.flags = reply.error ? 0 : SECCOMP_USER_NOTIF_FLAG_CONTINUE;
    ioctl(run->listener, SECCOMP_IOCTL_NOTIF_SEND, &reply);
}

/* Answers until the program ends; false when it hangs. */
static bool attend(struct run *run, int ended)
{
    struct pollfd events[] = {{ended, POLLIN, 0}, {run->listener, POLLIN, 0}};
    for (;;) {
        const int got = poll(events, run->listener < 0 ? 1 : 2, HANG_MS);
        if (got == 0)
            return false;
        if (got > 0 && events[1].revents & POLLIN)
            answer(run);
        else if (got > 0 && events[0].revents)
            return true;
    }
}

int supervise(char *const *command, struct failing *failing, const char *path, const char *library)
{
    const bool filtered = failing->kinds & FAILING_FILES;
    struct run run = {.failing = failing};
    int sockets[2], result = 0;
    if (!getcwd(run.folder, sizeof run.folder) || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets))
        return SUPERVISE_UNABLE;
    run.program = fork();
    if (run.program == 0)
        become(command, path, library, filtered, sockets[1]);
    close(sockets[1]);
    run.listener = receive_file(sockets[0]);
    close(sockets[0]);
    const int ended = (int)syscall(SYS_pidfd_open, run.program, 0);
    const bool hung = !attend(&run, ended);
    if (hung)
        kill(run.program, SIGKILL);
    waitpid(run.program, &result, 0);
    close(ended);
    if (run.listener >= 0)
        close(run.listener);
    if (filtered && run.listener < 0)
        return SUPERVISE_UNABLE;
    if (hung)
        return SUPERVISE_HUNG;
    return WIFSIGNALED(result) ? -WTERMSIG(result) : WEXITSTATUS(result);
}
