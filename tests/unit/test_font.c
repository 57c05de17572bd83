/* Letters on pictures and in windows: names of files are UTF-8. */
#include "check.h"
#include "render/font.h"

static uint64_t dots_of(const char *text)
{
    return font_next(&text);
}

static const uint64_t block = ((uint64_t)1 << FONT_WIDTH * FONT_LINE) - 1;

static void letters_are_counted_not_bytes(void **state)
{
    (void)state;
    int width, height;
    assert_int_equal(font_letters("K\xC3\xA4tzchen"), 8);
    assert_int_equal(font_letters("Ka\xCC\x88tzchen"),
                     8); /* with a mark of its own, as some systems name files */
    assert_int_equal(font_letters("\xE7\x8C\xAB.oct\nmore"), 5);
    font_size("K\xC3\xA4tzchen\nfox", 2, &width, &height);
    assert_int_equal(width, 2 * (8 * (FONT_WIDTH + 1) - 1));
    assert_int_equal(height, 2 * (FONT_STEP + FONT_HEIGHT));
}

static void latin_letters_have_their_accents(void **state)
{
    (void)state;
    static const char *const small[][2] = {
        {"\xC3\xA4", "a"}, {"\xC3\xA9", "e"}, {"\xC3\xA7", "c"}, {"\xC3\xB8", "o"}};
    for (size_t i = 0; i < sizeof small / sizeof small[0]; i++) {
        const uint64_t dots = dots_of(small[i][0]), plain = dots_of(small[i][1]);
        assert_true((dots & plain) == plain && dots != plain);
    }
    assert_true(dots_of("\xC3\xA4") != dots_of("\xC3\xA1"));
    assert_true(dots_of("\xC3\x84") == dots_of("A")); /* there is no room above */
    assert_true(dots_of("\xC5\x99") == dots_of("r")); /* Latin Extended-A */
    assert_true(dots_of("\xC3\xAF") != dots_of("i"));
}

static void all_else_is_a_block_each(void **state)
{
    (void)state;
    static const char *const others[] = {"\xE7\x8C\xAB", "\xF0\x9F\x8E\x88", "\x01", "\x7F", "\xC2\xA0"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        assert_true(dots_of(others[i]) == block);
        assert_int_equal(font_letters(others[i]), 1);
    }
}

/* Cut off, or of another encoding: a letter a byte, and none behind the text's end is read. */
static void bytes_that_are_no_letters_are_blocks(void **state)
{
    (void)state;
    assert_int_equal(font_letters("\xE7\x8C"), 2);
    assert_int_equal(font_letters("K\xE4tzchen"), 8);
    assert_int_equal(font_letters("\xF0"), 1);
    assert_int_equal(font_letters("\xFF\xFE"), 2);
    assert_true(dots_of("\xE4t") == block);
    assert_true(dots_of("\xA4") == block);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_are_counted_not_bytes),
        cmocka_unit_test(latin_letters_have_their_accents),
        cmocka_unit_test(all_else_is_a_block_each),
        cmocka_unit_test(bytes_that_are_no_letters_are_blocks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
