/* Pictures where memory ends and files fail. */
#include "../unit/pictures.h"
#include "faulty.h"

static enum status save_picture(const void *thing, const char *path, struct error *err)
{
    return image_save_png(thing, path, NULL, 0, err);
}

static void a_picture_is_saved_whole_or_not_at_all(void **state)
{
    (void)state;
    struct image image = a_picture(30, 20);
    check_save(save_picture, &image, "a.png");
    image_clear(&image);
}

static void a_picture_in_memory_is_whole_or_not_there(void **state)
{
    (void)state;
    struct image image = a_picture(30, 20);
    for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);) {
        struct error err = {0};
        struct bytes png = {0};
        fault_begin(&fault);
        const enum status status = image_encode_png(&image, NULL, 0, &png, &err);
        fault_end(&fault);
        assert_true(fault.failed || !status);
        assert_says(status, &err, fault.kinds);
        assert_true(status ? !png.data : !memcmp(png.data + png.size - 8, "IEND", 4));
        bytes_clear(&png);
    }
    image_clear(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_is_saved_whole_or_not_at_all),
        cmocka_unit_test(a_picture_in_memory_is_whole_or_not_there),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
