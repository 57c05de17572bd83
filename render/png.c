/* The only file that knows libpng. */
#include "common/array.h"
#include "common/file.h"
#include "render/image.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* libpng's callbacks: the message is kept, nothing is printed. */
static void keep_message(png_structp png, png_const_charp message)
{
    struct error *err = png_get_error_ptr(png);
    error_set(err, STATUS_FILE, "%s", message);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static bool is_ascii(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text > 126)
            return false;
    return true;
}

/* The texts as libpng wants them; free() them. NULL when memory is short. */
static png_text *new_texts(const struct image_text *texts, size_t count)
{
    png_text *list = array_new(count, sizeof *list);
    if (!list)
        return NULL;
    memset(list, 0, count * sizeof *list);
    for (size_t i = 0; i < count; i++) {
        list[i].key = (png_charp)texts[i].key;
        list[i].text = (png_charp)texts[i].value;
        list[i].compression = is_ascii(texts[i].value) ? PNG_TEXT_COMPRESSION_NONE
                                                       : PNG_ITXT_COMPRESSION_NONE;
    }
    return list;
}

/* Everything between the two ends of libpng's setjmp: no local variable may change here. */
static bool write_all(png_structp png, png_infop info, const struct image *image, png_text *texts,
                      size_t text_count, FILE *stream)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_init_io(png, stream);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, Z_FILTERED);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    if (text_count)
        png_set_text(png, info, texts, (int)text_count);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, image->rgb + 3 * (size_t)image->width * (size_t)y);
    png_write_end(png, NULL);
    return true;
}

static enum status write_png(const struct image *image, const struct image_text *texts, size_t text_count,
                             FILE *stream, struct error *err)
{
    struct error problem = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &problem, keep_message, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    png_text *list = new_texts(texts, text_count);
    enum status status = STATUS_OK;
    if (!info || !list)
        status = error_no_memory(err, "a PNG file");
    else if (!write_all(png, info, image, list, text_count, stream))
        status = error_set(err, STATUS_FILE, "cannot write: %s", problem.text);
    free(list);
    png_destroy_write_struct(&png, &info);
    return status;
}

enum status image_save_png(const struct image *image, const char *path, const struct image_text *texts,
                           size_t text_count, struct error *err)
{
    struct file_out *out;
    enum status status = file_out_open(path, &out, err);
    if (status)
        return status;
    status = write_png(image, texts, text_count, file_out_stream(out), err);
    /* a failed write is better told by commit, which knows the system's reason */
    if (!status || ferror(file_out_stream(out)))
        return file_out_commit(out, err);
    file_out_abandon(out);
    return error_prefix(err, path);
}

enum status image_encode_png(const struct image *image, const struct image_text *texts, size_t text_count,
                             struct bytes *png, struct error *err)
{
    char *data = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&data, &size);
    if (!stream)
        return error_no_memory(err, "a PNG file");
    enum status status = write_png(image, texts, text_count, stream, err);
    if (fclose(stream) && !status)
        status = error_no_memory(err, "a PNG file");
    if (status)
        free(data);
    else
        *png = (struct bytes){(unsigned char *)data, size};
    return status;
}
