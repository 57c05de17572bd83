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
    describe(gl, SHADER_FILM, 1, GL_FLOAT, offsetof(struct geometry_vertex, film));
    describe(gl, SHADER_GLOSS, 1, GL_FLOAT, offsetof(struct geometry_vertex, gloss));
    describe(gl, SHADER_COLOUR, 4, GL_UNSIGNED_SHORT, offsetof(struct geometry_vertex, colour));
}

enum status draw_ready(struct draw *draw, const struct gl *gl, enum render_style style, enum light_way way,
                       struct error *err)
{
    static const char *const vertex[2] = {shader_paper_vertex, shader_latex_vertex};
    static const char *const fragment[2][LIGHT_WAYS] = {
        {shader_paper_blended, shader_paper_peeled, shader_paper_listed},
        {shader_latex_blended, shader_latex_peeled, shader_latex_listed}};
    struct draw_program *skin = &draw->skins[style][way];
    if (skin->program)
        return STATUS_OK;
    enum status status = program_link(gl, vertex[style], fragment[style][way], &skin->program, err);
    if (status) {
        gl->DeleteProgram(skin->program);
        skin->program = 0;
        return status;
    }
    skin->projection = gl->GetUniformLocation(skin->program, "projection");
    skin->eye = gl->GetUniformLocation(skin->program, "eye");
    skin->width = gl->GetUniformLocation(skin->program, "width");
    skin->room = gl->GetUniformLocation(skin->program, "room");
    return STATUS_OK;
}

enum status draw_open(struct draw *draw, const struct gl *gl, struct error *err)
{
    enum status status = draw_ready(draw, gl, RENDER_PAPER, LIGHT_BLENDED, err);
    if (!status)
        status = program_link(gl, shader_backdrop_vertex, shader_backdrop_fragment, &draw->backdrop, err);
    if (!status)
        status = program_link(gl, shader_shadow_vertex, shader_shadow_fragment, &draw->shadow, err);
    if (status) {
        draw_close(draw, gl);
        return status;
    }
    draw->backdrop_brightness = gl->GetUniformLocation(draw->backdrop, "brightness");
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
    for (int style = 0; style < 2; style++)
        for (int way = 0; way < LIGHT_WAYS; way++)
            gl->DeleteProgram(draw->skins[style][way].program);
    gl->DeleteProgram(draw->backdrop);
    gl->DeleteProgram(draw->shadow);
    *draw = (struct draw){0};
}

/* Of all that is in the buffer. */
static size_t indices_before(const struct draw *draw, const struct geometry *g, int eye)
{
    size_t count = 3 * g->opaque;
    for (int i = 0; i < eye && draw->cells; i++)
        count += draw->cells[i].indices.count;
    return count;
}

static void upload_indices(const struct gl *gl, size_t first, const uint32_t *indices, size_t count)
{
    gl->BufferSubData(GL_ELEMENT_ARRAY_BUFFER, (GLintptr)(first * sizeof *indices),
                      (GLsizeiptr)(count * sizeof *indices), indices);
}

void draw_upload(struct draw *draw, const struct gl *gl, const struct geometry *g, const struct cells *cells)
{
    draw->cells = cells;
    const size_t own = cells ? 3 * g->opaque : g->indices.count;
    const size_t all = cells ? indices_before(draw, g, 2) : own;
    gl->BindVertexArray(draw->arrays);
    gl->BindBuffer(GL_ARRAY_BUFFER, draw->vertices);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(g->vertices.count * sizeof *g->vertices.items),
                   g->vertices.items, GL_STREAM_DRAW);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(all * sizeof *g->indices.items), NULL,
                   GL_STREAM_DRAW);
    upload_indices(gl, 0, g->indices.items, own);
    for (int i = 0; i < 2 && cells; i++)
        upload_indices(gl, indices_before(draw, g, i), cells[i].indices.items, cells[i].indices.count);
}

static void set_place(const struct gl *gl, const struct draw_place *place)
{
    const int *at = place->viewport;
    gl->Viewport(at[0], at[1], at[2], at[3]);
    gl->Enable(GL_FRAMEBUFFER_SRGB);
    gl->Disable(GL_DEPTH_TEST);
}

