#include "common/array.h"
#include "render/font.h"
#include "render/overlay_draw.h"
#include "render/shaders.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float box_colour[4] = {0.02f, 0.02f, 0.025f, 0.82f};

static void describe(const struct gl *gl, GLuint location, int size, size_t stride, size_t offset)
{
    gl->EnableVertexAttribArray(location);
    gl->VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, (GLsizei)stride, (const void *)offset);
}

static void describe_lines(struct overlay *overlay, const struct gl *gl)
{
    const size_t stride = sizeof(struct overlay_line_vertex);
    gl->GenVertexArrays(1, &overlay->line_array);
    gl->GenBuffers(1, &overlay->line_buffer);
    gl->BindVertexArray(overlay->line_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, overlay->line_buffer);
    describe(gl, SHADER_LINE_FROM, 3, stride, offsetof(struct overlay_line_vertex, from));
    describe(gl, SHADER_LINE_TO, 3, stride, offsetof(struct overlay_line_vertex, to));
    describe(gl, SHADER_LINE_CORNER, 3, stride, offsetof(struct overlay_line_vertex, end));
    describe(gl, SHADER_LINE_COLOUR, 4, stride, offsetof(struct overlay_line_vertex, colour));
}

static void describe_text(struct overlay *overlay, const struct gl *gl)
{
    const size_t stride = sizeof(struct overlay_text_vertex);
    gl->GenVertexArrays(1, &overlay->text_array);
    gl->GenBuffers(1, &overlay->text_buffer);
    gl->BindVertexArray(overlay->text_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, overlay->text_buffer);
    describe(gl, SHADER_TEXT_PLACE, 2, stride, offsetof(struct overlay_text_vertex, place));
    describe(gl, SHADER_TEXT_DOT, 2, stride, offsetof(struct overlay_text_vertex, dot));
    describe(gl, SHADER_TEXT_COLOUR, 4, stride, offsetof(struct overlay_text_vertex, colour));
    gl->EnableVertexAttribArray(SHADER_TEXT_DOTS);
    gl->VertexAttribIPointer(SHADER_TEXT_DOTS, 2, GL_UNSIGNED_INT, (GLsizei)stride,
                             (const void *)offsetof(struct overlay_text_vertex, dots));
}

enum status overlay_open(struct overlay *overlay, const struct gl *gl, struct error *err)
{
    enum status status = program_link(gl, shader_line_vertex, shader_line_fragment, &overlay->line_program,
                                      err);
    if (!status)
        status = program_link(gl, shader_text_vertex, shader_text_fragment, &overlay->text_program, err);
    if (status)
        return status;
    overlay->line_projection = gl->GetUniformLocation(overlay->line_program, "projection");
    overlay->line_eye = gl->GetUniformLocation(overlay->line_program, "eye");
    overlay->line_size = gl->GetUniformLocation(overlay->line_program, "size");
    overlay->text_size = gl->GetUniformLocation(overlay->text_program, "size");
    describe_lines(overlay, gl);
    describe_text(overlay, gl);
    return STATUS_OK;
}

void overlay_close(struct overlay *overlay, const struct gl *gl)
{
    const GLuint arrays[] = {overlay->line_array, overlay->text_array};
    const GLuint buffers[] = {overlay->line_buffer, overlay->text_buffer};
    gl->DeleteVertexArrays(2, arrays);
    gl->DeleteBuffers(2, buffers);
    gl->DeleteProgram(overlay->line_program);
    gl->DeleteProgram(overlay->text_program);
    free(overlay->lines.items);
    free(overlay->text.items);
    *overlay = (struct overlay){0};
}

static enum status check_lines(const struct render_line *lines, size_t count, struct error *err)
{
    for (size_t i = 0; i < count; i++) {
        double sum = 0;
        for (int axis = 0; axis < 3; axis++)
            sum += fabs(lines[i].from[axis]) + fabs(lines[i].to[axis]);
        if (!isfinite(sum) || !isfinite(lines[i].width))
            return error_set(err, STATUS_RANGE, "line %zu has an end at no finite place, or no width", i);
    }
    return STATUS_OK;
}

