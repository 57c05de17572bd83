#include "render/behind.h"

#include <string.h>

static void copy(const struct gl *gl, GLuint from, GLuint to, const int r[4])
{
    const int right = r[0] + r[2], top = r[1] + r[3];
    gl->Disable(GL_SCISSOR_TEST);
    gl->Enable(GL_FRAMEBUFFER_SRGB); /* both are sRGB: else Mesa draws instead of copying */
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, from);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    gl->BlitFramebuffer(r[0], r[1], right, top, r[0], r[1], right, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

static bool holds(const struct behind *behind, const int rectangle[4])
{
    for (int i = 0; i < behind->count; i++)
        if (!memcmp(behind->kept[i], rectangle, sizeof behind->kept[i]))
            return true;
    return false;
}

static void make(struct behind *behind, const struct gl *gl, int width, int height)
{
    behind_clear(behind, gl);
    behind->width = width;
    behind->height = height;
    gl->GenFramebuffers(1, &behind->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, behind->framebuffer);
    gl->GenRenderbuffers(1, &behind->colour);
    gl->BindRenderbuffer(GL_RENDERBUFFER, behind->colour);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_SRGB8_ALPHA8, width, height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, behind->colour);
}

bool behind_fetch(struct behind *behind, const struct gl *gl, const struct target *target,
                  const int rectangle[4])
{
    if (behind->width != target->width || behind->height != target->height || !holds(behind, rectangle))
        return false;
    copy(gl, behind->framebuffer, target_read_from(target), rectangle);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target_read_from(target));
    return true;
}

void behind_keep(struct behind *behind, const struct gl *gl, const struct target *target,
                 const int rectangle[4])
{
    if (behind->width != target->width || behind->height != target->height)
        make(behind, gl, target->width, target->height);
    const int most = sizeof behind->kept / sizeof behind->kept[0];
    if (behind->count == most)
        behind->count = 0; /* other eyes than before */
    memcpy(behind->kept[behind->count++], rectangle, sizeof behind->kept[0]);
    copy(gl, target_read_from(target), behind->framebuffer, rectangle);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target_read_from(target));
}

void behind_clear(struct behind *behind, const struct gl *gl)
{
    gl->DeleteFramebuffers(1, &behind->framebuffer);
    gl->DeleteRenderbuffers(1, &behind->colour);
    *behind = (struct behind){0};
}
