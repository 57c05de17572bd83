/*
 * The OpenGL functions that the drawing uses, of version 3.3 but for two, called through pointers that
 * belong to one context: so one process can draw off-screen and in a window at once, whichever library
 * the context comes from.
 */
#ifndef RENDER_GL_H
#define RENDER_GL_H

#include "common/status.h"

#include <GL/glcorearb.h>

#define GL_FUNCTIONS(X)                                               \
    X(ActiveTexture, ACTIVETEXTURE)                                   \
    X(AttachShader, ATTACHSHADER)                                     \
    X(BeginQuery, BEGINQUERY)                                         \
    X(BindBuffer, BINDBUFFER)                                         \
    X(BindBufferBase, BINDBUFFERBASE)                                 \
    X(BindFramebuffer, BINDFRAMEBUFFER)                               \
    X(BindRenderbuffer, BINDRENDERBUFFER)                             \
    X(BindTexture, BINDTEXTURE)                                       \
    X(BindVertexArray, BINDVERTEXARRAY)                               \
    X(BlendFunc, BLENDFUNC)                                           \
    X(BlitFramebuffer, BLITFRAMEBUFFER)                               \
    X(BufferData, BUFFERDATA)                                         \
    X(BufferSubData, BUFFERSUBDATA)                                   \
    X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)                 \
    X(Clear, CLEAR)                                                   \
    X(ClearBufferfv, CLEARBUFFERFV)                                   \
    X(ColorMask, COLORMASK)                                           \
    X(CompileShader, COMPILESHADER)                                   \
    X(CopyTexImage2D, COPYTEXIMAGE2D)                                 \
    X(CopyTexSubImage2D, COPYTEXSUBIMAGE2D)                           \
    X(CreateProgram, CREATEPROGRAM)                                   \
    X(CreateShader, CREATESHADER)                                     \
    X(DeleteBuffers, DELETEBUFFERS)                                   \
    X(DeleteFramebuffers, DELETEFRAMEBUFFERS)                         \
    X(DeleteProgram, DELETEPROGRAM)                                   \
    X(DeleteQueries, DELETEQUERIES)                                   \
    X(DeleteRenderbuffers, DELETERENDERBUFFERS)                       \
    X(DeleteShader, DELETESHADER)                                     \
    X(DeleteTextures, DELETETEXTURES)                                 \
    X(DeleteVertexArrays, DELETEVERTEXARRAYS)                         \
    X(DepthFunc, DEPTHFUNC)                                           \
    X(DepthMask, DEPTHMASK)                                           \
    X(Disable, DISABLE)                                               \
    X(DrawArrays, DRAWARRAYS)                                         \
    X(DrawBuffer, DRAWBUFFER)                                         \
    X(DrawBuffers, DRAWBUFFERS)                                       \
    X(DrawElements, DRAWELEMENTS)                                     \
    X(Enable, ENABLE)                                                 \
    X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY)               \
    X(EndQuery, ENDQUERY)                                             \
    X(Finish, FINISH)                                                 \
    X(Flush, FLUSH)                                                   \
    X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER)               \
    X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D)                     \
    X(GenBuffers, GENBUFFERS)                                         \
    X(GenFramebuffers, GENFRAMEBUFFERS)                               \
    X(GenQueries, GENQUERIES)                                         \
    X(GenRenderbuffers, GENRENDERBUFFERS)                             \
    X(GenTextures, GENTEXTURES)                                       \
    X(GenVertexArrays, GENVERTEXARRAYS)                               \
    X(GetBufferSubData, GETBUFFERSUBDATA)                             \
    X(GetError, GETERROR)                                             \
    X(GetIntegerv, GETINTEGERV)                                       \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)                           \
    X(GetProgramiv, GETPROGRAMIV)                                     \
    X(GetQueryObjectuiv, GETQUERYOBJECTUIV)                           \
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
    X(TexImage2D, TEXIMAGE2D)                                         \
    X(TexParameteri, TEXPARAMETERI)                                   \
    X(Uniform1f, UNIFORM1F)                                           \
    X(Uniform1i, UNIFORM1I)                                           \
    X(Uniform1ui, UNIFORM1UI)                                         \
    X(Uniform2f, UNIFORM2F)                                           \
    X(Uniform2i, UNIFORM2I)                                           \
    X(Uniform4i, UNIFORM4I)                                           \
    X(Uniform3fv, UNIFORM3FV)                                         \
    X(UniformMatrix4fv, UNIFORMMATRIX4FV)                             \
    X(UseProgram, USEPROGRAM)                                         \
    X(VertexAttribIPointer, VERTEXATTRIBIPOINTER)                     \
    X(VertexAttribPointer, VERTEXATTRIBPOINTER)                       \
    X(Viewport, VIEWPORT)

/* Those of version 4.3, or NULL. */
#define GL_LATER_FUNCTIONS(X)           \
    X(ClearBufferData, CLEARBUFFERDATA) \
    X(MemoryBarrier, MEMORYBARRIER)

struct gl {
#define GL_MEMBER(name, type) PFNGL##type##PROC name;
    GL_FUNCTIONS(GL_MEMBER)
    GL_LATER_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};

/* Finds a function of the current context by its name ("glClear"), or NULL. */
typedef void (*gl_function)(void);
typedef gl_function gl_finder(const char *name);

/* Fills *gl for the current context. Errors: STATUS_RESOURCE, naming the function that is missing or the
 * version where it is below 3.3. */
enum status gl_load(struct gl *gl, gl_finder *find, struct error *err);

#endif
