/* Output files are complete or not there, and the old one survives. */
#include "check.h"
#include "common/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/balloon-file-XXXXXX";

static int enter_folder(void **state)
{
    (void)state;
    return !mkdtemp(folder) || chdir(folder);
}

static int leave_folder(void **state)
{
    (void)state;
    DIR *entries = opendir(".");
    for (struct dirent *entry; (entry = readdir(entries));)
        unlink(entry->d_name);
    closedir(entries);
    return rmdir(folder);
}

static int entries_here(void)
{
    int count = 0;
    DIR *entries = opendir(".");
    for (struct dirent *entry; (entry = readdir(entries));)
        count += entry->d_name[0] != '.';
    closedir(entries);
    return count;
}

static void write_text(const char *path, const char *text)
{
    struct error err = {0};
    struct file_out *out;
    assert_ok(file_out_open(path, &out, &err), &err);
    fputs(text, file_out_stream(out));
    assert_ok(file_out_commit(out, &err), &err);
}

static void assert_contents(const char *path, const char *text)
{
    struct error err = {0};
    struct bytes bytes = {0};
    assert_ok(file_read(path, &bytes, &err), &err);
    assert_string_equal((const char *)bytes.data, text);
    assert_int_equal(bytes.size, strlen(text));
    bytes_clear(&bytes);
}

static void a_committed_file_replaces_the_old_one(void **state)
{
    (void)state;
    write_text("a", "old");
    chmod("a", 0640);
    write_text("a", "new and longer");
    assert_contents("a", "new and longer");
    struct stat info;
    stat("a", &info);
    assert_int_equal(info.st_mode & 07777, 0640);
    assert_int_equal(entries_here(), 1);
}

static void an_abandoned_file_leaves_the_old_one_and_nothing_else(void **state)
{
    (void)state;
    struct error err = {0};
    struct file_out *out;
    write_text("a", "old");
    assert_ok(file_out_open("a", &out, &err), &err);
    fputs("half", file_out_stream(out));
    file_out_abandon(out);
    assert_contents("a", "old");
    assert_int_equal(entries_here(), 1);
}

/* However it is killed; where the file system knows no files without a name there is one that is left. */
static void a_program_that_is_killed_leaves_nothing_else(void **state)
{
    (void)state;
    write_text("a", "old");
    const int trial = open(".", O_TMPFILE | O_WRONLY, 0600), before = entries_here();
    if (trial < 0)
        print_message("# %s: no files without a name here: %s\n", __func__, strerror(errno));
    close(trial);
    const pid_t writer = fork();
    if (writer == 0) {
        struct error err = {0};
        struct file_out *out;
        if (!file_out_open("a", &out, &err)) {
            fputs("half", file_out_stream(out));
            fflush(file_out_stream(out));
        }
        raise(SIGKILL);
    }
    assert_int_equal(waitpid(writer, NULL, 0), writer);
    assert_contents("a", "old");
    assert_int_equal(entries_here(), before + (trial < 0));
}

/* Before the work, not behind it: the temporary file's name is longer. */
static void a_name_that_is_too_long_is_refused_at_once(void **state)
{
    (void)state;
    struct error err = {0};
    struct file_out *out;
    char name[256] = "";
    memset(name, 'n', 250);
    assert_refused(file_out_open(name, &out, &err), STATUS_FILE, "cannot create: File name too long", &err);
}

static void a_link_is_followed_not_replaced(void **state)
{
    (void)state;
    write_text("a", "old");
    assert_int_equal(symlink("a", "link"), 0);
    write_text("link", "through the link");
    assert_contents("a", "through the link");
    struct stat info;
    lstat("link", &info);
    assert_true(S_ISLNK(info.st_mode));
}

static void a_full_disk_is_reported(void **state)
{
    (void)state;
    struct error err = {0};
    struct file_out *out;
    assert_ok(file_out_open("/dev/full", &out, &err), &err);
    fputs("anything", file_out_stream(out));
    assert_refused(file_out_commit(out, &err), STATUS_FILE, "/dev/full: cannot write: No space left", &err);
}

/* Longer than any first guess of its length, which a pipe does not tell. */
static void a_full_disk_is_reported_though_much_has_gone_wrong_since(void **state)
{
    (void)state;
    struct error err = {0};
    struct file_out *out = NULL;
    assert_ok(file_out_open("/dev/full", &out, &err), &err);
    for (int i = 0; i < 10000; i++)
        fputs("a line of the log\n", file_out_stream(out));
    assert_true(access("no/such/file", F_OK) != 0);
    assert_refused(file_out_commit(out, &err), STATUS_FILE, "/dev/full: cannot write: No space left", &err);
}

