/* The skins' shaders: a material (the paper's or latex) with an end that blends,
 * keeps one layer, or lists. */
#include "render/shaders.h"
#include "render/shaders_studio.h"

const char shader_paper_vertex[] = "#version 330 core\n"
                                   "layout(location = 0) in vec3 position;\n"
                                   "layout(location = 1) in vec3 normal;\n"
                                   "layout(location = 2) in float opacity;\n"
                                   "layout(location = 3) in float shininess;\n"
                                   "layout(location = 4) in vec3 colour;\n"
                                   "uniform mat4 projection;\n"
                                   "uniform vec3 eye;\n"
                                   "centroid out vec3 skin_normal, skin_to_eye, skin_colour;\n"
                                   "centroid out float skin_opacity, skin_shininess;\n"
                                   "void main()\n"
                                   "{\n"
                                   "    skin_normal = normal;\n"
                                   "    skin_to_eye = eye - position;\n"
                                   "    skin_colour = colour;\n"
                                   "    skin_opacity = opacity;\n"
                                   "    skin_shininess = shininess;\n"
                                   "    gl_Position = projection * vec4(position, 1.0);\n"
                                   "}\n";

/* Two soft boxes of the studio: the key light and a strip at the rim; what a mirror sees of one that is
 * blurred by a Gaussian of standard deviation blur / sqrt 2. A box is a product of differences of the error
 * function, here a cubic that has its slope at 0 and its limits. */
#define BOXES                                                                                          \
    "const vec3 key_across = vec3(0.6455, 0.0, 0.7638);\n"                                             \
    "const vec3 key_along = vec3(0.4818, 0.7760, -0.4072);\n"                                          \
    "const vec3 strip = vec3(0.9079, 0.3561, -0.2213);\n"                                              \
    "const vec3 strip_across = vec3(-0.2368, 0.0, -0.9716);\n"                                         \
    "const vec3 strip_along = vec3(-0.3460, 0.9345, 0.0843);\n"                                        \
    "vec2 step_blurred(vec2 x)\n"                                                                      \
    "{\n"                                                                                              \
    "    vec2 t = clamp(0.752 * x, -1.0, 1.0);\n"                                                      \
    "    return t * (1.5 - 0.5 * t * t);\n"                                                            \
    "}\n"                                                                                              \
    "float box(vec3 ray, vec3 middle, vec3 across, vec3 along, vec2 half_size, float blur)\n"          \
    "{\n"                                                                                              \
    "    float ahead = dot(ray, middle);\n"                                                            \
    "    if (ahead < 0.1)\n"                                                                           \
    "        return 0.0;\n"                                                                            \
    "    vec2 at = vec2(dot(ray, across), dot(ray, along)) / ahead;\n"                                 \
    "    vec2 part = step_blurred((at + half_size) / blur) - step_blurred((at - half_size) / blur);\n" \
    "    return 0.25 * part.x * part.y;\n"                                                             \
    "}\n"

/* What a skin is like at a pixel is taken where it covers the pixel (centroid): beyond its ends a sliver
 * would go on to any colour. */

/* The normal n of the side that is seen, and its cosine with the line of sight; what is seen from its edge is
 * turned towards the eye a little. */
