#include "render/shaders.h"
#include "render/shaders_studio.h"

/* One triangle over the whole picture; grey from the horizon up and down. */
const char shader_backdrop_vertex[] =
    "#version 330 core\n"
    "out float height;\n"
    "void main()\n"
    "{\n"
    "    vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "    height = 0.5 + 0.5 * at.y;\n"
    "    gl_Position = vec4(at, 0.0, 1.0);\n"
    "}\n";

const char shader_backdrop_fragment[] =
    "#version 330 core\n"
    "in float height;\n"
    "uniform float brightness;\n"
    "out vec4 light;\n"
    "void main()\n"
    "{\n"
    "    vec3 grey = mix(vec3(0.60, 0.60, 0.585), vec3(0.50, 0.51, 0.53), height);\n"
    "    light = vec4(brightness * grey, 1.0);\n"
    "}\n";

const char shader_shadow_vertex[] =
    "#version 330 core\n"
    "uniform mat4 projection;\n"
    "uniform vec3 corner[4];\n"
    "out vec2 deviations;\n"
    "void main()\n"
    "{\n"
    "    deviations = 3.0 * vec2((gl_VertexID & 1) != 0 ? 1.0 : -1.0, (gl_VertexID & 2) != 0 ? 1.0 : -1.0);\n"
    "    gl_Position = projection * vec4(corner[gl_VertexID], 1.0);\n"
    "}\n";

/* What is left of the floor's light; it multiplies what was drawn. The Gaussian is lowered to end at 0. */
const char shader_shadow_fragment[] =
    "#version 330 core\n"
    "in vec2 deviations;\n"
    "uniform vec3 left;\n"
    "out vec4 light;\n"
    "void main()\n"
    "{\n"
    "    float amount = max(exp(-0.5 * dot(deviations, deviations)) - 0.0111, 0.0) / 0.9889;\n"
    "    light = vec4(mix(vec3(1.0), left, amount), 1.0);\n"
    "}\n";

/* A face of a solid: matte, and lit as a whole. */
const char shader_solid_vertex[] = "#version 330 core\n"
                                   "layout(location = 0) in vec4 place;\n"
                                   "layout(location = 1) in vec3 colour;\n"
                                   "layout(location = 2) in vec3 normal;\n" STUDIO "uniform mat4 to_clip;\n"
                                   "uniform vec3 sides[6];\n"
                                   "uniform float smooth_light;\n"
                                   "flat out vec3 face_light;\n"
                                   "out vec2 cells;\n"
                                   "void main()\n"
                                   "{\n"
                                   "    int side = int(place.w);\n"
                                   "    vec3 n = sides[side];\n"
                                   "    if (smooth_light > 0.0 && dot(normal, normal) > 0.0)\n"
                                   "        n = normalize(mat3(sides[1], sides[3], sides[5]) * normal);\n"
                                   "    face_light = on_film(colour * body_light(n, 0.0));\n"
                                   "    cells = side < 2 ? place.yz : side < 4 ? place.zx : place.xy;\n"
                                   "    gl_Position = to_clip * vec4(place.xyz, 1.0);\n"
                                   "}\n";

/* Edges of cells are a pixel and a half wide, and fade where cells become as small as their edges. */
const char shader_solid_fragment[] =
    "#version 330 core\n"
    "flat in vec3 face_light;\n"
    "in vec2 cells;\n"
    "layout(location = 0) out vec4 light;\n"
    "uniform float edges;\n"
    "void main()\n"
    "{\n"
    "    float kept = 1.0;\n"
    "    if (edges > 0.0) {\n"
    "        vec2 pixel = fwidth(cells);\n"
    "        vec2 away = abs(fract(cells - 0.5) - 0.5) / pixel;\n"
    "        vec2 cover = clamp(1.25 - away, 0.0, 1.0) * clamp((1.0 / pixel - 3.0) / 6.0, 0.0, 1.0);\n"
    "        kept = 1.0 - 0.5 * max(cover.x, cover.y);\n"
    "    }\n"
    "    light = vec4(kept * face_light, 1.0);\n"
    "}\n";

