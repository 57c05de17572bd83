#include "render/target.h"

#include "common/array.h"

#include <stdlib.h>

static GLuint new_buffer(const struct gl *gl, const struct target *target, int samples, GLenum format,
                         GLenum attachment)
{
    GLuint buffer;
    gl->GenRenderbuffers(1, &buffer);
    gl->BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, target->width,
                                       target->height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
    return buffer;
}

static void make_buffers(struct target *target, const struct gl *gl)
{
    if (target->samples > 1) {
        gl->GenFramebuffers(1, &target->resolved);
        gl->BindFramebuffer(GL_FRAMEBUFFER, target->resolved);
        target->resolved_colour = new_buffer(gl, target, 1, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
    }
    gl->GenFramebuffers(1, &target->drawn);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->drawn);
    target->colour = new_buffer(gl, target, target->samples, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
    target->depth = new_buffer(gl, target, target->samples, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
}

enum status target_bind(struct target *target, const struct gl *gl, int width, int height, int samples,
                        struct error *err)
{
    if (target->drawn && target->width == width && target->height == height && target->samples == samples) {
        gl->BindFramebuffer(GL_FRAMEBUFFER, target->drawn);
        return STATUS_OK;
    }
    target_clear(target, gl);
    while (gl->GetError() != GL_NO_ERROR)
        ;
    target->width = width;
    target->height = height;
    target->samples = samples;
    make_buffers(target, gl);
    GLenum problem = gl->GetError();
    GLenum complete = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (problem == GL_NO_ERROR && complete == GL_FRAMEBUFFER_COMPLETE)
        return STATUS_OK;
    target_clear(target, gl);
    if (problem == GL_OUT_OF_MEMORY)
        return error_no_memory(err, "a picture of this size");
    return error_set(err, STATUS_RESOURCE,
                     "this OpenGL cannot draw a picture of %d x %d with %d samples a pixel", width, height,
                     samples);
}

GLuint target_read_from(const struct target *target)
{
    return target->resolved ? target->resolved : target->drawn;
}

void target_bind_drawn(const struct target *target, const struct gl *gl)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->drawn);
}

void target_bind_resolved(const struct target *target, const struct gl *gl)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->resolved);
}

void target_resolve(const struct target *target, const struct gl *gl, const int box[4])
{
    int right = box[0] + box[2], top = box[1] + box[3];
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target->drawn);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target->resolved);
    gl->BlitFramebuffer(box[0], box[1], right, top, box[0], box[1], right, top, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
}

static void copy_rows(const struct target *target, struct image *out, int below, int rows)
{
    size_t width = (size_t)target->width;
    for (int y = 0; y < rows; y++) {
        const unsigned char *from = target->pixels + 4 * width * (size_t)y;
        unsigned char *to = out->rgb + 3 * width * (size_t)(out->height - 1 - below - y);
        for (size_t x = 0; x < width; x++) {
            to[3 * x] = from[4 * x];
            to[3 * x + 1] = from[4 * x + 1];
            to[3 * x + 2] = from[4 * x + 2];
        }
    }
}

enum status target_read(struct target *target, const struct gl *gl, struct image *out, int below, int rows,
                        struct error *err)
{
    if (!target->pixels)
        target->pixels = array_new((size_t)target->width * (size_t)target->height, 4);
    if (!target->pixels)
        return error_no_memory(err, "the picture");
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target_read_from(target));
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->ReadPixels(0, 0, target->width, rows, GL_RGBA, GL_UNSIGNED_BYTE, target->pixels);
    copy_rows(target, out, below, rows);
    return STATUS_OK;
}

/* The bytes are copied as they are: a window shows sRGB whether or not it knows. */
void target_show(const struct target *target, const struct gl *gl, GLenum buffer, int below, int rows)
{
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target_read_from(target));
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl->DrawBuffer(buffer);
    gl->Disable(GL_FRAMEBUFFER_SRGB);
    gl->BlitFramebuffer(0, 0, target->width, rows, 0, below, target->width, below + rows, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
}

void target_clear(struct target *target, const struct gl *gl)
{
    const GLuint framebuffers[] = {target->drawn, target->resolved};
    const GLuint buffers[] = {target->colour, target->depth, target->resolved_colour};
    gl->DeleteFramebuffers(2, framebuffers);
    gl->DeleteRenderbuffers(3, buffers);
    free(target->pixels);
    *target = (struct target){0};
}
