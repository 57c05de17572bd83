#include "common/spelling.h"

#include <stdbool.h>
#include <string.h>

/* Levenshtein's distance, for names short enough. */
static size_t distance_of(const char *a, const char *b)
{
    enum { LONGEST = 40 };
    size_t row[LONGEST + 1], length = strlen(b);
    if (strlen(a) > LONGEST || length > LONGEST)
        return LONGEST;
    for (size_t j = 0; j <= length; j++)
        row[j] = j;
    for (size_t i = 1; a[i - 1]; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= length; j++) {
            size_t change = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            size_t gap = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            row[j] = change < gap ? change : gap;
        }
    }
    return row[length];
}

/* Of names one of which is a part of the other, as density is of air_density, a slip of two letters. */
static size_t distance_or_part(const char *wrong, const char *name)
{
    enum { SHORTEST = 4, PART = 2 };
    const size_t distance = distance_of(wrong, name);
    const bool part = strlen(wrong) >= SHORTEST && strlen(name) >= SHORTEST &&
                      (strstr(name, wrong) || strstr(wrong, name));
    return part && distance > PART ? PART : distance;
}

struct spelling spelling_of(const char *wrong)
{
    return (struct spelling){wrong, NULL, strlen(wrong) / 2 + 1};
}

void spelling_consider(struct spelling *guess, const char *name)
{
    const size_t distance = distance_or_part(guess->wrong, name);
    if (distance < guess->distance) {
        guess->nearest = name;
        guess->distance = distance;
    }
}
