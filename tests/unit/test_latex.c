/* Latex looks as thin as it is, and its layers lie in their order. */
#include "renderer.h"
#include "sphere.h"

/* Seen from (0, 0, 10), y up: x and y in -2 .. 2. */
static struct render_view square_view(enum render_order order)
{
    return (struct render_view){
        .width = 160, .height = 160, .style = RENDER_LATEX, .order = order, .camera = front_camera()};
}

/* A rectangle that faces the viewer and is larger than the picture. */
struct card {
    double position[4][3];
    uint32_t triangle[2][3];
    float stretch[2];
    struct mesh mesh;
};

static struct render_skin card_at(struct card *card, double z, float grey, float opacity, float stretch)
{
    *card = (struct card){.position = {{-3, -3, z}, {3, -3, z}, {3, 3, z}, {-3, 3, z}},
                          .triangle = {{0, 1, 2}, {0, 2, 3}},
                          .stretch = {stretch, stretch}};
    card->mesh = (struct mesh){
        .point_count = 4, .position = card->position, .triangle_count = 2, .triangle = card->triangle};
    return (struct render_skin){.mesh = &card->mesh,
                                .stretch = card->stretch,
                                .rest_opacity = opacity,
                                .colour = {grey, grey, grey},
                                .facets = true};
}

static double middle_light(const struct render_skin *skins, size_t count)
{
    struct render_view view = square_view(RENDER_SORT);
    struct image image = drawn(&view, skins, count);
    double light = linear(image.rgb[3 * (80 * 160 + 80) + 1]);
    image_clear(&image);
    return light;
}

/* What a film lets through is found by changing what lies behind it. A slab of index 1.52 seen straight
 * on reflects F = (0.52 / 2.52)^2 at each side; inside, light falls by the film's depth over the stretch;
 * at rest depth is such that 0.2 is left. One step of 255 is 0.005 of light there, the difference behind
 * 0.2: a tenth is 4 steps. */
static void film_thins_by_the_law_of_beer_and_lambert(void **state)
{
    (void)state;
    const float stretches[] = {1, 1.5f, 3, 8};
    struct card film, wall;
    struct render_skin skins[2] = {card_at(&wall, -1, 0, 1, 1)};
    double dark = middle_light(skins, 1);
    skins[0] = card_at(&wall, -1, 0.6f, 1, 1);
    double difference = middle_light(skins, 1) - dark;
    assert_true(difference > 0.1);
    for (int i = 0; i < 4; i++) {
        skins[1] = card_at(&film, 1, 0.1f, 0.8f, stretches[i]);
        skins[0] = card_at(&wall, -1, 0.6f, 1, 1);
        double bright = middle_light(skins, 2);
        skins[0] = card_at(&wall, -1, 0, 1, 1);
        double passes = (bright - middle_light(skins, 2)) / difference;
        double f = pow(0.52 / 2.52, 2), t = pow(0.2, 1 / (double)stretches[i]);
        assert_near(passes, (1 - f) * (1 - f) * t / (1 - f * f * t * t), 0.008 / difference);
    }
}

static void what_is_opaque_at_rest_is_opaque(void **state)
{
    (void)state;
    struct card film, wall;
    struct render_skin skins[2] = {card_at(&wall, -1, 1, 1, 1), card_at(&film, 1, 0.3f, 1, 3)};
    assert_near(middle_light(skins, 2), middle_light(skins + 1, 1), 1e-9);
}

/* What Fresnel says of an opaque slab: the share of its body's light that leaves it. */
static double leaves(double cosine)
{
    const double inner = sqrt(1 - (1 - cosine * cosine) / (1.52 * 1.52));
    const double across = (cosine - 1.52 * inner) / (cosine + 1.52 * inner),
                 along = (inner - 1.52 * cosine) / (inner + 1.52 * cosine);
    return 1 - (across * across + along * along) / 2;
}

/* A card that is seen 3 degrees from its edge, where the mirror shows the dark behind it. Smooth it is nearly
 * black; of a rough one facets are seen that are turned to the eye, whose mean cosine edge-on is sqrt(pi)/2
 * of the roughness. One step of 255 in the smooth one's 20 is a tenth of its light. */