#define FACING                                                               \
    "    vec3 to_eye = normalize(skin_to_eye);\n"                            \
    "    vec3 n = normalize(gl_FrontFacing ? skin_normal : -skin_normal);\n" \
    "    float facing = dot(n, to_eye);\n"                                   \
    "    if (facing < 0.02) {\n"                                             \
    "        n = normalize(n + (0.02 - facing) * to_eye);\n"                 \
    "        facing = 0.02;\n"                                               \
    "    }\n"

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
#define PAPER                                                                                          \
    "centroid in vec3 skin_normal, skin_to_eye, skin_colour;\n"                                        \
    "centroid in float skin_opacity;\n"                                                                \
    "centroid in float skin_shininess;\n" STUDIO BOXES "void shade(out vec3 added, out vec3 passes)\n" \
    "{\n" FACING "    float path = inversesqrt(1.0 - (1.0 - facing * facing) / 2.31);\n"               \
    "    vec3 hold = 1.0 + 1.4 * (dot(skin_colour, vec3(1.0 / 3.0)) - skin_colour);\n"                 \
    "    passes = pow(vec3(max(1.0 - skin_opacity, 1e-6)), path * hold);\n"                            \
    "    if (skin_opacity > 0.999)\n"                                                                  \
    "        passes = vec3(0.0);\n"                                                                    \
    "    float body = body_light(n, 1.0 - skin_opacity);\n"                                            \
    "    vec3 pale = mix(skin_colour, vec3(1.0), 0.1 * (1.0 - skin_opacity));\n"                       \
    "    float rest = 1.0 - facing;\n"                                                                 \
    "    float fresnel = 0.043 + 0.957 * rest * rest * rest * rest * rest;\n"                          \
    "    float gloss = skin_shininess / (skin_shininess + 12.0);\n"                                    \
    "    float blur = 1.414 * inversesqrt(max(skin_shininess, 1.0));\n"                                \
    "    vec3 ray = reflect(-to_eye, n);\n"                                                            \
    "    float boxes = 9.0 * box(ray, key, key_across, key_along, vec2(0.36, 0.5), blur) +\n"          \
    "                  7.0 * box(ray, strip, strip_across, strip_along, vec2(0.14, 0.8), blur);\n"     \
    "    float around = mix(0.25, 0.75, 0.5 + 0.5 * ray.y) * smoothstep(-1.0, 0.3, ray.z);\n"          \
    "    float mirror = gloss * min(fresnel, 0.5) * (boxes + around);\n"                               \
    "    vec3 seen = pale * body * (1.0 - passes) + mirror;\n"                                         \
    "    added = on_film(seen);\n"                                                                     \
    "}\n"

/* How far the inside, where it is seen, is within: by the light that passes such skin. Where hardly any does,
 * it is not seen through the skin, but is turned outside, and would be black. It is one number for all
 * colours: those that pass least would else be mirrored within as brightly as without, and tint the skin. */
#define ENCLOSED                                                                      \
    "float enclosed(vec3 passing)\n"                                                  \
    "{\n"                                                                             \
    "    return smoothstep(0.02, 0.15, max(passing.r, max(passing.g, passing.b)));\n" \
    "}\n"

/*
 * Latex by its film thickness. A vertex has its optical depth at K + S = 1 (`film`: thickness at rest over
 * area stretch) and its roughness. Absorption follows from the colour by Kubelka and Munk (1931), K/S = (1 -
 * R)^2 / 2R for a thick skin of reflectance R, with scattering S = 2; what a film of finite depth reflects
 * and passes diffusely are their hyperbolic solutions with 2 K for diffuse light. Rubber pales as it thins
 * because S keeps reflecting where K no longer absorbs. That body light is found at the points, for both
 * sides: what falls on the near side is reflected, what falls on the far one comes through. Inside a closed
 * skin (`closed` 1) light bounces on and on: a geometric series, which is the glow of the inner wall.
 */
