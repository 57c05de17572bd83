#include "render/shaders.h"

/* The light of the studio on a matte surface, with what comes through it from behind, and film; see the skin. */
#define STUDIO                                                                             \
    "const vec3 key = vec3(-0.5926, 0.6308, 0.5009);\n"                                    \
    "float body_light(vec3 n, float thinness)\n"                                           \
    "{\n"                                                                                  \
    "    float at_key = dot(n, key);\n"                                                    \
    "    float lit = max(0.25 + 0.75 * at_key, 0.0);\n"                                    \
    "    float fill = max(dot(n, vec3(0.8, -0.1, 0.6)), 0.0);\n"                           \
    "    float room = 0.5 + 0.5 * n.y;\n"                                                  \
    "    float through = thinness * max(0.25 - 0.75 * at_key, 0.0);\n"                     \
    "    return 0.78 * lit * lit + 0.12 * fill + mix(0.10, 0.30, room) + 0.6 * through;\n" \
    "}\n"                                                                                  \
    "vec3 on_film(vec3 seen)\n"                                                            \
    "{\n"                                                                                  \
    "    vec3 above = max(seen - 0.62, 0.0);\n"                                            \
    "    return min(seen, 0.62) + 0.38 * (1.0 - exp(-above / 0.38));\n"                    \
    "}\n"

const char shader_skin_vertex[] = "#version 330 core\n"
                                  "layout(location = 0) in vec3 position;\n"
                                  "layout(location = 1) in vec3 normal;\n"
                                  "layout(location = 2) in float opacity;\n"
                                  "layout(location = 3) in float shininess;\n"
                                  "layout(location = 4) in vec3 colour;\n"
                                  "uniform mat4 projection;\n"
                                  "uniform vec3 eye;\n"
                                  "out vec3 skin_normal, skin_to_eye, skin_colour;\n"
                                  "out float skin_opacity, skin_shininess;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    skin_normal = normal;\n"
                                  "    skin_to_eye = eye - position;\n"
                                  "    skin_colour = colour;\n"
                                  "    skin_opacity = opacity;\n"
                                  "    skin_shininess = shininess;\n"
                                  "    gl_Position = projection * vec4(position, 1.0);\n"
                                  "}\n";

/*
 * Rubber in a small studio that is fixed to the camera: a large key light above on the left, a weak fill from
 * the right, light from the room, and some that comes through thin skin from behind. Both sides are lit.
 * Stretched rubber scatters more than it absorbs: it pales as it thins.
 *
 * Opacity is that of the skin seen straight on. Seen at an angle light takes a path longer by 1 / cos of the
 * refracted angle (Snell, index 1.52), so by Beer and Lambert what passes is (1 - opacity)^path. A skin holds
 * back its own colour less than the others; grey skin, none more than another. What is drawn is the light
 * that the skin adds and, for each colour, the share that passes it from behind.
 *
 * The highlight is the mirror image of two soft boxes, blurred as a Phong lobe of this exponent blurs it: a
 * Gaussian of standard deviation 1/sqrt(exponent), of which a box is a product of differences of the error
 * function (here a cubic that has its slope at 0 and its limits). Reflection grows towards the outline by
 * Schlick's Fresnel term (1994). Bright ends are bent to 1 above a knee, as film does.
 */
const char shader_skin_fragment[] =
    "#version 330 core\n"
    "in vec3 skin_normal, skin_to_eye, skin_colour;\n"
    "in float skin_opacity, skin_shininess;\n"
    "layout(location = 0, index = 0) out vec4 light;\n"
    "layout(location = 0, index = 1) out vec4 passing;\n" STUDIO
    "const vec3 key_across = vec3(0.6455, 0.0, 0.7638);\n"
    "const vec3 key_along = vec3(0.4818, 0.7760, -0.4072);\n"
    "const vec3 strip = vec3(0.9079, 0.3561, -0.2213);\n"
    "const vec3 strip_across = vec3(-0.2368, 0.0, -0.9716);\n"
    "const vec3 strip_along = vec3(-0.3460, 0.9345, 0.0843);\n"
    "vec2 step_blurred(vec2 x)\n"
    "{\n"
    "    vec2 t = clamp(0.752 * x, -1.0, 1.0);\n"
    "    return t * (1.5 - 0.5 * t * t);\n"
    "}\n"
    "float box(vec3 ray, vec3 middle, vec3 across, vec3 along, vec2 half_size, float blur)\n"
    "{\n"
    "    float ahead = dot(ray, middle);\n"
    "    if (ahead < 0.1)\n"
    "        return 0.0;\n"
    "    vec2 at = vec2(dot(ray, across), dot(ray, along)) / ahead;\n"
    "    vec2 part = step_blurred((at + half_size) / blur) - step_blurred((at - half_size) / blur);\n"
    "    return 0.25 * part.x * part.y;\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec3 to_eye = normalize(skin_to_eye);\n"
    "    vec3 n = normalize(gl_FrontFacing ? skin_normal : -skin_normal);\n"
    "    float facing = dot(n, to_eye);\n"
    "    if (facing < 0.02) {\n"
    "        n = normalize(n + (0.02 - facing) * to_eye);\n"
    "        facing = 0.02;\n"
    "    }\n"
    "    float path = inversesqrt(1.0 - (1.0 - facing * facing) / 2.31);\n"
    "    vec3 hold = 1.0 + 1.4 * (dot(skin_colour, vec3(1.0 / 3.0)) - skin_colour);\n"
    "    vec3 passes = pow(vec3(max(1.0 - skin_opacity, 1e-6)), path * hold);\n"
    "    if (skin_opacity > 0.999)\n"
    "        passes = vec3(0.0);\n"
    "    float body = body_light(n, 1.0 - 0.6 * skin_opacity);\n"
    "    vec3 pale = mix(skin_colour, vec3(1.0), 0.1 * (1.0 - skin_opacity));\n"
    "    float rest = 1.0 - facing;\n"
    "    float fresnel = 0.043 + 0.957 * rest * rest * rest * rest * rest;\n"
    "    float gloss = skin_shininess / (skin_shininess + 12.0);\n"
    "    float blur = 1.414 * inversesqrt(max(skin_shininess, 1.0));\n"
    "    vec3 ray = reflect(-to_eye, n);\n"
    "    float boxes = 9.0 * box(ray, key, key_across, key_along, vec2(0.36, 0.5), blur) +\n"
    "                  7.0 * box(ray, strip, strip_across, strip_along, vec2(0.14, 0.8), blur);\n"
    "    float around = mix(0.25, 0.75, 0.5 + 0.5 * ray.y) * smoothstep(-1.0, 0.3, ray.z);\n"
    "    float mirror = gloss * min(fresnel, 0.5) * (boxes + around);\n"
    "    vec3 seen = pale * body * (1.0 - passes) + mirror;\n"
    "    light = vec4(on_film(seen), 1.0);\n"
    "    passing = vec4(passes, 0.0);\n"
    "}\n";

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
    "out vec4 light;\n"
    "void main()\n"
    "{\n"
    "    light = vec4(mix(vec3(0.60, 0.60, 0.585), vec3(0.50, 0.51, 0.53), height), 1.0);\n"
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

/* A line becomes a rectangle on the screen, half a pixel wider on each side for the smooth rim. What lies behind
 * the near plane is cut off first. It is drawn a thousandth nearer than it is, so that one on a surface is
 * whole: nearer along the rays to the eye, which moves nothing on the screen. The division by w is done here, as
 * a rectangle on the screen has no perspective. */
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