void draw_backdrop(const struct draw *draw, const struct gl *gl, const struct draw_place *place)
{
    set_place(gl, place);
    gl->Disable(GL_BLEND);
    gl->UseProgram(draw->backdrop);
    gl->Uniform1f(draw->backdrop_brightness, place->brightness);
    gl->BindVertexArray(draw->nothing);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void draw_shadow(const struct draw *draw, const struct gl *gl, const struct draw_place *place,
                 const struct camera_eye *eye, const struct geometry *geometry)
{
    float projection[16];
    set_place(gl, place);
    gl->DepthMask(GL_TRUE);
    gl->Disable(GL_SCISSOR_TEST); /* clearing all is free, a part is drawn */
    gl->Clear(GL_DEPTH_BUFFER_BIT);
    gl->Enable(GL_SCISSOR_TEST);
    if (!geometry->shadows.count)
        return;
    camera_projection(eye, geometry->nearest, geometry->farthest, projection);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_DST_COLOR, GL_ZERO);
    gl->UseProgram(draw->shadow);
    gl->UniformMatrix4fv(draw->shadow_projection, 1, GL_FALSE, projection);
    gl->BindVertexArray(draw->nothing);
    for (size_t i = 0; i < geometry->shadows.count; i++) {
        gl->Uniform3fv(draw->shadow_corner, 4, geometry->shadows.items[i].corner[0]);
        gl->Uniform3fv(draw->shadow_left, 1, geometry->shadows.items[i].colour);
        gl->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
}

static void use_skin(const struct draw *draw, const struct gl *gl, const struct draw_program *skin,
                     const struct camera_eye *eye, const struct geometry *geometry)
{
    float projection[16];
    const float at[3] = {(float)eye->offset, 0, 0};
    camera_projection(eye, geometry->nearest, geometry->farthest, projection);
    gl->UseProgram(skin->program);
    gl->UniformMatrix4fv(skin->projection, 1, GL_FALSE, projection);
    gl->Uniform3fv(skin->eye, 1, at);
    gl->BindVertexArray(draw->arrays);
}

/* Mesa's software notes every triangle, about 100 bytes each, before it draws the first. */
enum { INDICES_AT_ONCE = 3 << 18 };

static void draw_indices(const struct gl *gl, size_t first, size_t count)
{
    while (count > INDICES_AT_ONCE) {
        draw_indices(gl, first, INDICES_AT_ONCE);
        gl->Finish();
        first += INDICES_AT_ONCE;
        count -= INDICES_AT_ONCE;
    }
    gl->DrawElements(GL_TRIANGLES, (GLsizei)count, GL_UNSIGNED_INT, (const void *)(first * sizeof(uint32_t)));
}

void draw_opaque(const struct draw *draw, const struct gl *gl, enum render_style style,
                 const struct camera_eye *eye, const struct geometry *g)
{
    gl->Enable(GL_DEPTH_TEST);
    gl->Disable(GL_BLEND);
    if (!g->opaque)
        return;
    use_skin(draw, gl, &draw->skins[style][LIGHT_BLENDED], eye, g);
    draw_indices(gl, 0, 3 * g->opaque);
}

/* The part of a cell that is drawn, in the framebuffer; false: none. */
static bool find_scissor(const struct cells *cells, int cell, const struct draw_place *place,
                         const struct camera_eye *eye, int scissor[4])
{
    const int at[2] = {cell % cells->columns, cell / cells->columns};
    const int side = place->viewport[2] / eye->width; /* samples along a pixel's side */
    for (int i = 0; i < 2; i++) {
        const int *whole = place->scissor + i;
        const int from = place->viewport[i] + side * (cells->corner[i] + at[i] * cells->side);
        const int to = from + side * cells->side, end = whole[0] + whole[2];
        scissor[i] = from > whole[0] ? from : whole[0];
        scissor[i + 2] = (to < end ? to : end) - scissor[i];
    }
    return scissor[2] > 0 && scissor[3] > 0;
}

static void draw_cells(const struct draw *draw, const struct gl *gl, const struct draw_place *place,
                       const struct camera_eye *eye, const struct geometry *g)
{
    const struct cells *cells = &draw->cells[place->eye];
    const size_t first = indices_before(draw, g, place->eye);
    const int *whole = place->scissor;
    int cell[4];
    for (int i = 0; i < cells->columns * cells->rows; i++) {
        const size_t count = cells->begin[i + 1] - cells->begin[i];
        if (!count || !find_scissor(cells, i, place, eye, cell))
            continue;
        gl->Scissor(cell[0], cell[1], cell[2], cell[3]);
        draw_indices(gl, first + 3 * cells->begin[i], 3 * count);
    }
    gl->Scissor(whole[0], whole[1], whole[2], whole[3]);
}

void draw_translucent(const struct draw *draw, const struct gl *gl, enum render_style style,
                      const struct draw_place *place, const struct camera_eye *eye, const struct geometry *g,
                      const struct light_pass *pass)
{
    const struct draw_program *skin = &draw->skins[style][pass->way];
    use_skin(draw, gl, skin, eye, g);
    if (pass->way == LIGHT_LISTED) {
        gl->Uniform1i(skin->width, pass->width);
        gl->Uniform1ui(skin->room, pass->room);
    }
    if (draw->cells)
        draw_cells(draw, gl, place, eye, g);
    else
        draw_indices(gl, 3 * g->opaque, 3 * g->translucent.count);
}

void draw_depths(const struct draw *draw, const struct gl *gl, const struct draw_place *place,
                 const struct camera_eye *eye, const struct geometry *geometry)
{
    gl->DepthMask(GL_TRUE);
    gl->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_opaque(draw, gl, RENDER_PAPER, eye, geometry);
    draw_translucent(draw, gl, RENDER_PAPER, place, eye, geometry,
                     &(struct light_pass){.way = LIGHT_BLENDED});
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

/* Opaque triangles hide by depth; translucent ones are hidden by those, and lie over one another in their
 * order. The shader gives the light to add and the share of each colour to keep of what lies behind. */
void draw_eye(const struct draw *draw, const struct gl *gl, const struct draw_place *place,
              const struct camera_eye *eye, const struct geometry *geometry)
{
    draw_opaque(draw, gl, RENDER_PAPER, eye, geometry);
    if (!geometry->translucent.count)
        return;
    gl->DepthMask(GL_FALSE);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_ONE, GL_SRC1_COLOR);
    draw_translucent(draw, gl, RENDER_PAPER, place, eye, geometry,
                     &(struct light_pass){.way = LIGHT_BLENDED});
    gl->DepthMask(GL_TRUE);
}
