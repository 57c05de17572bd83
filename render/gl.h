/*
 * The OpenGL 3.3 functions that the drawing uses, called through pointers that belong to one context: so one
 * process can draw off-screen and in a window at once, whichever library the context comes from.
 */
#ifndef RENDER_GL_H
#define RENDER_GL_H

#include "common/status.h"

#include <GL/glcorearb.h>

#define GL_FUNCTIONS(X)                                               \
    X(AttachShader, ATTACHSHADER)                                     \
    X(BindBuffer, BINDBUFFER)                                         \
    X(BindFramebuffer, BINDFRAMEBUFFER)                               \
    X(BindRenderbuffer, BINDRENDERBUFFER)                             \
    X(BindVertexArray, BINDVERTEXARRAY)                               \
    X(BlendFunc, BLENDFUNC)                                           \
    X(BlitFramebuffer, BLITFRAMEBUFFER)                               \
    X(BufferData, BUFFERDATA)                                         \
    X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)                 \
    X(Clear, CLEAR)                                                   \
    X(CompileShader, COMPILESHADER)                                   \
    X(CreateProgram, CREATEPROGRAM)                                   \
    X(CreateShader, CREATESHADER)                                     \
    X(DeleteBuffers, DELETEBUFFERS)                                   \
    X(DeleteFramebuffers, DELETEFRAMEBUFFERS)                         \
    X(DeleteProgram, DELETEPROGRAM)                                   \
    X(DeleteRenderbuffers, DELETERENDERBUFFERS)                       \
    X(DeleteShader, DELETESHADER)                                     \
    X(DeleteVertexArrays, DELETEVERTEXARRAYS)                         \
    X(DepthMask, DEPTHMASK)                                           \
    X(Disable, DISABLE)                                               \
    X(DrawArrays, DRAWARRAYS)                                         \
    X(DrawElements, DRAWELEMENTS)                                     \
    X(Enable, ENABLE)                                                 \
    X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY)               \
    X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER)               \
    X(GenBuffers, GENBUFFERS)                                         \
    X(GenFramebuffers, GENFRAMEBUFFERS)                               \
    X(GenRenderbuffers, GENRENDERBUFFERS)                             \
    X(GenVertexArrays, GENVERTEXARRAYS)                               \
    X(GetError, GETERROR)                                             \
    X(GetIntegerv, GETINTEGERV)                                       \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)                           \
    X(GetProgramiv, GETPROGRAMIV)                                     \
    X(GetShaderInfoLog, GETSHADERINFOLOG)                             \
    X(GetShaderiv, GETSHADERIV)                                       \
    X(GetUniformLocation, GETUNIFORMLOCATION)                         \
    X(LinkProgram, LINKPROGRAM)                                       \
    X(MultiDrawElements, MULTIDRAWELEMENTS)                           \
    X(PixelStorei, PIXELSTOREI)                                       \
    X(ReadPixels, READPIXELS)                                         \
    X(RenderbufferStorageMultisample, RENDERBUFFERSTORAGEMULTISAMPLE) \
    X(Scissor, SCISSOR)                                               \
    X(ShaderSource, SHADERSOURCE)                                     \
    X(Uniform1f, UNIFORM1F)                                           \
    X(Uniform2f, UNIFORM2F)                                           \
    X(Uniform3fv, UNIFORM3FV)                                         \
    X(UniformMatrix4fv, UNIFORMMATRIX4FV)                             \
    X(UseProgram, USEPROGRAM)                                         \
    X(VertexAttribIPointer, VERTEXATTRIBIPOINTER)                     \
    X(VertexAttribPointer, VERTEXATTRIBPOINTER)                       \
    X(Viewport, VIEWPORT)

struct gl {
#define GL_MEMBER(name, type) PFNGL##type##PROC name;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};

/* Finds a function of the current context by its name ("glClear"), or NULL. */
typedef void (*gl_function)(void);
typedef gl_function gl_finder(const char *name);

/* Fills *gl for the current context. Errors: STATUS_RESOURCE, naming the function that is missing or the
 * version where it is below 3.3. */
enum status gl_load(struct gl *gl, gl_finder *find, struct error *err);

#endif
