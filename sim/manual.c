/* Makes balloon-sim's man page when the project is built: manual TEMPLATE puts the scene's keys, from the
 * table that the program itself goes by, in place of the line @KEYS@, and breaks lines of text that are
 * longer than 80 bytes, as mandoc -T lint wants them. */
#include "common/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 79 };

/* A line of text in lines of at most WIDTH bytes. Of the table's words ("Phys.
 * Rev.") none ends a sentence. */
static void put_text(char *line, bool sentences)
{
    size_t used = 0;
    char *rest;
    for (char *word = strtok_r(line, " \n", &rest); word; word = strtok_r(NULL, " \n", &rest)) {
        const bool dotted = !sentences && word[strlen(word) - 1] == '.';
        const size_t length = strlen(word) + (dotted ? 2 : 0);
        if (used > 0) {
            const bool breaks = used + 1 + length > WIDTH;
            putchar(breaks ? '\n' : ' ');
            used = breaks ? 0 : used + 1;
            if (breaks && (*word == '.' || *word == '\''))
                fputs("\\&", stdout);
        }
        printf("%s%s", word, dotted ? "\\&" : "");
        used += length;
    }
    putchar('\n');
}

static void put_keys(void)
{
    FILE *keys = tmpfile();
    char *line = NULL;
    size_t size = 0;
    if (!keys) {
        perror("manual: a temporary file");
        exit(1);
    }
    scene_write_mdoc(keys);
    rewind(keys);
    while (getline(&line, &size, keys) >= 0)
        if (*line == '.')
            fputs(line, stdout);
        else
            put_text(line, false);
    free(line);
    fclose(keys);
}

int main(int argc, char **argv)
{
    FILE *template = argc == 2 ? fopen(argv[1], "r") : NULL;
    if (!template) {
        fprintf(stderr, "usage: manual TEMPLATE\n");
        return 2;
    }
    char *line = NULL;
    size_t size = 0;
    bool display = false; /* within .Bd -literal lines stay as they are */
    while (getline(&line, &size, template) >= 0) {
        if (!strncmp(line, ".Bd", 3) || !strncmp(line, ".Ed", 3))
            display = line[1] == 'B' && line[2] == 'd';
        if (!strcmp(line, "@KEYS@\n"))
            put_keys();
        else if (display || *line == '.')
            fputs(line, stdout);
        else
            put_text(line, true);
    }
    free(line);
    return fclose(template) || fflush(stdout);
}
