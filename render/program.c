#include "render/program.h"

#include "common/array.h"

#include <stdint.h>
#include <stdlib.h>

static enum status compile(const struct gl *gl, GLuint program, GLenum kind, const char *source,
                           struct error *err)
{
    char log[512] = "";
    GLint good = 0;
    GLuint shader = gl->CreateShader(kind);
    gl->ShaderSource(shader, 1, &source, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->AttachShader(program, shader);
    gl->DeleteShader(shader); /* goes with the program */
    return good ? STATUS_OK : error_set(err, STATUS_RESOURCE, "OpenGL cannot compile a shader: %s", log);
}

enum status program_link(const struct gl *gl, const char *vertex, const char *fragment, GLuint *program,
                         struct error *err)
{
    *program = gl->CreateProgram();
    enum status status = compile(gl, *program, GL_VERTEX_SHADER, vertex, err);
    if (!status)
        status = compile(gl, *program, GL_FRAGMENT_SHADER, fragment, err);
    if (status)
        return status;
    char log[512] = "";
    GLint good = 0;
    gl->LinkProgram(*program);
    gl->GetProgramiv(*program, GL_LINK_STATUS, &good);
    gl->GetProgramInfoLog(*program, sizeof log, NULL, log);
    return good ? STATUS_OK : error_set(err, STATUS_RESOURCE, "OpenGL cannot link a shader: %s", log);
}

enum status quads_reserve(struct quads *quads, const struct gl *gl, size_t count, struct error *err)
{
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    if (!quads->buffer)
        gl->GenBuffers(1, &quads->buffer);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, quads->buffer);
    if (count <= quads->capacity)
        return STATUS_OK;
    size_t capacity = count + count / 2;
    uint32_t *indices = capacity <= UINT32_MAX / 6 ? array_new(capacity, sizeof corners) : NULL;
    if (!indices)
        return error_no_memory(err, "what is drawn as squares");
    for (size_t i = 0; i < 6 * capacity; i++)
        indices[i] = (uint32_t)(4 * (i / 6)) + corners[i % 6];
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(6 * capacity * sizeof *indices), indices,
                   GL_STATIC_DRAW);
    quads->capacity = capacity;
    free(indices);
    return STATUS_OK;
}

void quads_clear(struct quads *quads, const struct gl *gl)
{
    if (quads->buffer)
        gl->DeleteBuffers(1, &quads->buffer);
    *quads = (struct quads){0};
}
