/* Arrays that grow, and sizes that do not overflow. */
#include "check.h"
#include "common/array.h"

struct list {
    uint32_t *items;
    size_t count, capacity;
};

static void an_array_grows_and_keeps_its_items(void **state)
{
    (void)state;
    struct list list = {0};
    for (uint32_t i = 0; i < 10000; i++) {
        assert_true(ARRAY_RESERVE(&list, 1));
        list.items[list.count++] = i * i;
    }
    for (uint32_t i = 0; i < 10000; i++)
        assert_int_equal(list.items[i], i * i);
    free(list.items);
}

/* So that n items one by one cost O(n). */
static void room_at_least_doubles(void **state)
{
    (void)state;
    struct list list = {0};
    assert_true(ARRAY_RESERVE(&list, 100));
    assert_true(list.capacity >= 100);
    size_t before = list.capacity;
    list.count = before;
    assert_true(ARRAY_RESERVE(&list, 1));
    assert_true(list.capacity >= 2 * before);
    free(list.items);
}

static void no_room_asked_for_is_no_room_made(void **state)
{
    (void)state;
    struct list list = {0};
    size_t nothing = 0;
    assert_true(ARRAY_RESERVE(&list, nothing));
    assert_null(list.items);
}

static void more_than_a_size_can_hold_is_refused_and_the_array_stays(void **state)
{
    (void)state;
    struct list list = {0};
    assert_true(ARRAY_RESERVE(&list, 1));
    list.items[list.count++] = 42;
    size_t capacity = list.capacity;
    assert_false(ARRAY_RESERVE(&list, SIZE_MAX));
    assert_false(ARRAY_RESERVE(&list, SIZE_MAX / sizeof(uint32_t)));
    assert_false(ARRAY_RESERVE(&list, PTRDIFF_MAX / sizeof(uint32_t)));
    assert_int_equal(list.capacity, capacity);
    assert_int_equal(list.items[0], 42);
    free(list.items);
}

static void new_room_is_checked_for_overflow_and_may_be_nothing(void **state)
{
    (void)state;
    assert_null(array_new(SIZE_MAX, 2));
    assert_null(array_new(SIZE_MAX / 8 + 2, 8)); /* 8 in 64 bits, if it wrapped */
    void *nothing = array_new(0, 24);
    assert_non_null(nothing);
    free(nothing);
    unsigned char *bytes = array_new(5, 3);
    memset(bytes, 1, 15);
    free(bytes);
}

static void room_that_is_enough_stays_and_what_cannot_be_had_leaves_none(void **state)
{
    (void)state;
    uint32_t *items = NULL, *before;
    size_t room = 0;
    assert_true(array_renew(&items, 0, sizeof *items, &room));
    assert_non_null(items);
    assert_true(array_renew(&items, 5, sizeof *items, &room));
    before = items;
    assert_true(array_renew(&items, 3, sizeof *items, &room));
    assert_ptr_equal(items, before);
    assert_int_equal(room, 5);
    assert_false(array_renew(&items, SIZE_MAX / 2, sizeof *items, &room));
    assert_null(items);
    assert_int_equal(room, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_array_grows_and_keeps_its_items),
        cmocka_unit_test(room_at_least_doubles),
        cmocka_unit_test(no_room_asked_for_is_no_room_made),
        cmocka_unit_test(more_than_a_size_can_hold_is_refused_and_the_array_stays),
        cmocka_unit_test(new_room_is_checked_for_overflow_and_may_be_nothing),
        cmocka_unit_test(room_that_is_enough_stays_and_what_cannot_be_had_leaves_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
