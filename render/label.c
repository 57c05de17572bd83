/* Text on a finished picture. */
#include "render/font.h"
#include "render/sheet.h"

#include <string.h>

static void fill(struct image *image, int x, int y, int side)
{
    for (int row = y < 0 ? 0 : y; row < y + side && row < image->height; row++)
        for (int column = x < 0 ? 0 : x; column < x + side && column < image->width; column++)
            memset(image->rgb + 3 * ((size_t)row * (size_t)image->width + (size_t)column), 0x38, 3);
}

void label_draw(struct image *image, int x, int y, int scale, const char *text)
{
    for (; *text; x += (FONT_WIDTH + 1) * scale) {
        const uint64_t dots = font_next(&text);
        for (int i = 0; i < FONT_WIDTH * FONT_HEIGHT; i++)
            if (dots >> i & 1)
                fill(image, x + i % FONT_WIDTH * scale, y + i / FONT_WIDTH * scale, scale);
    }
}
