/* Rectangles in front of a renderer, and where their colours are found again. */
#ifndef TESTS_UNIT_CARDS_H
#define TESTS_UNIT_CARDS_H

#include "renderer.h"

/* Draws 4 units high at the origin: x and y in -2 .. 2 in a square picture. */
static inline struct render_view square_view(void)
{
    return (struct render_view){.width = 200, .height = 200, .order = RENDER_SORT, .camera = front_camera()};
}

/* Rectangles that face the viewer: two triangles each, without normals. */
struct cards {
    struct mesh mesh;
    double position[16][3];
    uint32_t triangle[8][3];
    float opacity[8];
};

static inline void add_card(struct cards *cards, double left, double below, double right, double above,
                            double z)
{
    uint32_t p = cards->mesh.point_count, t = cards->mesh.triangle_count;
    for (uint32_t k = 0; k < 4; k++) {
        const double at[3] = {k == 0 || k == 3 ? left : right, k < 2 ? below : above, z};
        memcpy(cards->position[p + k], at, sizeof at);
    }
    const uint32_t triangles[2][3] = {{p, p + 1, p + 2}, {p, p + 2, p + 3}};
    memcpy(cards->triangle[t], triangles, sizeof triangles);
    cards->opacity[t] = cards->opacity[t + 1] = 1;
    cards->mesh.point_count += 4;
    cards->mesh.triangle_count += 2;
    cards->mesh.position = cards->position;
    cards->mesh.triangle = cards->triangle;
}

static inline struct render_skin skin_of(const struct cards *cards, float red, float green, float blue)
{
    return (struct render_skin){
        .mesh = &cards->mesh, .opacity = cards->opacity, .colour = {red, green, blue}};
}

static inline const unsigned char *pixel(const struct image *image, int x, int y)
{
    return image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static inline bool is_red(const unsigned char *rgb)
{
    return rgb[0] > 2 * rgb[1] && rgb[0] > 2 * rgb[2];
}

static inline bool is_blue(const unsigned char *rgb)
{
    return rgb[2] > 2 * rgb[0] && rgb[2] > 2 * rgb[1];
}

static inline void assert_same_picture(const struct image *a, const struct image *b)
{
    assert_int_equal(a->width, b->width);
    assert_memory_equal(a->rgb, b->rgb, 3 * (size_t)a->width * (size_t)a->height);
}

/* The middle of all red pixels in columns from .. to; their number is returned. */
static inline int red_middle(const struct image *image, int from, int to, double middle[2])
{
    int count = 0;
    middle[0] = middle[1] = 0;
    for (int y = 0; y < image->height; y++)
        for (int x = from; x < to; x++)
            if (is_red(pixel(image, x, y))) {
                middle[0] += x + 0.5;
                middle[1] += y + 0.5;
                count++;
            }
    middle[0] /= count;
    middle[1] /= count;
    return count;
}

#endif
