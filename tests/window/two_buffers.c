/* To be preloaded: a screen that has a buffer for each eye, as far as freeglut tells. What is drawn into
 * which goes to the file `buffers`, a line each time; only the right one is seen. */
#define _GNU_SOURCE 1
#include <dlfcn.h>
#include <GL/freeglut.h>
#include <stdio.h>
#include <string.h>

typedef void draw_buffer(GLenum buffer);
typedef GLUTproc find_function(const char *name);
static draw_buffer *real_draw_buffer;

static void *real(const char *name)
{
    return dlsym(RTLD_NEXT, name);
}

static void note_buffer(GLenum buffer)
{
    FILE *file = fopen("buffers", "a");
    if (file) {
        fputs(buffer == GL_BACK_LEFT ? "left\n" : buffer == GL_BACK_RIGHT ? "right\n" : "both\n", file);
        fclose(file);
    }
    real_draw_buffer(buffer == GL_BACK_LEFT ? GL_NONE : GL_BACK);
}

GLUTproc glutGetProcAddress(const char *name)
{
    find_function *find;
    *(void **)&find = real(__func__);
    if (strcmp(name, "glDrawBuffer") != 0)
        return find(name);
    real_draw_buffer = (draw_buffer *)find(name);
    return (GLUTproc)note_buffer;
}

int glutGet(GLenum what)
{
    int (*get)(GLenum);
    *(void **)&get = real(__func__);
    return what == GLUT_WINDOW_STEREO || what == GLUT_DISPLAY_MODE_POSSIBLE ? 1 : get(what);
}

void glutInitDisplayMode(unsigned mode)
{
    void (*init)(unsigned);
    *(void **)&init = real(__func__);
    init(mode & ~(unsigned)GLUT_STEREO);
}