static void a_pipe_is_read_to_its_end(void **state)
{
    (void)state;
    enum { SIZE = 300000 };
    char *text = calloc(1, SIZE + 1);
    memset(text, 'x', SIZE);
    text[SIZE - 1] = 'y';
    assert_int_equal(mkfifo("pipe", 0600), 0);
    const pid_t writer = fork();
    if (writer == 0) {
        FILE *stream = fopen("pipe", "w");
        _exit(!stream || fputs(text, stream) < 0 || fclose(stream));
    }
    assert_contents("pipe", text);
    assert_int_equal(waitpid(writer, NULL, 0), writer);
    free(text);
}

static void missing_folders_and_folders_are_refused_by_name(void **state)
{
    (void)state;
    struct error err = {0};
    struct file_out *out;
    assert_refused(file_out_open("no/such/a", &out, &err), STATUS_FILE, "no/such/a: cannot create", &err);
    assert_refused(file_out_open(".", &out, &err), STATUS_FILE, ".: is a folder", &err);
    struct bytes bytes;
    assert_refused(file_read("nothing", &bytes, &err), STATUS_FILE, "nothing: cannot open", &err);
    assert_refused(file_read(".", &bytes, &err), STATUS_FILE, ".: cannot read", &err);
}

/* A pipe need not end either: what does not begin as it must is read no further. */
static void a_pipe_of_something_else_is_left_at_once(void **state)
{
    (void)state;
    struct error err = {0};
    struct bytes bytes = {0};
    int ended;
    assert_int_equal(mkfifo("endless", 0600), 0);
    const pid_t writer = fork();
    if (writer == 0) {
        FILE *stream = fopen("endless", "w");
        for (int i = 0; i < 100000000; i++) /* ends by a signal where nobody reads on */
            fputc('x', stream);
        _exit(0);
    }
    assert_ok(file_read_signed("endless", "oct", 3, &bytes, &err), &err);
    assert_true(bytes.size >= 3 && bytes.size < 1 << 17 && bytes.data[bytes.size] == 0);
    bytes_clear(&bytes);
    assert_int_equal(waitpid(writer, &ended, 0), writer);
    assert_true(WIFSIGNALED(ended));
    write_text("signed", "oct and more");
    assert_ok(file_read_signed("signed", "oct", 3, &bytes, &err), &err);
    assert_string_equal((const char *)bytes.data, "oct and more");
    bytes_clear(&bytes);
}

/* Nor need one that begins as it must, as text does: it is read no further than any text goes. */
static void a_pipe_without_an_end_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct bytes bytes = {0};
    int ended;
    assert_int_equal(mkfifo("flood", 0600), 0);
    const pid_t writer = fork();
    if (writer == 0) {
        static const char text[1 << 16] = "v 0 0 0";
        const int pipe = open("flood", O_WRONLY);
        for (int i = 0; i < 1 << 16; i++) /* 4 GB */
            if (write(pipe, text, sizeof text) < 0)
                break;
        _exit(0);
    }
    assert_refused(file_read("flood", &bytes, &err), STATUS_FILE, "flood: has no end within 512 MB", &err);
    assert_null(bytes.data);
    assert_int_equal(waitpid(writer, &ended, 0), writer);
    assert_true(WIFSIGNALED(ended));
}

/* Most have no end. The one that is empty is as good as a file. */
static void a_device_is_refused_at_once(void **state)
{
    (void)state;
    static const char *const endless[] = {"/dev/zero", "/dev/full", "/dev/urandom"};
    struct error err = {0};
    struct bytes bytes;
    for (size_t i = 0; i < sizeof endless / sizeof *endless; i++)
        assert_refused(file_read(endless[i], &bytes, &err), STATUS_FILE, "is a device", &err);
    assert_contents("/dev/null", "");
}

/* It is no regular file, so it is written in place, and cannot be. */
static void a_socket_is_refused_and_stays(void **state)
{
    (void)state;
    struct error err = {0};
    struct file_out *out;
    struct sockaddr_un name = {.sun_family = AF_UNIX, .sun_path = "socket"};
    const int bound = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    assert_int_equal(bind(bound, (const struct sockaddr *)&name, sizeof name), 0);
    assert_refused(file_out_open("socket", &out, &err), STATUS_FILE, "socket: cannot open: ", &err);
    assert_int_equal(access("socket", F_OK), 0);
    close(bound);
}