/* A line becomes a rectangle on the screen, half a pixel wider on each side for the smooth rim. What lies
 * behind the near plane is cut off first. It is drawn a thousandth nearer than it is, so that one on a
 * surface is whole: nearer along the rays to the eye, which moves nothing on the screen. The division by w is
 * done here, as a rectangle on the screen has no perspective. */
const char shader_line_vertex[] =
    "#version 330 core\n"
    "layout(location = 0) in vec3 from;\n"
    "layout(location = 1) in vec3 to;\n"
    "layout(location = 2) in vec3 corner;\n"
    "layout(location = 3) in vec4 colour;\n"
    "uniform mat4 projection;\n"
    "uniform vec3 eye;\n"
    "uniform vec2 size;\n"
    "out float across;\n"
    "flat out float half_width;\n"
    "flat out vec4 line_colour;\n"
    "vec4 before(vec4 p, vec4 q)\n"
    "{\n"
    "    float at_p = p.z + p.w, at_q = q.z + q.w;\n"
    "    return at_p < 0.0 && at_q > 0.0 ? mix(p, q, at_p / (at_p - at_q)) : p;\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec4 p = projection * vec4(mix(eye, from, 0.999), 1.0);\n"
    "    vec4 q = projection * vec4(mix(eye, to, 0.999), 1.0);\n"
    "    vec4 a = before(p, q), b = before(q, p);\n"
    "    vec2 along = (b.xy / b.w - a.xy / a.w) * 0.5 * size;\n"
    "    float pixels = length(along);\n"
    "    along = pixels > 1e-6 ? along / pixels : vec2(1.0, 0.0);\n"
    "    half_width = 0.5 * corner.z;\n"
    "    across = corner.y * (half_width + 0.5);\n"
    "    line_colour = colour;\n"
    "    vec4 here = corner.x > 0.5 ? b : a;\n"
    "    vec2 moved = vec2(-along.y, along.x) * across + along * (corner.x - 0.5) * min(corner.z, 1.0);\n"
    "    gl_Position = here.w > 0.0 && here.z >= -1.0001 * here.w\n"
    "                      ? vec4(here.xy / here.w + moved * 2.0 / size, max(here.z / here.w, -1.0), 1.0)\n"
    "                      : vec4(2.0, 2.0, 2.0, 1.0);\n"
    "}\n";

const char shader_line_fragment[] = "#version 330 core\n"
                                    "in float across;\n"
                                    "flat in float half_width;\n"
                                    "flat in vec4 line_colour;\n"
                                    "layout(location = 0) out vec4 light;\n"
                                    "void main()\n"
                                    "{\n"
                                    "    float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);\n"
                                    "    light = vec4(line_colour.rgb, line_colour.a * cover);\n"
                                    "}\n";

/* Letters carry their own dots, row by row from above: no texture is needed. */
const char shader_text_vertex[] =
    "#version 330 core\n"
    "layout(location = 0) in vec2 place;\n"
    "layout(location = 1) in vec2 dot_place;\n"
    "layout(location = 2) in uvec2 dots;\n"
    "layout(location = 3) in vec4 colour;\n"
    "uniform vec2 size;\n"
    "out vec2 at;\n"
    "flat out uvec2 letter;\n"
    "flat out vec4 text_colour;\n"
    "void main()\n"
    "{\n"
    "    at = dot_place;\n"
    "    letter = dots;\n"
    "    text_colour = colour;\n"
    "    gl_Position = vec4(2.0 * place.x / size.x - 1.0, 1.0 - 2.0 * place.y / size.y, 0.0, 1.0);\n"
    "}\n";

const char shader_text_fragment[] =
    "#version 330 core\n"
    "in vec2 at;\n"
    "flat in uvec2 letter;\n"
    "flat in vec4 text_colour;\n"
    "layout(location = 0) out vec4 light;\n"
    "void main()\n"
    "{\n"
    "    ivec2 place = ivec2(floor(at));\n"
    "    int number = 5 * place.y + place.x;\n"
    "    uint bits = number < 32 ? letter.x >> uint(number) : letter.y >> uint(number - 32);\n"
    "    if ((bits & 1u) == 0u)\n"
    "        discard;\n"
    "    light = text_colour;\n"
    "}\n";
