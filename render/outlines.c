#include "render/outlines.h"

#include "render/program.h"
#include "render/shaders.h"

enum status outlines_open(struct outlines *outlines, const struct gl *gl, struct error *err)
{
    enum status status = program_link(gl, shader_whole_vertex, shader_outlines_fragment, &outlines->program,
                                      err);
    if (status) {
        outlines_close(outlines, gl);
        return status;
    }
    outlines->box = gl->GetUniformLocation(outlines->program, "box");
    gl->GenVertexArrays(1, &outlines->nothing);
    gl->GenTextures(1, &outlines->picture);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, outlines->picture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return STATUS_OK;
}

void outlines_close(struct outlines *outlines, const struct gl *gl)
{
    gl->DeleteTextures(1, &outlines->picture);
    if (outlines->nothing)
        gl->DeleteVertexArrays(1, &outlines->nothing);
    gl->DeleteProgram(outlines->program);
    *outlines = (struct outlines){0};
}

/* A pixel's neighbours are still looked at when it is drawn already. The texture has the numbers as they are,
 * and so what is drawn has. */
static void copy_picture(struct outlines *outlines, const struct gl *gl, const struct target *target,
                         const int box[4])
{
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, outlines->picture);
    if (outlines->width != target->width || outlines->height != target->height)
        gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, target->width, target->height, 0, GL_RGBA,
                       GL_UNSIGNED_BYTE, NULL);
    outlines->width = target->width;
    outlines->height = target->height;
    gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, box[0], box[1], box[0], box[1], box[2], box[3]);
}

void outlines_filter(struct outlines *outlines, const struct gl *gl, const struct target *target,
                     const int box[4])
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->drawn);
    copy_picture(outlines, gl, target, box);
    gl->Disable(GL_FRAMEBUFFER_SRGB);
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_BLEND);
    gl->Viewport(box[0], box[1], box[2], box[3]);
    gl->UseProgram(outlines->program);
    gl->Uniform4i(outlines->box, box[0], box[1], box[2], box[3]);
    gl->BindVertexArray(outlines->nothing);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->Enable(GL_FRAMEBUFFER_SRGB);
}