static void rough_latex_is_not_black_at_its_rims(void **state)
{
    (void)state;
    const double angle = 87 * M_PI / 180, at_edge = sqrt(M_PI) / 2 * sqrt(2.0 / 14);
    double light[2];
    for (int rough = 0; rough < 2; rough++) {
        struct card card;
        struct render_skin skin = card_at(&card, 0, 0.8f, 1, 1);
        skin.rest_shininess = rough ? 12 : 10000;
        for (int i = 0; i < 4; i++) {
            card.position[i][2] = card.position[i][0] * sin(angle);
            card.position[i][0] *= cos(angle);
        }
        light[rough] = middle_light(&skin, 1);
    }
    const double seen = hypot(cos(angle) * sqrt(1 - at_edge * at_edge), at_edge);
    assert_near(light[1] / light[0], leaves(seen) / leaves(cos(angle)), 0.15 * light[1] / light[0]);
}

static int brightest(const struct image *image)
{
    int most = 0;
    for (int y = 20; y < 80; y++) /* where the key light is mirrored */
        for (int x = 20; x < 80; x++)
            most = image->rgb[3 * (y * 160 + x) + 1] > most ? image->rgb[3 * (y * 160 + x) + 1] : most;
    return most;
}

/* Roughness falls with the stretch: a highlight of the same light becomes smaller and brighter. Black
 * rubber shows nothing else. */
static void stretched_latex_shines_more(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    float *stretch = calloc(mesh.triangle_count, sizeof *stretch);
    struct render_skin skin = {
        .mesh = &mesh, .stretch = stretch, .rest_opacity = 1, .rest_shininess = 0, .colour = {0, 0, 0}};
    struct render_view view = square_view(RENDER_SORT);
    view.camera.field_of_view_deg = 8; /* the sphere fills the picture */
    const float stretches[] = {1, 1.5f, 2.2f, 4};
    int before = 0;
    for (int i = 0; i < 4; i++) {
        for (uint32_t t = 0; t < mesh.triangle_count; t++)
            stretch[t] = stretches[i];
        struct image image = drawn(&view, &skin, 1);
        assert_true(brightest(&image) > before + 3);
        before = brightest(&image);
        image_clear(&image);
    }
    free(stretch);
    sphere_free(&mesh);
}

/* The wall of a closed skin glows; once a cap is cut off, less light is inside, and the rim is thicker: the
 * picture changes far from the hole. */
static void a_torn_skin_loses_its_inner_light(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    unsigned char *active = malloc(mesh.triangle_count);
    float *stretch = calloc(mesh.triangle_count, sizeof *stretch);
    for (uint32_t t = 0; t < mesh.triangle_count; t++) {
        const uint32_t *corner = mesh.triangle[t];
        active[t] = mesh.position[corner[0]][1] + mesh.position[corner[1]][1] < 1.2;
        stretch[t] = 4;
    }
    struct render_skin skin = {
        .mesh = &mesh, .stretch = stretch, .rest_opacity = 0.97f, .colour = {0.7f, 0.02f, 0.02f}};
    struct render_view view = square_view(RENDER_LIST);
    struct image closed = drawn(&view, &skin, 1);
    skin.active = active;
    struct image torn = drawn(&view, &skin, 1);
    const size_t low = 3 * (110 * 160 + 80);
    assert_true(abs(closed.rgb[low] - torn.rgb[low]) + abs(closed.rgb[low + 1] - torn.rgb[low + 1]) > 6);
    image_clear(&closed);
    image_clear(&torn);
    free(active);
    free(stretch);
    sphere_free(&mesh);
}

/* The share of channels that differ by more than 2 of 255. */
static double difference(const struct image *a, const struct image *b)
{
    int count = 0, all = 3 * a->width * a->height;
    for (int i = 0; i < all; i++)
        count += abs(a->rgb[i] - b->rgb[i]) > 2;
    return (double)count / all;
}

/* Three spheres through one another: up to six layers, none of them in order by whole
 * triangles where they cross. */
struct spheres {
    struct mesh mesh[3];
    struct render_skin skin[3];
    float stretch[3 * 2 * 30 * 30];
};

static void make_spheres(struct spheres *s)
{
    for (size_t i = 0; i < sizeof s->stretch / sizeof *s->stretch; i++)
        s->stretch[i] = 6;
    for (int i = 0; i < 3; i++) {
        s->mesh[i] = sphere_new(20, 20);
        for (uint32_t p = 0; p < s->mesh[i].point_count; p++) {
            s->mesh[i].position[p][0] += 0.5 * i - 0.5;
            s->mesh[i].position[p][2] += 0.3 * (i == 1);
        }
        s->skin[i] = (struct render_skin){.mesh = &s->mesh[i],
                                          .stretch = s->stretch,
                                          .rest_opacity = 0.97f,
                                          .rest_shininess = 12,
                                          .colour = {i == 0, i == 1, i == 2}};
    }
}

