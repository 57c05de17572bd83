/* Where SUNDIALS is not installed (no_cvode.c takes the place of cvode.c): the names say what they need. */
#include "check.h"
#include "sim/methods.h"

static void a_missing_library_is_named_with_its_package_and_what_to_use_instead(void **state)
{
    (void)state;
    struct error err = {0};
    struct sim sim = {.integrator = &integrator_cvode_bdf};
    assert_refused(integrator_cvode_bdf.open(&sim, &err), STATUS_RESOURCE, "libsundials-dev", &err);
    assert_non_null(strstr(err.text, "\"cvode-bdf\""));
    assert_non_null(strstr(err.text, "or use \"bdf2\""));
    sim.integrator = &integrator_cvode_adams;
    assert_refused(integrator_cvode_adams.open(&sim, &err), STATUS_RESOURCE, "or use \"rk-adaptive\"", &err);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_missing_library_is_named_with_its_package_and_what_to_use_instead),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