const char shader_latex_vertex[] =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in float film;\n"
    "layout(location = 3) in float roughness;\n"
    "layout(location = 4) in vec4 colour_closed;\n"
    "uniform mat4 projection;\n"
    "uniform vec3 eye;\n" STUDIO ENCLOSED "centroid out vec3 skin_normal, skin_to_eye;\n"
    "centroid out vec3 skin_depth, skin_outside, skin_inside;\n"
    "centroid out float skin_roughness, skin_closed;\n"
    "const float scattering = 2.0;\n"
    "void main()\n"
    "{\n"
    "    vec3 thick = 0.1 + 0.9 * colour_closed.rgb;\n"
    "    vec3 absorption = scattering * (1.0 - thick) * (1.0 - thick) / (2.0 * thick) + 0.01;\n"
    "    vec3 a = 1.0 + 2.0 * absorption / scattering;\n"
    "    vec3 b = sqrt(a * a - 1.0);\n"
    "    vec3 grown = exp(min(b * scattering * film, 40.0));\n"
    "    vec3 sine = 0.5 * (grown - 1.0 / grown), cosine = 0.5 * (grown + 1.0 / grown);\n"
    "    vec3 reflected = sine / (a * sine + b * cosine), passed = b / (a * sine + b * cosine);\n"
    "    vec3 n = normalize(normal);\n"
    "    float closed = colour_closed.a;\n"
    "    float outside = 1.25 * body_light(n, 0.0), behind = 1.25 * body_light(-n, 0.0);\n"
    "    vec3 glow = 0.45 * passed / (1.0 - 0.94 * reflected);\n"
    "    skin_depth = (absorption + scattering) * film;\n"
    "    vec3 inside = mix(vec3(behind), glow, closed * enclosed(exp(-skin_depth)));\n"
    "    skin_outside = reflected * outside + passed * inside;\n"
    "    skin_inside = reflected * inside + passed * outside;\n"
    "    skin_normal = normal;\n"
    "    skin_to_eye = eye - position;\n"
    "    skin_roughness = roughness;\n"
    "    skin_closed = closed;\n"
    "    gl_Position = projection * vec4(position, 1.0);\n"
    "}\n";

/*
 * A slab of index 1.52, exactly: Fresnel's F at either surface, Snell's angle inside, Beer and Lambert
 * along the path, and all inner reflections summed: T = (1 - F)^2 t / (1 - F^2 t^2), R = F (1 + T t) (Born
 * and Wolf, "Principles of Optics", 1.6, without interference). A rough surface that is seen at a grazing
 * angle shows the facets that are turned to the eye: where slopes have a Gaussian distribution of
 * roughness a (Beckmann's), the mean cosine of those that are seen is E(p^2)/E(p) = sqrt(pi) a/2 edge-on,
 * over slopes p > 0; straight on it is 1. The mirror sees boxes and room, blurred by the roughness, with
 * dark behind the skin, or a grazing view would be as bright as glass. Inside a closed skin it sees them
 * through the other wall.
 */
#define LATEX                                                                                                \
    "centroid in vec3 skin_normal, skin_to_eye, skin_depth, skin_outside, skin_inside;\n"                    \
    "centroid in float skin_roughness;\n"                                                                    \
    "centroid in float skin_closed;\n" STUDIO BOXES ENCLOSED "void shade(out vec3 added, out vec3 passes)\n" \
    "{\n" FACING "    float rough = min(0.886 * skin_roughness, 1.0);\n"                                     \
    "    float turned = sqrt(mix(facing * facing, 1.0, rough * rough));\n"                                   \
    "    float inner = sqrt(1.0 - (1.0 - turned * turned) / 2.3104);\n"                                      \
    "    float across = (turned - 1.52 * inner) / (turned + 1.52 * inner);\n"                                \
    "    float along = (inner - 1.52 * turned) / (inner + 1.52 * turned);\n"                                 \
    "    float fresnel = 0.5 * (across * across + along * along);\n"                                         \
    "    float enters = 1.0 - fresnel;\n"                                                                    \
    "    vec3 t = exp(-skin_depth / inner);\n"                                                               \
    "    passes = enters * enters * t / (1.0 - fresnel * fresnel * t * t);\n"                                \
    "    vec3 mirror = fresnel * (1.0 + passes * t);\n"                                                      \
    "    vec3 ray = reflect(-to_eye, n);\n"                                                                  \
    "    float blur = 1.2 * skin_roughness + 0.02;\n"                                                        \
    "    float seen = 11.0 * box(ray, key, key_across, key_along, vec2(0.40, 0.58), blur) +\n"               \
    "                 11.5 * box(ray, strip, strip_across, strip_along, vec2(0.14, 0.75), blur) +\n"         \
    "                 mix(0.25, 0.75, 0.5 + 0.5 * ray.y) * smoothstep(-0.9, 0.4, ray.z);\n"                  \
    "    vec3 window = exp(-skin_depth);\n"                                                                  \
    "    window = gl_FrontFacing ? vec3(1.0) : mix(vec3(1.0), window, skin_closed * enclosed(window));\n"    \
    "    vec3 body = gl_FrontFacing ? skin_outside : skin_inside;\n"                                         \
    "    added = enters * body + mirror * window * seen;\n"                                                  \
    "}\n"

