#include "render/shaders.h"

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
    "layout(location = 0, index = 1) out vec4 passing;\n"
    "const vec3 key = vec3(-0.5926, 0.6308, 0.5009);\n"
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
    "    float at_key = dot(n, key);\n"
    "    float lit = max(0.25 + 0.75 * at_key, 0.0);\n"
    "    float fill = max(dot(n, vec3(0.8, -0.1, 0.6)), 0.0);\n"
    "    float room = 0.5 + 0.5 * n.y;\n"
    "    float through = (1.0 - 0.6 * skin_opacity) * max(0.25 - 0.75 * at_key, 0.0);\n"
    "    float body = 0.78 * lit * lit + 0.12 * fill + mix(0.10, 0.30, room) + 0.6 * through;\n"
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
    "    vec3 above = max(seen - 0.62, 0.0);\n"
    "    light = vec4(min(seen, 0.62) + 0.38 * (1.0 - exp(-above / 0.38)), 1.0);\n"
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
