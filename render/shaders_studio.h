/* The studio that skins and solids stand in, as GLSL to begin a shader with. It is fixed to the camera. */
#ifndef RENDER_SHADERS_STUDIO_H
#define RENDER_SHADERS_STUDIO_H

/* The light of the studio on a matte surface, with what comes through it from behind,
 * and film; see the skin. */
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

#endif
