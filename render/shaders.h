/* The programs that the graphics card runs, as GLSL 3.30. */
#ifndef RENDER_SHADERS_H
#define RENDER_SHADERS_H

/* Attributes of the skin, by location. */
enum { SHADER_POSITION, SHADER_NORMAL, SHADER_OPACITY, SHADER_SHININESS, SHADER_COLOUR };

/* Those of a solid, of lines and of text. */
enum { SHADER_SOLID_PLACE, SHADER_SOLID_COLOUR, SHADER_SOLID_NORMAL };
enum { SHADER_LINE_FROM, SHADER_LINE_TO, SHADER_LINE_CORNER, SHADER_LINE_COLOUR };
enum { SHADER_TEXT_PLACE, SHADER_TEXT_DOT, SHADER_TEXT_DOTS, SHADER_TEXT_COLOUR };

extern const char shader_skin_vertex[], shader_skin_fragment[];
extern const char shader_solid_vertex[], shader_solid_fragment[];
extern const char shader_line_vertex[], shader_line_fragment[];
extern const char shader_text_vertex[], shader_text_fragment[];
extern const char shader_backdrop_vertex[], shader_backdrop_fragment[];
extern const char shader_shadow_vertex[], shader_shadow_fragment[];

#endif
