#include "render/stereo.h"

#include "render/program.h"
#include "render/shaders.h"

bool stereo_is_mixed(enum render_stereo stereo)
{
    return stereo == RENDER_RED_CYAN || stereo == RENDER_INTERLACED;
}

enum status stereo_open(struct stereo *stereo, const struct gl *gl, struct error *err)
{
    enum status status = program_link(gl, shader_whole_vertex, shader_stereo_fragment, &stereo->program, err);
    if (status) {
        stereo_close(stereo, gl);
        return status;
    }
    stereo->first_row = gl->GetUniformLocation(stereo->program, "first_row");
    stereo->red_cyan = gl->GetUniformLocation(stereo->program, "red_cyan");
    gl->UseProgram(stereo->program);
    gl->Uniform1i(gl->GetUniformLocation(stereo->program, "right_picture"), 1);
    gl->GenVertexArrays(1, &stereo->nothing);
    gl->GenTextures(2, stereo->pictures);
    gl->ActiveTexture(GL_TEXTURE0);
    for (int i = 0; i < 2; i++) {
        gl->BindTexture(GL_TEXTURE_2D, stereo->pictures[i]);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    return STATUS_OK;
}

void stereo_close(struct stereo *stereo, const struct gl *gl)
{
    if (stereo->nothing)
        gl->DeleteVertexArrays(1, &stereo->nothing);
    gl->DeleteTextures(2, stereo->pictures);
    gl->DeleteProgram(stereo->program);
    *stereo = (struct stereo){0};
}

void stereo_keep(const struct stereo *stereo, const struct gl *gl, const struct target *target, int eye)
{
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target_read_from(target));
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, stereo->pictures[eye]);
    gl->CopyTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 0, 0, target->width, target->height, 0);
}

void stereo_mix(const struct stereo *stereo, const struct gl *gl, const struct target *target,
                const struct render_view *view, int below)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, target_read_from(target));
    gl->Viewport(0, 0, target->width, target->height);
    gl->Enable(GL_FRAMEBUFFER_SRGB);
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_BLEND);
    gl->UseProgram(stereo->program);
    gl->Uniform1i(stereo->first_row, view->height - 1 - below);
    gl->Uniform1i(stereo->red_cyan, view->stereo == RENDER_RED_CYAN);
    for (int i = 1; i >= 0; i--) {
        gl->ActiveTexture(GL_TEXTURE0 + (GLenum)i);
        gl->BindTexture(GL_TEXTURE_2D, stereo->pictures[i]);
    }
    gl->BindVertexArray(stereo->nothing);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}
