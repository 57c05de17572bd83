#include "render/solid_draw.h"

#include "common/vec3.h"
#include "render/program.h"
#include "render/shaders.h"

#include <string.h>

enum status solid_draw_open(struct solid_draw *draw, const struct gl *gl, struct error *err)
{
    enum status status = program_link(gl, shader_solid_vertex, shader_solid_fragment, &draw->program, err);
    draw->to_clip = gl->GetUniformLocation(draw->program, "to_clip");
    draw->sides = gl->GetUniformLocation(draw->program, "sides");
    draw->smooth_light = gl->GetUniformLocation(draw->program, "smooth_light");
    draw->edges = gl->GetUniformLocation(draw->program, "edges");
    return status;
}

void solid_draw_close(struct solid_draw *draw, const struct gl *gl)
{
    gl->DeleteProgram(draw->program);
    *draw = (struct solid_draw){0};
}

bool solid_bounds(const struct render_solid *solid, double low[3], double high[3])
{
    uint16_t least[3] = {UINT16_MAX, UINT16_MAX, UINT16_MAX}, most[3] = {0};
    for (size_t i = 0; i < solid->blocks.count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const struct solid_block *block = &solid->blocks.items[i];
            least[axis] = block->low[axis] < least[axis] ? block->low[axis] : least[axis];
            most[axis] = block->high[axis] > most[axis] ? block->high[axis] : most[axis];
        }
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = solid->origin[axis] + solid->cell * least[axis];
        high[axis] = solid->origin[axis] + solid->cell * most[axis];
    }
    return solid->blocks.count > 0;
}

/* From cells to an eye's clip space (column-major), in double until the end. */
static void find_matrix(const struct render_solid *solid, const struct camera_space *space,
                        const float projection[16], float to_clip[16])
{
    double model[4][3]; /* columns: a cell along x, y, z; the origin; in camera space */
    camera_to_space(space, solid->origin, model[3]);
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < 3; i++)
            model[axis][i] = space->axis[i][axis] * solid->cell * space->scale;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = column == 3 ? projection[12 + row] : 0;
            for (int i = 0; i < 3; i++)
                sum += (double)projection[4 * i + row] * model[column][i];
            to_clip[4 * column + row] = (float)sum;
        }
}

/* Wholly beyond one of the six planes of the clip space. */
static bool out_of_sight(const struct solid_block *block, const float m[16])
{
    for (int row = 0; row < 3; row++)
        for (int sign = -1; sign <= 1; sign += 2) {
            /* the largest w + sign coordinate of any corner */
            double most = (double)m[15] + sign * (double)m[12 + row];
            for (int axis = 0; axis < 3; axis++) {
                double slope = (double)m[4 * axis + 3] + sign * (double)m[4 * axis + row];
                most += slope * (slope > 0 ? block->high[axis] : block->low[axis]);
            }
            if (most < 0)
                return true;
        }
    return false;
}

/* The runs of sides that may face an eye at this place, in cells. Returns how many;
 * neighbours are one run. */
static int facing_runs(const struct solid_block *block, const double eye[3], GLsizei count[6],
                       const void *offset[6])
{
    int runs = 0;
    uint32_t end = 0;
    for (int side = 0; side < 6; side++) {
        uint32_t first = block->first[side], number = block->first[side + 1] - first;
        bool faces = side & 1 ? eye[side / 2] > block->low[side / 2] : eye[side / 2] < block->high[side / 2];
        if (!faces || !number)
            continue;
        if (runs && first == end) {
            count[runs - 1] += (GLsizei)(6 * number);
        } else {
            count[runs] = (GLsizei)(6 * number);
            offset[runs++] = (const void *)(6 * (size_t)first * sizeof(uint32_t));
        }
        end = first + number;
    }
    return runs;
}

static void set_uniforms(const struct solid_draw *draw, const struct gl *gl, const struct camera_space *space,
                         const float to_clip[16], const struct render_scene *scene)
{
    float sides[6][3];
    for (int side = 0; side < 6; side++)
        for (int i = 0; i < 3; i++)
            sides[side][i] = (float)((side & 1 ? 1 : -1) * space->axis[i][side / 2]);
    gl->UseProgram(draw->program);
    gl->UniformMatrix4fv(draw->to_clip, 1, GL_FALSE, to_clip);
    gl->Uniform3fv(draw->sides, 6, sides[0]);
    gl->Uniform1f(draw->smooth_light, scene->smooth_light);
    gl->Uniform1f(draw->edges, scene->cell_edges);
}

void solid_draw_eye(const struct solid_draw *draw, const struct gl *gl, const struct render_view *view,
                    const struct camera_eye *eye, const struct geometry *geometry,
                    const struct render_scene *scene)
{
    const struct render_solid *solid = scene->solid;
    struct camera_space space;
    float projection[16], to_clip[16];
    double at[3];
    camera_space_of(&view->camera, &space);
    camera_projection(eye, geometry->nearest, geometry->farthest, projection);
    find_matrix(solid, &space, projection, to_clip);
    for (int i = 0; i < 3; i++)
        at[i] = (space.origin[i] + space.axis[0][i] * eye->offset / space.scale - solid->origin[i]) /
                solid->cell;
    set_uniforms(draw, gl, &space, to_clip, scene);
    gl->Enable(GL_DEPTH_TEST);
    gl->Disable(GL_BLEND);
    for (size_t i = 0; i < solid->blocks.count; i++) {
        const struct solid_block *block = &solid->blocks.items[i];
        GLsizei count[6];
        const void *offset[6];
        if (out_of_sight(block, to_clip))
            continue;
        int runs = facing_runs(block, at, count, offset);
        gl->BindVertexArray(block->array);
        gl->MultiDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, offset, runs);
    }
}