/* Light to add, and the share of what lies behind to keep. */
#define BLENDED                                           \
    "layout(location = 0, index = 0) out vec4 light;\n"   \
    "layout(location = 0, index = 1) out vec4 passing;\n" \
    "void main()\n"                                       \
    "{\n"                                                 \
    "    vec3 added, passes;\n"                           \
    "    shade(added, passes);\n"                         \
    "    light = vec4(added, 1.0);\n"                     \
    "    passing = vec4(passes, 0.0);\n"                  \
    "}\n"

/* The farthest layer before the one that was taken last (Everitt, "Interactive order-independent
 * transparency", 2001, from behind). */
#define PEELED                                                                    \
    "uniform sampler2D taken;\n"                                                  \
    "layout(location = 0) out vec4 light;\n"                                      \
    "layout(location = 1) out vec4 passing;\n"                                    \
    "void main()\n"                                                               \
    "{\n"                                                                         \
    "    if (gl_FragCoord.z >= texelFetch(taken, ivec2(gl_FragCoord.xy), 0).r)\n" \
    "        discard;\n"                                                          \
    "    vec3 added, passes;\n"                                                   \
    "    shade(added, passes);\n"                                                 \
    "    light = vec4(added, 1.0);\n"                                             \
    "    passing = vec4(passes, 0.0);\n"                                          \
    "}\n"

/* Each pixel's fragments go into a linked list (Yang, Hensley, Gruen and Thibieroz, "Real-time concurrent
 * linked list construction on the GPU", 2010): five words each, in half precision but for the distance. More
 * than there is room for are only counted. */
#define LISTED                                                                             \
    "layout(early_fragment_tests) in;\n"                                                   \
    "layout(std430, binding = 0) buffer Heads { uint used; uint head[]; };\n"              \
    "layout(std430, binding = 1) buffer Nodes { uint node[]; };\n"                         \
    "uniform int width;\n"                                                                 \
    "uniform uint room;\n"                                                                 \
    "void main()\n"                                                                        \
    "{\n"                                                                                  \
    "    vec3 added, passes;\n"                                                            \
    "    shade(added, passes);\n"                                                          \
    "    uint place = atomicAdd(used, 1u);\n"                                              \
    "    if (place >= room)\n"                                                             \
    "        return;\n"                                                                    \
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"                                             \
    "    node[5u * place] = packHalf2x16(added.rg);\n"                                     \
    "    node[5u * place + 1u] = packHalf2x16(vec2(added.b, passes.r));\n"                 \
    "    node[5u * place + 2u] = packHalf2x16(passes.gb);\n"                               \
    "    node[5u * place + 3u] = floatBitsToUint(gl_FragCoord.z);\n"                       \
    "    node[5u * place + 4u] = atomicExchange(head[at.y * width + at.x], place + 1u);\n" \
    "}\n"

const char shader_paper_blended[] = "#version 330 core\n" PAPER BLENDED;
const char shader_paper_peeled[] = "#version 330 core\n" PAPER PEELED;
const char shader_paper_listed[] = "#version 430 core\n" PAPER LISTED;
const char shader_latex_blended[] = "#version 330 core\n" LATEX BLENDED;
const char shader_latex_peeled[] = "#version 330 core\n" LATEX PEELED;
const char shader_latex_listed[] = "#version 430 core\n" LATEX LISTED;
