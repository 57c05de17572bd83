/* The programs that the graphics card runs, as GLSL 3.30. */
#ifndef RENDER_SHADERS_H
#define RENDER_SHADERS_H

/* Attributes of the skin, by location. */
enum { SHADER_POSITION, SHADER_NORMAL, SHADER_OPACITY, SHADER_SHININESS, SHADER_COLOUR };

extern const char shader_skin_vertex[], shader_skin_fragment[];
extern const char shader_backdrop_vertex[], shader_backdrop_fragment[];
extern const char shader_shadow_vertex[], shader_shadow_fragment[];

#endif
