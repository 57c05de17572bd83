/* Just letters enough to write a time. */
#include "render/sheet.h"

#include <string.h>

enum { LETTER_WIDTH = 5 };

static const struct letter {
    char code;
    const char *rows[LABEL_HEIGHT];
} letters[] = {
    {'0', {" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    {'2', {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"}},
    {'3', {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}},
    {'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "   # ", "  #  ", "  #  ", "  #  "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", "     ", "  #  "}},
    {'-', {"     ", "     ", "     ", " ### ", "     ", "     ", "     "}},
    {'+', {"     ", "  #  ", "  #  ", "#####", "  #  ", "  #  ", "     "}},
    {'e', {"     ", "     ", " ### ", "#   #", "#####", "#    ", " ### "}},
    {'s', {"     ", "     ", " ####", "#    ", " ### ", "    #", "#### "}},
};

static void fill(struct image *image, int x, int y, int side)
{
    for (int row = y < 0 ? 0 : y; row < y + side && row < image->height; row++)
        for (int column = x < 0 ? 0 : x; column < x + side && column < image->width; column++)
            memset(image->rgb + 3 * ((size_t)row * (size_t)image->width + (size_t)column), 0x38, 3);
}

static void draw_letter(struct image *image, int x, int y, int scale, const struct letter *letter)
{
    for (int row = 0; row < LABEL_HEIGHT; row++)
        for (int column = 0; column < LETTER_WIDTH; column++)
            if (letter->rows[row][column] == '#')
                fill(image, x + column * scale, y + row * scale, scale);
}

void label_draw(struct image *image, int x, int y, int scale, const char *text)
{
    for (; *text; text++, x += (LETTER_WIDTH + 1) * scale)
        for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
            if (letters[i].code == *text)
                draw_letter(image, x, y, scale, &letters[i]);
}
