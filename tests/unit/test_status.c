/* Errors: what they say, and what they mean to a program. */
#include "check.h"
#include "common/status.h"

#include <errno.h>

static void an_error_holds_its_status_and_text(void **state)
{
    (void)state;
    struct error err = {0};
    assert_int_equal(error_set(&err, STATUS_RANGE, "%s is %d; must be %g", "depth", 11, 10.0), STATUS_RANGE);
    assert_int_equal(err.status, STATUS_RANGE);
    assert_string_equal(err.text, "depth is 11; must be 10");
    assert_int_equal(error_no_memory(&err, "the octree"), STATUS_NO_MEMORY);
    assert_string_equal(err.text, "not enough memory for the octree");
}

static void nobody_need_listen(void **state)
{
    (void)state;
    assert_int_equal(error_set(NULL, STATUS_INPUT, "unheard"), STATUS_INPUT);
    assert_int_equal(error_no_memory(NULL, "anything"), STATUS_NO_MEMORY);
    assert_int_equal(error_set_errno(NULL, "a", "open"), STATUS_FILE);
}

static void a_failed_system_call_is_named_with_its_reason(void **state)
{
    (void)state;
    struct error err = {0};
    errno = ENOSPC;
    assert_int_equal(error_set_errno(&err, "fox.ply", "write"), STATUS_FILE);
    assert_string_equal(err.text, "fox.ply: cannot write: No space left on device");
}

static void a_prefix_says_where(void **state)
{
    (void)state;
    struct error err = {0};
    error_set(&err, STATUS_INPUT, "no triangles");
    assert_int_equal(error_prefix(&err, "fox.ply"), STATUS_INPUT);
    assert_string_equal(err.text, "fox.ply: no triangles");
}

static void long_texts_are_cut_not_overrun(void **state)
{
    (void)state;
    struct error err = {0};
    char text[2 * ERROR_TEXT_SIZE];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    error_set(&err, STATUS_INPUT, "%s", text);
    assert_int_equal(strlen(err.text), ERROR_TEXT_SIZE - 1);
    error_prefix(&err, "abc");
    assert_int_equal(strlen(err.text), ERROR_TEXT_SIZE - 1);
    assert_memory_equal(err.text, "abc: xxx", 8);
    error_prefix(&err, text);
    assert_int_equal(strlen(err.text), ERROR_TEXT_SIZE - 1);
}

static void exit_codes_are_those_that_are_promised(void **state)
{
    (void)state;
    assert_int_equal(status_exit_code(STATUS_OK), 0);
    assert_int_equal(status_exit_code(STATUS_NO_MEMORY), 1);
    assert_int_equal(status_exit_code(STATUS_FILE), 1);
    assert_int_equal(status_exit_code(STATUS_INPUT), 1);
    assert_int_equal(status_exit_code(STATUS_RANGE), 1);
    assert_int_equal(status_exit_code(STATUS_RESOURCE), 1);
    assert_int_equal(status_exit_code(STATUS_USAGE), 2);
    assert_int_equal(status_exit_code(STATUS_DIVERGED), 3);
    assert_int_equal(status_exit_code(STATUS_HUNG_UP), 129); /* as a shell says it: 128 + the signal */
    assert_int_equal(status_exit_code(STATUS_INTERRUPTED), 130);
    assert_int_equal(status_exit_code(STATUS_TERMINATED), 143);
}

static void every_status_has_a_meaning(void **state)
{
    (void)state;
    for (int status = STATUS_OK; status <= STATUS_TERMINATED; status++)
        assert_true(strlen(status_meaning((enum status)status)) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_error_holds_its_status_and_text),
        cmocka_unit_test(nobody_need_listen),
        cmocka_unit_test(a_failed_system_call_is_named_with_its_reason),
        cmocka_unit_test(a_prefix_says_where),
        cmocka_unit_test(long_texts_are_cut_not_overrun),
        cmocka_unit_test(exit_codes_are_those_that_are_promised),
        cmocka_unit_test(every_status_has_a_meaning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
