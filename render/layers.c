/* Translucent layers in exact order: peeled one by one, or collected in a list for each pixel. */
#include "render/light.h"

#include <stddef.h>

static void draw_over(const struct light *light, const struct gl *gl, GLuint program)
{
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_ONE, GL_SRC1_COLOR);
    gl->UseProgram(program);
    gl->BindVertexArray(light->nothing);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

static void make_layer(struct light *light, const struct gl *gl)
{
    static const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    for (int i = LIGHT_LAYER; i < LIGHT_TEXTURES; i++)
        light_texture_new(light, gl, (enum light_texture)i);
    gl->GenFramebuffers(1, &light->layer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, light->layer);
    for (int i = 0; i < 2; i++)
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, both[i], GL_TEXTURE_2D, light->texture[LIGHT_LAYER + i], 0);
    gl->DrawBuffers(2, both);
    if (!light->query)
        gl->GenQueries(1, &light->query);
}

/* Draws the farthest layer before `taken` into the layer's pictures. False when there was none. */
static bool peel_one(struct light *light, const struct gl *gl, GLuint taken, GLuint depth, light_draw *draw,
                     void *self)
{
    static const float none[4] = {0}, all[4] = {1, 1, 1, 1}, nearest = 0;
    GLuint found = 0;
    gl->BindFramebuffer(GL_FRAMEBUFFER, light->layer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    gl->DepthMask(GL_TRUE);
    gl->ClearBufferfv(GL_COLOR, 0, none);
    gl->ClearBufferfv(GL_COLOR, 1, all);
    gl->ClearBufferfv(GL_DEPTH, 0, &nearest);
    gl->BindTexture(GL_TEXTURE_2D, taken);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_GREATER);
    gl->Disable(GL_BLEND);
    gl->BlendFunc(GL_ONE, GL_ZERO); /* two sources, even unused, forbid two pictures to draw into */
    gl->BeginQuery(GL_ANY_SAMPLES_PASSED, light->query);
    draw(self, &(struct light_pass){.way = LIGHT_PEELING});
    gl->EndQuery(GL_ANY_SAMPLES_PASSED);
    gl->DepthFunc(GL_LESS);
    gl->GetQueryObjectuiv(light->query, GL_QUERY_RESULT, &found);
    return found != 0;
}

static void peel(struct light *light, const struct gl *gl, light_draw *draw, void *self)
{
    GLuint taken = light->texture[LIGHT_DEPTH], next = light->texture[LIGHT_PEELED],
           other = light->texture[LIGHT_PEELED_TOO];
    gl->ActiveTexture(GL_TEXTURE0);
    if (!light->layer) {
        make_layer(light, gl);
        next = light->texture[LIGHT_PEELED];
        other = light->texture[LIGHT_PEELED_TOO];
    }
    while (peel_one(light, gl, taken, next, draw, self)) {
        gl->BindFramebuffer(GL_FRAMEBUFFER, light->drawn);
        gl->ActiveTexture(GL_TEXTURE1);
        gl->BindTexture(GL_TEXTURE_2D, light->texture[LIGHT_PASSING]);
        gl->ActiveTexture(GL_TEXTURE0);
        gl->BindTexture(GL_TEXTURE_2D, light->texture[LIGHT_LAYER]);
        draw_over(light, gl, light->compose);
        taken = next;
        next = other;
        other = taken;
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, light->drawn);
}

static GLuint make_buffer(const struct gl *gl, GLuint *buffer, GLuint binding, size_t size)
{
    if (!*buffer)
        gl->GenBuffers(1, buffer);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, *buffer);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)size, NULL, GL_DYNAMIC_COPY);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, *buffer);
    return gl->GetError();
}

/* Fills the lists and returns how many fragments there were; those past the room are missing. */
static uint32_t fill_lists(struct light *light, const struct gl *gl, light_draw *draw, void *self)
{
    const uint32_t zero = 0;
    uint32_t used = 0;
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, light->heads);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, light->heads);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, light->nodes);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, light->heads);
    gl->ClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthMask(GL_FALSE);
    gl->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw(self, &(struct light_pass){LIGHT_LISTED, light->strip[0], (uint32_t)light->room});
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof used, &used);
    return used;
}

/* True when the lists hold every fragment. */
static bool collect(struct light *light, const struct gl *gl, light_draw *draw, void *self)
{
    const size_t node = LIGHT_NODE_WORDS * sizeof(uint32_t);
    const size_t pixels = (size_t)light->strip[0] * (size_t)light->strip[1];
    while (gl->GetError() != GL_NO_ERROR)
        ;
    if (make_buffer(gl, &light->heads, 0, (pixels + 1) * sizeof(uint32_t)))
        return false;
    size_t wanted = light->room ? light->room : 2 * pixels;
    for (;;) {
        wanted = wanted < light->most ? wanted : light->most;
        if (wanted != light->room && make_buffer(gl, &light->nodes, 1, wanted * node)) {
            light->room = 0;
            return false;
        }
        light->room = wanted;
        const uint32_t used = fill_lists(light, gl, draw, self);
        if (used <= light->room)
            return true;
        if (used > light->most)
            return false;
        wanted = used + used / 4;
    }
}

void light_layers(struct light *light, const struct gl *gl, enum render_order order, light_draw *draw,
                  void *self)
{
    if (order == RENDER_LIST && light->lists && collect(light, gl, draw, self)) {
        gl->UseProgram(light->list);
        gl->Uniform1i(light->list_width, light->strip[0]);
        draw_over(light, gl, light->list);
    } else if (order == RENDER_LIST || order == RENDER_PEEL) {
        peel(light, gl, draw, self);
    } else {
        gl->Enable(GL_DEPTH_TEST);
        gl->DepthMask(GL_FALSE);
        gl->Enable(GL_BLEND);
        gl->BlendFunc(GL_ONE, GL_SRC1_COLOR);
        draw(self, &(struct light_pass){.way = LIGHT_BLENDED});
        gl->DepthMask(GL_TRUE);
    }
}
