/* Makes balloon-sim's man page when the project is built: manual TEMPLATE puts the scene's keys, from the table that the
 * program itself goes by, in place of the line @KEYS@. */
#include "common/scene.h"

#include <stdio.h>
#include <string.h>

int main(int argc, char **argv)
{
    FILE *template = argc == 2 ? fopen(argv[1], "r") : NULL;
    if (!template) {
        fprintf(stderr, "usage: manual TEMPLATE\n");
        return 2;
    }
    char line[1024];
    while (fgets(line, sizeof line, template))
        if (strcmp(line, "@KEYS@\n"))
            fputs(line, stdout);
        else
            scene_write_mdoc(stdout);
    return fclose(template) || fflush(stdout);
}
