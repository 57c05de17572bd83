/* What makes one picture of layers, and of a linear picture one for the screen. */
#include "render/shaders.h"
#include "render/shaders_studio.h"

const char shader_whole_vertex[] =
    "#version 330 core\n"
    "void main()\n"
    "{\n"
    "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
    "}\n";

/* Each pixel is the mean of its samples, after the tone curve: or bright samples would eat an outline. */
const char shader_tone_fragment[] =
    "#version 330 core\n"
    "uniform sampler2D picture;\n"
    "uniform ivec2 corner;\n"
    "uniform int side;\n"
    "uniform float exposure;\n"
    "out vec4 light;\n" STUDIO "void main()\n"
    "{\n"
    "    ivec2 first = side * (ivec2(gl_FragCoord.xy) - corner);\n"
    "    vec3 sum = vec3(0.0);\n"
    "    for (int y = 0; y < side; y++)\n"
    "        for (int x = 0; x < side; x++) {\n"
    "            vec3 seen = texelFetch(picture, first + ivec2(x, y), 0).rgb;\n"
    "            sum += exposure > 0.0 ? on_film(exposure * seen) : seen;\n"
    "        }\n"
    "    light = vec4(sum / float(side * side), 1.0);\n"
    "}\n";

const char shader_layer_fragment[] = "#version 330 core\n"
                                     "uniform sampler2D layer_light, layer_passing;\n"
                                     "layout(location = 0, index = 0) out vec4 light;\n"
                                     "layout(location = 0, index = 1) out vec4 passing;\n"
                                     "void main()\n"
                                     "{\n"
                                     "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
                                     "    light = texelFetch(layer_light, at, 0);\n"
                                     "    passing = texelFetch(layer_passing, at, 0);\n"
                                     "}\n";

/* Takes a pixel's fragments from the farthest on, those at one distance in the order of their places:
 * searching the list again for each needs no room of its own, and lists are short. */
const char shader_list_fragment[] =
    "#version 430 core\n"
    "layout(std430, binding = 0) buffer Heads { uint used; uint head[]; };\n"
    "layout(std430, binding = 1) readonly buffer Nodes { uint node[]; };\n"
    "uniform int width;\n"
    "layout(location = 0, index = 0) out vec4 light;\n"
    "layout(location = 0, index = 1) out vec4 passing;\n"
    "void main()\n"
    "{\n"
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
    "    uint first = head[at.y * width + at.x];\n"
    "    if (first == 0u)\n"
    "        discard;\n"
    "    vec3 added = vec3(0.0), passes = vec3(1.0);\n"
    "    uint last_place = 0u, last_depth = 0xffffffffu;\n"
    "    for (;;) {\n"
    "        uint place = 0u, depth = 0u;\n"
    "        for (uint i = first; i != 0u; i = node[5u * i - 1u]) {\n"
    "            uint d = node[5u * i - 2u];\n"
    "            bool left = d < last_depth || (d == last_depth && i > last_place);\n"
    "            if (left && (place == 0u || d > depth || (d == depth && i < place))) {\n"
    "                place = i;\n"
    "                depth = d;\n"
    "            }\n"
    "        }\n"
    "        if (place == 0u)\n"
    "            break;\n"
    "        vec2 middle = unpackHalf2x16(node[5u * place - 4u]);\n"
    "        vec3 own = vec3(unpackHalf2x16(node[5u * place - 5u]), middle.x);\n"
    "        vec3 kept = vec3(middle.y, unpackHalf2x16(node[5u * place - 3u]));\n"
    "        added = own + kept * added;\n"
    "        passes *= kept;\n"
    "        last_place = place;\n"
    "        last_depth = depth;\n"
    "    }\n"
    "    light = vec4(added, 1.0);\n"
    "    passing = vec4(passes, 0.0);\n"
    "}\n";

/* Dubois, "A projection method to generate anaglyph stereo images" (2001): the least-squares
 * match of what each eye sees through red and cyan filters, in linear light; the matrices are of
 * his page's usual glasses. */
const char shader_stereo_fragment[] =
    "#version 330 core\n"
    "uniform sampler2D left_picture, right_picture;\n"
    "uniform int first_row, red_cyan;\n"
    "out vec4 light;\n"
    "const mat3 from_left = mat3(0.4561, -0.0401, -0.0152, 0.5005, -0.0378, -0.0206, 0.1764, -0.0158, -0.0055);\n"
    "const mat3 from_right = mat3(-0.0435, 0.3785, -0.0722, -0.0879, 0.7336, -0.1130, -0.0016, -0.0185, 1.2264);\n"
    "void main()\n"
    "{\n"
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
    "    vec3 left = texelFetch(left_picture, at, 0).rgb, right = texelFetch(right_picture, at, 0).rgb;\n"
    "    vec3 one = ((first_row - at.y) & 1) == 0 ? left : right;\n"
    "    light = vec4(red_cyan == 1 ? clamp(from_left * left + from_right * right, 0.0, 1.0) : one, 1.0);\n"
    "}\n";
