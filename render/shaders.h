/* The programs that the graphics card runs, as GLSL 3.30; lists as 4.30. */
#ifndef RENDER_SHADERS_H
#define RENDER_SHADERS_H

/* Attributes of the skin, by location. */
enum { SHADER_POSITION, SHADER_NORMAL, SHADER_FILM, SHADER_GLOSS, SHADER_COLOUR };

/* Those of a solid, of lines and of text. */
enum { SHADER_SOLID_PLACE, SHADER_SOLID_COLOUR, SHADER_SOLID_NORMAL };
enum { SHADER_LINE_FROM, SHADER_LINE_TO, SHADER_LINE_CORNER, SHADER_LINE_COLOUR };
enum { SHADER_TEXT_PLACE, SHADER_TEXT_DOT, SHADER_TEXT_DOTS, SHADER_TEXT_COLOUR };

extern const char shader_paper_vertex[], shader_paper_blended[], shader_paper_peeled[], shader_paper_listed[];
extern const char shader_latex_vertex[], shader_latex_blended[], shader_latex_peeled[], shader_latex_listed[];
extern const char shader_whole_vertex[], shader_tone_fragment[], shader_layer_fragment[],
    shader_list_fragment[];
extern const char shader_outlines_fragment[], shader_stereo_fragment[];
extern const char shader_solid_vertex[], shader_solid_fragment[];
extern const char shader_line_vertex[], shader_line_fragment[];
extern const char shader_text_vertex[], shader_text_fragment[];
extern const char shader_backdrop_vertex[], shader_backdrop_fragment[];
extern const char shader_shadow_vertex[], shader_shadow_fragment[];

#endif