static void free_spheres(struct spheres *s)
{
    for (int i = 0; i < 3; i++)
        sphere_free(&s->mesh[i]);
}

/* Two ways to the exact order agree; half floats round differently on them, by 2^-11 a layer. Sorting errs
 * where triangles cross, no order at all nearly everywhere. */
static void lists_and_peeling_agree_and_sorting_nearly(void **state)
{
    (void)state;
    struct spheres s;
    make_spheres(&s);
    for (enum render_style style = RENDER_PAPER; style <= RENDER_LATEX; style++) {
        struct image images[4];
        float opacity[3 * 2 * 30 * 30];
        for (size_t i = 0; i < sizeof opacity / sizeof *opacity; i++)
            opacity[i] = 0.6f;
        for (enum render_order order = RENDER_NONE; order <= RENDER_LIST; order++) {
            struct render_view view = square_view(order);
            view.style = style;
            for (int i = 0; i < 3; i++)
                s.skin[i].opacity = opacity;
            images[order] = drawn(&view, s.skin, 3);
        }
        double exact = difference(&images[RENDER_PEEL], &images[RENDER_LIST]);
        double sorted = difference(&images[RENDER_SORT], &images[RENDER_LIST]);
        double none = difference(&images[RENDER_NONE], &images[RENDER_LIST]);
        assert_true(exact < 0.002);
        assert_true(sorted < 0.1);
        assert_true(none > 2 * sorted && none > 0.1);
        for (int i = 0; i < 4; i++)
            image_clear(&images[i]);
    }
    free_spheres(&s);
}

/* Its inside is as near to the eye as its outside. Ordered by their middles 4 % of the pixels were wrong;
 * what is left are outlines, a pixel wide. */
static void skin_pressed_flat_shows_its_outside(void **state)
{
    (void)state;
    struct mesh flat = sphere_new(40, 40);
    for (uint32_t p = 0; p < flat.point_count; p++) {
        const double thin = 0.002 * flat.position[p][1], deep = flat.position[p][2];
        flat.position[p][1] = 0.9 * thin - 0.5 * deep;
        flat.position[p][2] = 0.5 * thin + 0.9 * deep;
    }
    float opacity[2 * 40 * 40];
    for (size_t i = 0; i < sizeof opacity / sizeof *opacity; i++)
        opacity[i] = 0.95f;
    const struct render_skin skin = {.mesh = &flat,
                                     .opacity = opacity,
                                     .rest_opacity = 0.95f,
                                     .colour = {0.8f, 0.2f, 0.1f},
                                     .facets = true};
    for (enum render_style style = RENDER_PAPER; style <= RENDER_LATEX; style++) {
        struct render_view sort = square_view(RENDER_SORT), peel = square_view(RENDER_PEEL);
        sort.style = peel.style = style;
        struct image sorted = drawn(&sort, &skin, 1), peeled = drawn(&peel, &skin, 1);
        assert_true(difference(&sorted, &peeled) < 0.01);
        image_clear(&sorted);
        image_clear(&peeled);
    }
    sphere_free(&flat);
}

/* A sliver covers samples of pixels whose middle it misses, where what is interpolated may go on to anything:
 * there were black, blue and yellow dots. Red skin has no colour above its red, and grey behind it little. */
static void slivers_have_the_colour_of_their_skin(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(40, 40);
    float uneven[2 * 40 * 40];
    for (uint32_t p = 0; p < mesh.point_count; p++)
        mesh.position[p][1] = 0.003 * mesh.position[p][1] + 0.3 * mesh.position[p][0];
    for (uint32_t t = 0; t < 2 * 40 * 40; t++)
        uneven[t] = t % 7 ? 0.1f : 40;
    const struct render_skin skin = {.mesh = &mesh,
                                     .stretch = uneven,
                                     .opacity = uneven,
                                     .rest_opacity = 0.97f,
                                     .colour = {0.8f, 0.1f, 0.1f}};
    for (enum render_style style = RENDER_PAPER; style <= RENDER_LATEX; style++) {
        struct render_view view = square_view(RENDER_SORT);
        view.style = style;
        view.outlines = RENDER_SAMPLED;
        struct image image = drawn(&view, &skin, 1);
        for (size_t i = 0; i < 160 * 160; i++)
            for (int c = 1; c < 3; c++)
                assert_true(image.rgb[3 * i + c] <= image.rgb[3 * i] + 6);
        image_clear(&image);
    }
    sphere_free(&mesh);
}