static void add_line(struct overlay *overlay, const struct camera_space *space,
                     const struct render_line *line)
{
    struct overlay_line_vertex corner = {.width = fmaxf(line->width, 0.5f)};
    double from[3], to[3];
    camera_to_space(space, line->from, from);
    camera_to_space(space, line->to, to);
    for (int i = 0; i < 3; i++) {
        corner.from[i] = (float)from[i];
        corner.to[i] = (float)to[i];
        corner.colour[i] = line->colour[i];
    }
    corner.colour[3] = line->opacity;
    for (int k = 0; k < 4; k++) {
        corner.end = (float)(k & 1);
        corner.side = k & 2 ? 1 : -1;
        overlay->lines.items[overlay->lines.count++] = corner;
    }
    overlay->widest = fmax(overlay->widest, line->width);
}

static enum status fill_lines(struct overlay *overlay, const struct render_view *view,
                              const struct render_scene *scene, struct error *err)
{
    struct camera_space space;
    enum status status = check_lines(scene->lines, scene->line_count, err);
    overlay->lines.count = 0;
    overlay->widest = 0;
    if (status)
        return status;
    if (!ARRAY_RESERVE(&overlay->lines, 4 * scene->line_count))
        return error_no_memory(err, "the lines to draw");
    camera_space_of(&view->camera, &space);
    for (size_t i = 0; i < scene->line_count; i++)
        if (!scene->lines[i].on_top)
            add_line(overlay, &space, &scene->lines[i]);
    overlay->hidden_lines = overlay->lines.count / 4;
    for (size_t i = 0; i < scene->line_count; i++)
        if (scene->lines[i].on_top)
            add_line(overlay, &space, &scene->lines[i]);
    return STATUS_OK;
}

/* A rectangle of a letter's dots, or, as columns and rows are 0, one that is all its first dot. */
static void add_rectangle(struct overlay *overlay, const int box[4], uint64_t dots, int columns, int rows,
                          const float colour[4])
{
    for (int k = 0; k < 4; k++) {
        int right = k & 1, down = k >> 1;
        struct overlay_text_vertex corner = {
            .place = {(float)(box[0] + right * box[2]), (float)(box[1] + down * box[3])},
            .dot = {(float)(right * columns), (float)(down * rows)},
            .dots = {(uint32_t)dots, (uint32_t)(dots >> 32)},
        };
        memcpy(corner.colour, colour, sizeof corner.colour);
        overlay->text.items[overlay->text.count++] = corner;
    }
}

static int margin_of(const struct render_text *text)
{
    return text->boxed ? OVERLAY_BOX_MARGIN * text->scale : 0;
}

void render_text_size(const struct render_text *text, int *width, int *height)
{
    font_size(text->text, text->scale, width, height);
    *width += 2 * margin_of(text);
    *height += 2 * margin_of(text);
}

static enum status add_text(struct overlay *overlay, const struct render_text *text, struct error *err)
{
    const float colour[4] = {text->colour[0], text->colour[1], text->colour[2], 1};
    int box[4] = {text->x, text->y}, margin = margin_of(text), scale = text->scale;
    if (!ARRAY_RESERVE(&overlay->text, 4 * (strlen(text->text) + 1)))
        return error_no_memory(err, "the text to draw");
    render_text_size(text, &box[2], &box[3]);
    if (text->boxed)
        add_rectangle(overlay, box, 1, 0, 0, box_colour);
    int x = text->x + margin, y = text->y + margin;
    for (const char *at = text->text; *at;) {
        const int place[4] = {x, y, FONT_WIDTH * scale, FONT_HEIGHT * scale};
        if (*at == '\n') {
            x = text->x + margin;
            y += FONT_STEP * scale;
            at++;
            continue;
        }
        const uint64_t dots = font_next(&at);
        if (dots)
            add_rectangle(overlay, place, dots, FONT_WIDTH, FONT_HEIGHT, colour);
        x += (FONT_WIDTH + 1) * scale;
    }
    return STATUS_OK;
}

static enum status add_boxes(struct overlay *overlay, const struct render_scene *scene, struct error *err)
{
    if (!ARRAY_RESERVE(&overlay->text, 4 * scene->box_count))
        return error_no_memory(err, "the boxes to draw");
    for (size_t i = 0; i < scene->box_count; i++) {
        const struct render_box *box = &scene->boxes[i];
        add_rectangle(overlay, (const int[4]){box->x, box->y, box->width, box->height}, 1, 0, 0,
                      (const float[4]){box->colour[0], box->colour[1], box->colour[2], box->opacity});
    }
    return STATUS_OK;
}

