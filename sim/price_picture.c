#include "sim/price_picture.h"
#include "sim/accuracy_run.h"
#include "sim/skins.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

/* More samples are not taken where lists would need longer than this for a picture, by what
 * they need for one sample. */
static const double longest_picture = 8;

/* A picture is drawn again, up to so many times, until that much has been spent: the first time
 * programs are compiled for it. */
enum { TIMES = 5 };
static const double enough = 0.4;

struct drawing {
    struct skins skins;
    struct render *render;
    struct render_view view;
    struct image image, reference;
    const struct pricing_options *options;
    struct price_picture reference_row;
    size_t wanted; /* rows */
};

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static enum status draw(struct drawing *d, struct price_picture *row, struct error *err)
{
    const double began = now();
    const struct render_scene scene = skins_scene(&d->skins, &d->view);
    const enum status status = render_draw_scene(d->render, &d->view, &scene, &d->image, err);
    row->seconds = fmin(row->seconds, now() - began);
    return status;
}

/* One picture and its price. */
static enum status price(struct drawing *d, enum scene_order order, int samples, struct price_picture *row,
                         struct error *err)
{
    enum status status = STATUS_OK;
    *row = (struct price_picture){.order = order, .samples = samples, .seconds = INFINITY};
    d->view.order = skins_order(order);
    d->view.samples = samples;
    const double began = now();
    for (int i = 0; i < TIMES && now() - began < enough && !status; i++)
        status = draw(d, row, err);
    return status;
}

static void compare(const struct drawing *d, struct price_picture *row)
{
    const size_t channels = 3 * (size_t)d->image.width * (size_t)d->image.height;
    double sum = 0;
    int worst = 0;
    for (size_t i = 0; i < channels; i++) {
        const int off = abs(d->image.rgb[i] - d->reference.rgb[i]);
        sum += off;
        worst = off > worst ? off : worst;
    }
    row->mean = sum / (double)channels;
    row->worst = worst;
}

static void find_best(struct price_pictures *pictures)
{
    for (size_t i = 0; i < pictures->count; i++) {
        struct price_picture *row = &pictures->rows[i];
        row->best = true;
        for (size_t k = 0; k < pictures->count; k++)
            row->best &= pictures->rows[k].mean >= row->mean || pictures->rows[k].seconds >= row->seconds;
    }
}

static enum status ask(const struct drawing *d, const struct price_pictures *pictures, struct error *err)
{
    return pricing_ask(d->options, (double)pictures->count / (double)d->wanted, err);
}

/* By lists, with as many samples as there is time for. */
static enum status make_reference(struct drawing *d, struct price_pictures *pictures, struct error *err)
{
    enum status status = ask(d, pictures, err);
    if (!status)
        status = price(d, SCENE_ORDER_LIST, 1, &d->reference_row, err);
    const double one = d->reference_row.seconds;
    pictures->samples = RENDER_SAMPLES_MAX;
    while (pictures->samples > 1 && pictures->samples * pictures->samples * one > longest_picture)
        pictures->samples--;
    d->wanted = (SCENE_ORDER_LIST + 1) * (size_t)pictures->samples;
    if (!status && pictures->samples > 1)
        status = price(d, SCENE_ORDER_LIST, pictures->samples, &d->reference_row, err);
    d->reference = d->image;
    d->image = (struct image){0};
    return status;
}

static enum status add_row(struct drawing *d, enum scene_order order, int samples,
                           struct price_pictures *pictures, struct error *err)
{
    struct price_picture *row = &pictures->rows[pictures->count];
    enum status status = ask(d, pictures, err);
    if ((int)order == d->reference_row.order && samples == d->reference_row.samples) {
        *row = d->reference_row;
    } else if (!status) {
        status = price(d, order, samples, row, err);
        if (!status)
            compare(d, row);
    }
    pictures->count += !status;
    return status;
}

static enum status draw_all(struct drawing *d, struct price_pictures *pictures, struct error *err)
{
    enum status status = make_reference(d, pictures, err);
    for (enum scene_order order = SCENE_ORDER_NONE; order <= SCENE_ORDER_LIST && !status; order++)
        for (int samples = 1; samples <= pictures->samples && !status; samples++)
            status = add_row(d, order, samples, pictures, err);
    find_best(pictures);
    return status;
}

static enum status picture_scene(struct sim *sim, const double ball[4], struct drawing *d,
                                 struct price_pictures *pictures, struct error *err)
{
    skins_camera(sim, ball, ball[3], &d->view);
    pictures->size[0] = d->view.width;
    pictures->size[1] = d->view.height;
    enum status status = skins_init(&d->skins, sim, err);
    if (!status)
        status = render_open(d->view.width, d->view.height, &d->render, err);
    if (!status) {
        skins_update(&d->skins);
        skins_floor(&d->skins, ball, &d->view);
        status = draw_all(d, pictures, err);
    }
    render_close(d->render);
    image_clear(&d->image);
    image_clear(&d->reference);
    skins_clear(&d->skins);
    return status;
}

/* What is not to be had is told in the table, whose other rows are there. */
static enum status give_reason(enum status status, struct price_pictures *pictures, const struct error *err)
{
    if (!status || status == STATUS_INTERRUPTED || status == STATUS_NO_MEMORY)
        return status;
    pictures->count = 0;
    snprintf(pictures->reason, sizeof pictures->reason, "%.*s", (int)sizeof pictures->reason - 1, err->text);
    return STATUS_OK;
}

enum status price_pictures_measure(const struct scene *scene, const struct mesh *meshes, double time,
                                   const struct pricing_options *options, struct price_pictures *pictures,
                                   struct error *err)
{
    const struct accuracy_subject subject = {.scene = scene, .meshes = meshes, .options = options};
    const struct accuracy_dials dials = accuracy_first_dials(scene);
    struct drawing drawing = {.options = options, .wanted = PRICE_PICTURES_MAX};
    struct accuracy_run run;
    double ball[4];
    *pictures = (struct price_pictures){.own_order = scene->view.order, .own_samples = scene->view.samples};
    enum status status = accuracy_open(&run, &subject, &dials, err);
    if (!status) {
        ball[3] = skins_ball(&run.sim, ball);
        status = accuracy_advance(&run, &subject, time, err);
    }
    pictures->time = run.sim.time;
    if (!status)
        status = picture_scene(&run.sim, ball, &drawing, pictures, err);
    accuracy_close(&run);
    return give_reason(status, pictures, err);
}
