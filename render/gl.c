#include "render/gl.h"

enum status gl_load(struct gl *gl, gl_finder *find, struct error *err)
{
#define GL_FIND(name, type)                         \
    gl->name = (PFNGL##type##PROC)find("gl" #name); \
    if (!gl->name)                                  \
        return error_set(err, STATUS_RESOURCE, "OpenGL lacks gl" #name "; version 3.3 or later is needed");
    GL_FUNCTIONS(GL_FIND)
#undef GL_FIND
#define GL_TRY(name, type) gl->name = (PFNGL##type##PROC)find("gl" #name);
    GL_LATER_FUNCTIONS(GL_TRY)
#undef GL_TRY
    GLint major = 0, minor = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major < 3 || (major == 3 && minor < 3))
        return error_set(err, STATUS_RESOURCE, "OpenGL is version %d.%d; 3.3 or later is needed", major,
                         minor);
    return STATUS_OK;
}
