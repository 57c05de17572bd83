#include "render/light.h"

#include "render/program.h"
#include "render/shaders.h"

enum status light_open(struct light *light, const struct gl *gl, struct error *err)
{
    enum status status = program_link(gl, shader_whole_vertex, shader_tone_fragment, &light->tone, err);
    if (!status)
        status = program_link(gl, shader_whole_vertex, shader_layer_fragment, &light->compose, err);
    GLint major = 0, minor = 0, most = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    light->lists = 10 * major + minor >= 43 && gl->MemoryBarrier && gl->ClearBufferData;
    if (!status && light->lists)
        status = program_link(gl, shader_whole_vertex, shader_list_fragment, &light->list, err);
    if (status) {
        light_close(light, gl);
        return status;
    }
    if (light->lists) {
        gl->GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
        light->most = (size_t)most / (LIGHT_NODE_WORDS * sizeof(uint32_t));
        light->list_width = gl->GetUniformLocation(light->list, "width");
    }
    light->tone_corner = gl->GetUniformLocation(light->tone, "corner");
    light->tone_side = gl->GetUniformLocation(light->tone, "side");
    light->tone_exposure = gl->GetUniformLocation(light->tone, "exposure");
    gl->UseProgram(light->compose);
    gl->Uniform1i(gl->GetUniformLocation(light->compose, "layer_passing"), 1);
    gl->GenVertexArrays(1, &light->nothing);
    return STATUS_OK;
}

static void clear_pictures(struct light *light, const struct gl *gl)
{
    const GLuint framebuffers[] = {light->drawn, light->layer, light->smooth};
    gl->DeleteFramebuffers(3, framebuffers);
    gl->DeleteTextures(LIGHT_TEXTURES, light->texture);
    gl->DeleteRenderbuffers(2, light->smooth_buffers);
    light->drawn = light->layer = light->smooth = 0;
    light->smooth_buffers[0] = light->smooth_buffers[1] = 0;
    for (int i = 0; i < LIGHT_TEXTURES; i++)
        light->texture[i] = 0;
    light->width = light->height = 0;
}

void light_close(struct light *light, const struct gl *gl)
{
    const GLuint buffers[] = {light->heads, light->nodes};
    clear_pictures(light, gl);
    gl->DeleteBuffers(2, buffers);
    if (light->nothing)
        gl->DeleteVertexArrays(1, &light->nothing);
    if (light->query)
        gl->DeleteQueries(1, &light->query);
    gl->DeleteProgram(light->tone);
    gl->DeleteProgram(light->compose);
    gl->DeleteProgram(light->list);
    *light = (struct light){0};
}

void light_texture_new(struct light *light, const struct gl *gl, enum light_texture which)
{
    const bool depth = which == LIGHT_DEPTH || which == LIGHT_PEELED || which == LIGHT_PEELED_TOO;
    gl->GenTextures(1, &light->texture[which]);
    gl->BindTexture(GL_TEXTURE_2D, light->texture[which]);
    gl->TexImage2D(GL_TEXTURE_2D, 0, depth ? GL_DEPTH_COMPONENT32F : GL_RGBA16F, light->width, light->height,
                   0, depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, NULL);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void make_smooth(struct light *light, const struct gl *gl)
{
    static const GLenum formats[] = {GL_RGBA16F, GL_DEPTH_COMPONENT24};
    static const GLenum places[] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    gl->GenFramebuffers(1, &light->smooth);
    gl->BindFramebuffer(GL_FRAMEBUFFER, light->smooth);
    gl->GenRenderbuffers(2, light->smooth_buffers);
    for (int i = 0; i < 2; i++) {
        gl->BindRenderbuffer(GL_RENDERBUFFER, light->smooth_buffers[i]);
        gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, light->samples, formats[i], light->width,
                                           light->height);
        gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, light->smooth_buffers[i]);
    }
}

static void make_pictures(struct light *light, const struct gl *gl)
{
    light_texture_new(light, gl, LIGHT_COLOUR);
    light_texture_new(light, gl, LIGHT_DEPTH);
    gl->GenFramebuffers(1, &light->drawn);
    gl->BindFramebuffer(GL_FRAMEBUFFER, light->drawn);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                             light->texture[LIGHT_COLOUR], 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, light->texture[LIGHT_DEPTH],
                             0);
    if (light->samples > 1)
        make_smooth(light, gl);
}

/* Sides grow in steps, so that a balloon that swells does not make a new picture for every frame. */
static int stepped(int wanted, int have)
{
    const int step = 128;
    return wanted <= have ? have : (wanted + step - 1) / step * step;
}

enum status light_bind(struct light *light, const struct gl *gl, int width, int height, int samples,
                       struct error *err)
{
    light->strip[0] = width;
    light->strip[1] = height;
    if (width > light->width || height > light->height || samples != light->samples) {
        const int wide = stepped(width, light->width), high = stepped(height, light->height);
        clear_pictures(light, gl);
        while (gl->GetError() != GL_NO_ERROR)
            ;
        light->width = wide;
        light->height = high;
        light->samples = samples;
        make_pictures(light, gl);
        const GLenum problem = gl->GetError();
        const GLenum complete = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
        if (problem != GL_NO_ERROR || complete != GL_FRAMEBUFFER_COMPLETE) {
            clear_pictures(light, gl);
            if (problem == GL_OUT_OF_MEMORY)
                return error_no_memory(err, "a picture of this size");
            return error_set(err, STATUS_RESOURCE, "this OpenGL cannot draw half floats of %d x %d", wide,
                             high);
        }
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, light->smooth ? light->smooth : light->drawn);
    return STATUS_OK;
}

void light_finish(const struct light *light, const struct gl *gl)
{
    const int *strip = light->strip;
    if (!light->smooth)
        return;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, light->smooth);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, light->drawn);
    gl->BlitFramebuffer(0, 0, strip[0], strip[1], 0, 0, strip[0], strip[1], GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void light_tone(const struct light *light, const struct gl *gl, const int corner[2], int side, float exposure)
{
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_BLEND);
    gl->UseProgram(light->tone);
    gl->Uniform2i(light->tone_corner, corner[0], corner[1]);
    gl->Uniform1i(light->tone_side, side);
    gl->Uniform1f(light->tone_exposure, exposure);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, light->texture[LIGHT_COLOUR]);
    gl->BindVertexArray(light->nothing);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}