/* Neither it nor what it leads to is the file that was meant. */
static void a_link_that_leads_nowhere_is_not_replaced(void **state)
{
    (void)state;
    struct error err = {0};
    struct file_out *out;
    struct stat info;
    static const char *const targets[] = {"no-such-file", "nowhere"}; /* the second: to itself */
    for (int i = 0; i < 2; i++) {
        assert_int_equal(symlink(targets[i], "nowhere"), 0);
        assert_refused(file_out_open("nowhere", &out, &err), STATUS_FILE,
                       "nowhere: is a link that leads nowhere", &err);
        assert_refused(file_out_check("nowhere", &err), STATUS_FILE, "nowhere: is a link that leads nowhere",
                       &err);
        assert_int_equal(lstat("nowhere", &info), 0);
        assert_true(S_ISLNK(info.st_mode));
        unlink("nowhere");
    }
}

/* Whose full name is longer than the system takes. */
static void a_file_far_down_is_replaced(void **state)
{
    enum { DEPTH = 25, LONG = 200 };
    char name[LONG + 1] = "";
    struct error err = {0};
    (void)state;
    memset(name, 'd', LONG);
    for (int i = 0; i < DEPTH; i++)
        assert_false(mkdir(name, 0777) || chdir(name));
    for (int i = 0; i < 2; i++) {
        struct file_out *out;
        assert_ok(file_out_open("a", &out, &err), &err);
        assert_ok(file_out_commit(out, &err), &err);
    }
    unlink("a");
    for (int i = 0; i < DEPTH; i++)
        assert_false(chdir("..") || rmdir(name));
}

static void make_empty(const char *path)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fclose(stream);
}

/* One that is there by its file, one that is not by its folder and name. */
static void no_file_is_written_twice_or_read_too(void **state)
{
    static const char *const clashes[][2] = {{"here", "there"},  {"here", "./here"}, {"link/here", "here"},
                                             {"new", "new"},     {"new", "./new"},   {"link/new", "new"},
                                             {"new", "link/new"}};
    static const char *const others[][2] = {{"here", "new"},      {"new", "newer"},
                                            {"new", "/tmp/new"},  {"/dev/null", "/dev/null"},
                                            {"no/new", "no/new"}, {NULL, NULL}};
    struct error err = {0};
    (void)state;
    make_empty("here");
    assert_int_equal(symlink("here", "there") || symlink(".", "link"), 0);
    for (size_t i = 0; i < sizeof clashes / sizeof *clashes; i++) {
        assert_refused(file_check_clash(NULL, 0, clashes[i], 2, &err), STATUS_USAGE, "two outputs", &err);
        if (i < 3)
            assert_refused(file_check_clash(clashes[i], 1, clashes[i] + 1, 1, &err), STATUS_FILE,
                           "is read here", &err);
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        assert_int_equal(file_check_clash(NULL, 0, others[i], 2, &err), STATUS_OK);
        assert_int_equal(file_check_clash(others[i], 1, others[i] + 1, 1, &err), STATUS_OK);
    }
    unlink("link");
    unlink("there");
    unlink("here");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_link_that_leads_nowhere_is_not_replaced),
        cmocka_unit_test(no_file_is_written_twice_or_read_too),
        cmocka_unit_test(a_file_far_down_is_replaced),
        cmocka_unit_test(a_committed_file_replaces_the_old_one),
        cmocka_unit_test(an_abandoned_file_leaves_the_old_one_and_nothing_else),
        cmocka_unit_test(a_program_that_is_killed_leaves_nothing_else),
        cmocka_unit_test(a_name_that_is_too_long_is_refused_at_once),
        cmocka_unit_test(a_link_is_followed_not_replaced),
        cmocka_unit_test(a_full_disk_is_reported),
        cmocka_unit_test(a_full_disk_is_reported_though_much_has_gone_wrong_since),
        cmocka_unit_test(a_pipe_is_read_to_its_end),
        cmocka_unit_test(a_pipe_of_something_else_is_left_at_once),
        cmocka_unit_test(a_pipe_without_an_end_is_refused),
        cmocka_unit_test(a_device_is_refused_at_once),
        cmocka_unit_test(a_socket_is_refused_and_stays),
        cmocka_unit_test(missing_folders_and_folders_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
