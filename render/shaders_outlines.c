/* What smooths the steps of outlines; see outlines.h. */
#include "render/shaders.h"

/* The picture is read as sRGB's own numbers, whose weighted sum is lightness enough, and whose squares are
 * about linear light. An outline that is followed further than `farthest` has bent meanwhile: what is further
 * says no more of where it is here. */
const char shader_outlines_fragment[] =
    "#version 330 core\n"
    "uniform sampler2D picture;\n"
    "uniform ivec4 box;\n"
    "out vec4 light;\n"
    "const int farthest = 8;\n"
    "float lightness(ivec2 at)\n"
    "{\n"
    "    ivec2 within = clamp(at, box.xy, box.xy + box.zw - 1);\n"
    "    return dot(texelFetch(picture, within, 0).rgb, vec3(0.2126, 0.7152, 0.0722));\n"
    "}\n"
    /* How many pixels it is along an edge to where both its sides together become lighter
     * or darker, by how much. */
    "int to_end(ivec2 at, ivec2 beyond, ivec2 along, float middle, float least, out float change)\n"
    "{\n"
    "    int steps = 0;\n"
    "    do {\n"
    "        at += along;\n"
    "        steps++;\n"
    "        change = 0.5 * (lightness(at) + lightness(at + beyond)) - middle;\n"
    "    } while (abs(change) < least && steps < farthest);\n"
    "    return steps;\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
    "    float here = lightness(at);\n"
    "    vec2 before = vec2(lightness(at - ivec2(1, 0)), lightness(at - ivec2(0, 1))) - here;\n"
    "    vec2 after = vec2(lightness(at + ivec2(1, 0)), lightness(at + ivec2(0, 1))) - here;\n"
    "    vec2 contrast = max(abs(before), abs(after)), bend = abs(before + after);\n"
    "    if (max(contrast.x, contrast.y) < 0.05)\n"
    "        discard;\n"
    /* the edge lies between this pixel and the one beyond */
    "    bool level = bend.y >= bend.x;\n"
    "    vec2 sides = level ? vec2(before.y, after.y) : vec2(before.x, after.x);\n"
    "    bool backwards = abs(sides.x) > abs(sides.y);\n"
    "    ivec2 along = level ? ivec2(1, 0) : ivec2(0, 1);\n"
    "    ivec2 beyond = backwards ? -along.yx : along.yx;\n"
    "    float difference = backwards ? sides.x : sides.y;\n"
    "    float middle = here + 0.5 * difference, least = 0.25 * abs(difference);\n"
    "    float change, other_change;\n"
    "    int near = to_end(at, beyond, along, middle, least, change);\n"
    "    int other = to_end(at, beyond, -along, middle, least, other_change);\n"
    "    float run = float(near + other - 1);\n"
    "    if (other < near || other == near && change * difference <= 0.0) {\n"
    "        near = other;\n"
    "        change = other_change;\n"
    "        along = -along;\n"
    "    }\n"
    /* at the near end the other side steps into this row, or it is that one's matter */
    "    if (abs(change) < least || change * difference <= 0.0)\n"
    "        discard;\n"
    /* a long edge that turns there and does not go on in the next row has a corner, which stays one */
    "    if (run > 3.0 && (lightness(at + near * along - beyond) - middle) * difference > 0.0)\n"
    "        discard;\n"
    /* what is beyond a line from half a pixel before the edge at the near end to the edge
     * in the middle of the run */
    "    float from = float(near - 1), to = min(float(near), 0.5 * run);\n"
    "    float share = 0.5 * (to - from) * (1.0 - (to + from) / run);\n"
    "    vec3 own = texelFetch(picture, at, 0).rgb, others = texelFetch(picture, at + beyond, 0).rgb;\n"
    "    light = vec4(sqrt(mix(own * own, others * others, share)), 1.0);\n"
    "}\n";
