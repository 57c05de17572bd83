#include "render/draw.h"

#include "render/program.h"
#include "render/shaders.h"

#include <string.h>

static void describe(const struct gl *gl, GLuint location, int size, GLenum type, size_t offset)
{
    gl->EnableVertexAttribArray(location);
    gl->VertexAttribPointer(location, size, type, type != GL_FLOAT, sizeof(struct geometry_vertex),
                            (const void *)offset);
}

static void describe_vertices(struct draw *draw, const struct gl *gl)
{
    GLuint arrays[2], buffers[2];
    gl->GenVertexArrays(2, arrays);
    gl->GenBuffers(2, buffers);
    draw->arrays = arrays[0];
    draw->nothing = arrays[1];
    draw->vertices = buffers[0];
    draw->indices = buffers[1];
    gl->BindVertexArray(draw->arrays);
    gl->BindBuffer(GL_ARRAY_BUFFER, draw->vertices);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->indices);
    describe(gl, SHADER_POSITION, 3, GL_FLOAT, offsetof(struct geometry_vertex, position));
    describe(gl, SHADER_NORMAL, 3, GL_FLOAT, offsetof(struct geometry_vertex, normal));
    describe(gl, SHADER_OPACITY, 1, GL_FLOAT, offsetof(struct geometry_vertex, opacity));
    describe(gl, SHADER_SHININESS, 1, GL_FLOAT, offsetof(struct geometry_vertex, shininess));
    describe(gl, SHADER_COLOUR, 3, GL_UNSIGNED_SHORT, offsetof(struct geometry_vertex, colour));
}

enum status draw_open(struct draw *draw, const struct gl *gl, struct error *err)
{
    enum status status = program_link(gl, shader_skin_vertex, shader_skin_fragment, &draw->skin, err);
    if (!status)
        status = program_link(gl, shader_backdrop_vertex, shader_backdrop_fragment, &draw->backdrop, err);
    if (!status)
        status = program_link(gl, shader_shadow_vertex, shader_shadow_fragment, &draw->shadow, err);
    if (status) {
        draw_close(draw, gl);
        return status;
    }
    draw->skin_projection = gl->GetUniformLocation(draw->skin, "projection");
    draw->skin_eye = gl->GetUniformLocation(draw->skin, "eye");
    draw->shadow_projection = gl->GetUniformLocation(draw->shadow, "projection");
    draw->shadow_corner = gl->GetUniformLocation(draw->shadow, "corner");
    draw->shadow_left = gl->GetUniformLocation(draw->shadow, "left");
    describe_vertices(draw, gl);
    return STATUS_OK;
}

void draw_close(struct draw *draw, const struct gl *gl)
{
    const GLuint arrays[] = {draw->arrays, draw->nothing}, buffers[] = {draw->vertices, draw->indices};
    if (draw->arrays)
        gl->DeleteVertexArrays(2, arrays);
    if (draw->vertices)
        gl->DeleteBuffers(2, buffers);
    gl->DeleteProgram(draw->skin);
    gl->DeleteProgram(draw->backdrop);
    gl->DeleteProgram(draw->shadow);
    *draw = (struct draw){0};
}

void draw_upload(const struct draw *draw, const struct gl *gl, const struct geometry *g)
{
    gl->BindVertexArray(draw->arrays);
    gl->BindBuffer(GL_ARRAY_BUFFER, draw->vertices);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(g->vertices.count * sizeof *g->vertices.items),
                   g->vertices.items, GL_STREAM_DRAW);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(g->indices.count * sizeof *g->indices.items),
                   g->indices.items, GL_STREAM_DRAW);
}

static void draw_backdrop(const struct draw *draw, const struct gl *gl)
{
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_BLEND);
    gl->UseProgram(draw->backdrop);
    gl->BindVertexArray(draw->nothing);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

static void draw_shadow(const struct draw *draw, const struct gl *gl, const float projection[16],
                        const struct geometry_shadow *shadow)
{
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_DST_COLOR, GL_ZERO);
    gl->UseProgram(draw->shadow);
    gl->UniformMatrix4fv(draw->shadow_projection, 1, GL_FALSE, projection);
    gl->Uniform3fv(draw->shadow_corner, 4, shadow->corner[0]);
    gl->Uniform3fv(draw->shadow_left, 1, shadow->colour);
    gl->BindVertexArray(draw->nothing);
    gl->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

/* Opaque triangles hide by depth; translucent ones are hidden by those, and lie over one another in their order. The shader gives the
 * light to add and the share of each colour to keep of what lies behind. */
static void draw_skins(const struct draw *draw, const struct gl *gl, const float projection[16],
                       const float eye[3], const struct geometry *g)
{
    gl->Enable(GL_DEPTH_TEST);
    gl->Disable(GL_BLEND);
    gl->UseProgram(draw->skin);
    gl->UniformMatrix4fv(draw->skin_projection, 1, GL_FALSE, projection);
    gl->Uniform3fv(draw->skin_eye, 1, eye);
    gl->BindVertexArray(draw->arrays);
    if (g->opaque.count)
        gl->DrawElements(GL_TRIANGLES, (GLsizei)(3 * g->opaque.count), GL_UNSIGNED_INT, NULL);
    if (!g->translucent.count)
        return;
    gl->DepthMask(GL_FALSE);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_ONE, GL_SRC1_COLOR);
    gl->DrawElements(GL_TRIANGLES, (GLsizei)(3 * g->translucent.count), GL_UNSIGNED_INT,
                     (const void *)(3 * g->opaque.count * sizeof(uint32_t)));
    gl->DepthMask(GL_TRUE);
}

void draw_behind(const struct draw *draw, const struct gl *gl, const struct render_view *view,
                 const struct camera_eye *eye, const struct geometry *geometry, int below)
{
    float projection[16];
    camera_projection(eye, geometry->nearest, geometry->farthest, projection);
    gl->Viewport(eye->left, -below, eye->width, view->height);
    gl->Enable(GL_FRAMEBUFFER_SRGB);
    draw_backdrop(draw, gl);
    if (geometry->shadow.visible)
        draw_shadow(draw, gl, projection, &geometry->shadow);
    gl->DepthMask(GL_TRUE);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
}

void draw_eye(const struct draw *draw, const struct gl *gl, const struct camera_eye *eye,
              const struct geometry *geometry)
{
    float projection[16];
    const float at[3] = {(float)eye->offset, 0, 0};
    camera_projection(eye, geometry->nearest, geometry->farthest, projection);
    draw_skins(draw, gl, projection, at, geometry);
}
