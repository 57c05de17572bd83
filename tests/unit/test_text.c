/* Words, numbers and line numbers of a text. */
#include "check.h"
#include "common/text.h"

static struct text text_from(const char *contents)
{
    return text_of("a.txt", contents, strlen(contents));
}

static void assert_word(struct text *text, const char *wanted)
{
    struct word word;
    assert_true(text_word(text, &word));
    if (!word_is(word, wanted))
        print_error("'%.*s', not '%s'\n", (int)word.length, word.start, wanted);
    assert_true(word_is(word, wanted));
}

static void words_end_with_spaces_and_lines(void **state)
{
    (void)state;
    struct text text = text_from(" one\ttwo \r\n\nthree");
    struct word word;
    assert_word(&text, "one");
    assert_word(&text, "two");
    assert_false(text_word(&text, &word));
    assert_false(text_word(&text, &word));
    text_next_line(&text);
    assert_int_equal(text.line, 2);
    assert_false(text_word(&text, &word));
    assert_true(text_any_word(&text, &word));
    assert_true(word_is(word, "three"));
    assert_int_equal(text.line, 3);
    assert_false(text_any_word(&text, &word));
    assert_true(text_ended(&text));
}

static void a_backslash_joins_lines_only_where_it_is_asked_to(void **state)
{
    (void)state;
    struct text text = text_from("one\\\ntwo\n");
    assert_word(&text, "one\\");
    text = text_from("one\\\ntwo \\\r\n three \\\nfour\nfive\\ \\");
    text.backslash_joins = true;
    assert_word(&text, "one");
    assert_word(&text, "two");
    assert_int_equal(text.line, 2);
    text_next_line(&text);
    assert_int_equal(text.line, 5);
    assert_word(&text, "five\\");
    assert_word(&text, "\\");
}

static bool number_of(const char *contents, double *number)
{
    return word_number((struct word){contents, strcspn(contents, " ")}, number);
}

static void a_number_is_the_whole_word(void **state)
{
    (void)state;
    double number;
    assert_true(number_of("-1.5e3 7", &number));
    assert_near(number, -1500, 0);
    assert_true(number_of("nan", &number));
    assert_true(isnan(number));
    assert_false(number_of("1.5x", &number));
    assert_false(number_of("1,5", &number));
    assert_false(number_of("", &number));
    assert_false(number_of(" 7", &number));
}

static void a_whole_number_has_no_fraction_and_fits(void **state)
{
    (void)state;
    long long number;
    assert_true(word_whole((struct word){"-42/7", 3}, &number));
    assert_int_equal(number, -42);
    assert_false(word_whole((struct word){"4.0", 3}, &number));
    assert_false(word_whole((struct word){"9223372036854775808", 19}, &number));
    assert_false(word_whole((struct word){"", 0}, &number));
}

static void what_is_shown_can_be_printed_and_is_short(void **state)
{
    (void)state;
    char shown[WORD_SHOWN_SIZE];
    assert_string_equal(word_show((struct word){"a\x1b\xff~", 4}, shown), "a??~");
    const char *long_word = "0123456789012345678901234567890123456789";
    assert_string_equal(word_show((struct word){long_word, 31}, shown), "0123456789012345678901234567890");
    assert_string_equal(word_show((struct word){long_word, 32}, shown), "0123456789012345678901234567...");
}

static void a_message_names_file_and_line(void **state)
{
    (void)state;
    struct error err = {0};
    struct text text = text_from("one\ntwo");
    text_next_line(&text);
    assert_int_equal(text_fail(&text, &err, "not %d", 3), STATUS_INPUT);
    assert_string_equal(err.text, "a.txt:2: not 3");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_end_with_spaces_and_lines),
        cmocka_unit_test(a_backslash_joins_lines_only_where_it_is_asked_to),
        cmocka_unit_test(a_number_is_the_whole_word),
        cmocka_unit_test(a_whole_number_has_no_fraction_and_fits),
        cmocka_unit_test(what_is_shown_can_be_printed_and_is_short),
        cmocka_unit_test(a_message_names_file_and_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
