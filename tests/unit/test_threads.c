/* The pool: every index once, every worker once, nothing lost between jobs, however many workers. */
#include "check.h"
#include "common/threads.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

/* The linker sends the library's calls of pthread_create() here (--wrap): after that many it fails. */
static int threads_to_start = 1000;

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*function)(void *),
                          void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*function)(void *),
                          void *argument);

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*function)(void *),
                          void *argument)
{
    return threads_to_start-- > 0 ? __real_pthread_create(thread, attributes, function, argument) : EAGAIN;
}

static struct threads *open_pool(unsigned workers)
{
    struct error err = {0};
    struct threads *pool = NULL;
    assert_ok(threads_open(&pool, workers, &err), &err);
    return pool;
}

struct tally {
    int hits[10000];
    unsigned worker[10000];
};

static void hit(void *context, size_t index, unsigned worker)
{
    struct tally *tally = context;
    tally->hits[index]++;
    tally->worker[index] = worker;
}

static void every_index_is_worked_on_once(void **state)
{
    (void)state;
    for (unsigned workers = 1; workers <= 7; workers += 2)
        for (size_t count = 0; count <= 10000; count = 10 * count + 1) {
            struct tally *tally = calloc(1, sizeof *tally);
            struct threads *pool = open_pool(workers);
            threads_run(pool, count, hit, tally);
            for (size_t i = 0; i < 10000; i++) {
                assert_int_equal(tally->hits[i], i < count);
                assert_true(tally->worker[i] < workers);
            }
            threads_close(pool);
            free(tally);
        }
}

static void no_pool_is_a_pool_of_one(void **state)
{
    (void)state;
    struct tally *tally = calloc(1, sizeof *tally);
    assert_int_equal(threads_workers(NULL), 1);
    threads_run(NULL, 5, hit, tally);
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(tally->hits[i], 1);
    threads_close(NULL);
    free(tally);
}

struct sums {
    double in[4096], part[THREADS_MAX][8];
};

static void add_a_share(void *context, unsigned worker, unsigned workers)
{
    struct sums *sums = context;
    sums->part[worker][0] = 0;
    for (unsigned i = worker; i < 4096; i += workers)
        sums->part[worker][0] += sums->in[i];
}

/* Each job reads what the caller wrote just before and the caller reads what all wrote; now and then it
 * waits long enough for the workers to fall asleep. */
static void thousands_of_small_jobs_lose_nothing(void **state)
{
    (void)state;
    struct threads *pool = open_pool(3);
    struct sums *sums = calloc(1, sizeof *sums);
    for (int job = 0; job < 5000; job++) {
        double total = 0;
        for (int i = 0; i < 4096; i++)
            sums->in[i] = job % 17 + i;
        threads_each(pool, add_a_share, sums);
        for (unsigned k = 0; k < threads_workers(pool); k++)
            total += sums->part[k][0];
        assert_true(total == 4096.0 * (job % 17) + 4096.0 * 4095 / 2);
        if (job % 500 == 0)
            nanosleep(&(struct timespec){0, 2000000}, NULL);
    }
    threads_close(pool);
    free(sums);
}

static void meet(void *context, unsigned worker, unsigned workers)
{
    (void)worker;
    atomic_uint *arrived = context;
    atomic_fetch_add(arrived, 1);
    while (atomic_load(arrived) < workers)
        nanosleep(&(struct timespec){0, 1000}, NULL);
}

/* Would wait for ever if one worker were called twice in place of another. */
static void each_runs_on_all_workers_at_the_same_time(void **state)
{
    (void)state;
    struct threads *pool = open_pool(4);
    for (int i = 0; i < 100; i++) {
        atomic_uint arrived = 0;
        threads_each(pool, meet, &arrived);
        assert_int_equal(arrived, 4);
    }
    threads_close(pool);
}

static double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void an_idle_pool_sleeps(void **state)
{
    (void)state;
    struct threads *pool = open_pool(4);
    double before = processor_seconds();
    nanosleep(&(struct timespec){0, 200000000}, NULL);
    /* Three that spun would take up to .2 s each; one spell of spinning is some 20 microseconds. */
    assert_true(processor_seconds() - before < 0.05);
    threads_close(pool);
}

static void too_many_threads_are_refused_with_the_limit(void **state)
{
    (void)state;
    struct error err = {0};
    struct threads *pool = NULL;
    assert_refused(threads_open(&pool, THREADS_MAX + 1, &err), STATUS_RANGE, "at most 256", &err);
    assert_null(pool);
}

static void a_thread_that_cannot_start_is_reported_and_the_others_end(void **state)
{
    (void)state;
    struct error err = {0};
    struct threads *pool = NULL;
    threads_to_start = 2;
    enum status status = threads_open(&pool, 5, &err);
    threads_to_start = 1000;
    assert_refused(status, STATUS_RESOURCE, "cannot start thread 4 of 5: Resource temporarily unavailable",
                   &err);
    assert_null(pool);
}

static void zero_workers_are_as_many_as_the_machine_has(void **state)
{
    (void)state;
    struct threads *pool = open_pool(0);
    assert_true(threads_of_machine() >= 1);
    assert_int_equal(threads_workers(pool), threads_of_machine());
    threads_close(pool);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_index_is_worked_on_once),
        cmocka_unit_test(no_pool_is_a_pool_of_one),
        cmocka_unit_test(thousands_of_small_jobs_lose_nothing),
        cmocka_unit_test(each_runs_on_all_workers_at_the_same_time),
        cmocka_unit_test(an_idle_pool_sleeps),
        cmocka_unit_test(too_many_threads_are_refused_with_the_limit),
        cmocka_unit_test(a_thread_that_cannot_start_is_reported_and_the_others_end),
        cmocka_unit_test(zero_workers_are_as_many_as_the_machine_has),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