/* 40 layers on every pixel, twenty times what the lists first have room for; each is deep
 * enough to be told from 39. */
static void lists_grow_with_their_layers(void **state)
{
    (void)state;
    struct card cards[40];
    struct render_skin skins[40];
    for (int i = 0; i < 40; i++)
        skins[i] = card_at(&cards[i], 0.02 * ((i * 17) % 40), i % 2 ? 0.8f : 0.1f, 0.2f, 1);
    struct render_view list = square_view(RENDER_LIST), peel = square_view(RENDER_PEEL);
    struct image listed = drawn(&list, skins, 40), peeled = drawn(&peel, skins, 40);
    assert_true(difference(&listed, &peeled) < 0.002);
    image_clear(&listed);
    image_clear(&peeled);
}

/* Samples change what lies within a pixel of an outline or a highlight's edge: a few per cent of it. */
static void several_samples_smooth_outlines(void **state)
{
    (void)state;
    struct spheres s;
    make_spheres(&s);
    struct render_view view = square_view(RENDER_LIST);
    struct image one = drawn(&view, s.skin, 3);
    view.samples = 3;
    struct image nine = drawn(&view, s.skin, 3);
    assert_true(difference(&one, &nine) > 0.001);
    assert_true(difference(&one, &nine) < 0.1);
    image_clear(&one);
    image_clear(&nine);
    free_spheres(&s);
}

/* Strips hold a million samples: 1400 x 1400 with nine a pixel are drawn in seventeen. */
static void large_latex_pictures_have_no_seam(void **state)
{
    (void)state;
    struct card card;
    struct render_skin skin = card_at(&card, 0, 0.2f, 0.5f, 1);
    struct render_view view = square_view(RENDER_LIST);
    view.width = view.height = 1400;
    view.samples = 3;
    struct image image = drawn(&view, &skin, 1);
    for (int y = 1; y < 1400; y++)
        assert_near(image.rgb[3 * (y * 1400 + 700)], image.rgb[3 * ((y - 1) * 1400 + 700)], 2);
    image_clear(&image);
}

static void the_backdrop_is_the_same_in_both_styles(void **state)
{
    (void)state;
    struct mesh mesh = sphere_new(20, 20);
    struct render_skin skin = {.mesh = &mesh, .rest_opacity = 1, .colour = {1, 0, 0}};
    struct render_view view = square_view(RENDER_SORT);
    view.floor = true;
    view.floor_height = -1.5;
    view.camera.eye[1] = 2;
    struct image latex = drawn(&view, &skin, 1);
    view.style = RENDER_PAPER;
    struct image paper = drawn(&view, &skin, 1);
    for (int y = 0; y < 160; y++) /* the sphere ends at x = 0.5 of the half picture */
        for (int x = 0; x < 36; x++)
            for (int i = 0; i < 3; i++)
                assert_near(latex.rgb[3 * (y * 160 + x) + i], paper.rgb[3 * (y * 160 + x) + i], 1);
    image_clear(&latex);
    image_clear(&paper);
    sphere_free(&mesh);
}

static void a_stretch_that_is_no_number_is_refused(void **state)
{
    (void)state;
    struct error err;
    struct image image = {0};
    struct card card;
    struct render_skin skin = card_at(&card, 0, 1, 1, NAN);
    struct render_view view = square_view(RENDER_SORT);
    assert_refused(render_draw(renderer, &view, &skin, 1, &image, &err), STATUS_RANGE,
                   "skin 0, triangle 0 has a stretch that is no number", &err);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(film_thins_by_the_law_of_beer_and_lambert),
        cmocka_unit_test(what_is_opaque_at_rest_is_opaque),
        cmocka_unit_test(rough_latex_is_not_black_at_its_rims),
        cmocka_unit_test(stretched_latex_shines_more),
        cmocka_unit_test(a_torn_skin_loses_its_inner_light),
        cmocka_unit_test(lists_and_peeling_agree_and_sorting_nearly),
        cmocka_unit_test(skin_pressed_flat_shows_its_outside),
        cmocka_unit_test(slivers_have_the_colour_of_their_skin),
        cmocka_unit_test(lists_grow_with_their_layers),
        cmocka_unit_test(several_samples_smooth_outlines),
        cmocka_unit_test(large_latex_pictures_have_no_seam),
        cmocka_unit_test(the_backdrop_is_the_same_in_both_styles),
        cmocka_unit_test(a_stretch_that_is_no_number_is_refused),
    };
    return cmocka_run_group_tests(tests, open_renderer, close_renderer);
}