enum status overlay_upload(struct overlay *overlay, const struct gl *gl, struct quads *quads,
                           const struct render_view *view, const struct render_scene *scene,
                           struct error *err)
{
    enum status status = fill_lines(overlay, view, scene, err);
    overlay->text.count = 0;
    if (!status)
        status = add_boxes(overlay, scene, err);
    for (size_t i = 0; i < scene->text_count && !status; i++)
        status = add_text(overlay, &scene->texts[i], err);
    size_t most = overlay->lines.count > overlay->text.count ? overlay->lines.count : overlay->text.count;
    gl->BindVertexArray(overlay->line_array);
    if (!status && most)
        status = quads_reserve(quads, gl, most / 4, err);
    if (status || !most)
        return status;
    gl->BindBuffer(GL_ARRAY_BUFFER, overlay->line_buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(overlay->lines.count * sizeof *overlay->lines.items),
                   overlay->lines.items, GL_STREAM_DRAW);
    gl->BindVertexArray(overlay->text_array);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, quads->buffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, overlay->text_buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(overlay->text.count * sizeof *overlay->text.items),
                   overlay->text.items, GL_STREAM_DRAW);
    return STATUS_OK;
}

static void blend(const struct gl *gl)
{
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->DepthMask(GL_FALSE);
}

static void use_lines(const struct overlay *overlay, const struct gl *gl, const struct camera_eye *eye,
                      const struct geometry *geometry)
{
    float projection[16];
    const float at[3] = {(float)eye->offset, 0, 0};
    camera_projection(eye, geometry->nearest, geometry->farthest, projection);
    blend(gl);
    gl->UseProgram(overlay->line_program);
    gl->UniformMatrix4fv(overlay->line_projection, 1, GL_FALSE, projection);
    gl->Uniform3fv(overlay->line_eye, 1, at);
    gl->Uniform2f(overlay->line_size, (float)eye->width, (float)eye->height);
    gl->BindVertexArray(overlay->line_array);
    gl->Enable(GL_DEPTH_TEST);
}

void overlay_draw_lines_behind(const struct overlay *overlay, const struct gl *gl,
                               const struct camera_eye *eye, const struct geometry *geometry)
{
    use_lines(overlay, gl, eye, geometry);
    gl->DepthFunc(GL_GEQUAL);
    gl->DrawElements(GL_TRIANGLES, (GLsizei)(6 * overlay->hidden_lines), GL_UNSIGNED_INT, NULL);
    gl->DepthFunc(GL_LESS);
    gl->DepthMask(GL_TRUE);
}

void overlay_draw_lines(const struct overlay *overlay, const struct gl *gl, const struct camera_eye *eye,
                        const struct geometry *geometry)
{
    const size_t hidden = overlay->hidden_lines, all = overlay->lines.count / 4;
    if (!all)
        return;
    use_lines(overlay, gl, eye, geometry);
    if (hidden)
        gl->DrawElements(GL_TRIANGLES, (GLsizei)(6 * hidden), GL_UNSIGNED_INT, NULL);
    gl->Disable(GL_DEPTH_TEST);
    if (all > hidden)
        gl->DrawElements(GL_TRIANGLES, (GLsizei)(6 * (all - hidden)), GL_UNSIGNED_INT,
                         (const void *)(6 * hidden * sizeof(uint32_t)));
    gl->DepthMask(GL_TRUE);
}

void overlay_draw_text(const struct overlay *overlay, const struct gl *gl, const struct camera_eye *eye)
{
    if (!overlay->text.count)
        return;
    blend(gl);
    gl->Disable(GL_DEPTH_TEST);
    gl->UseProgram(overlay->text_program);
    gl->Uniform2f(overlay->text_size, (float)eye->width, (float)eye->height);
    gl->BindVertexArray(overlay->text_array);
    gl->DrawElements(GL_TRIANGLES, (GLsizei)(overlay->text.count / 4 * 6), GL_UNSIGNED_INT, NULL);
    gl->DepthMask(GL_TRUE);
}
