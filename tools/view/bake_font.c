/* bake_font.c - a step of the build, run where the library is built: draws the printable characters of ASCII from a monospaced font
 * into a table of C, for overlay.c. FreeType does the drawing.
 *
 *     bake_font FONT.ttf > font.h */
#include <ft2build.h>
#include FT_FREETYPE_H
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 16, ROWS = 6, FIRST = 32, CHARACTERS = 95 };

static void must(int ok, const char *what)
{
    if (ok)
        return;
    fprintf(stderr, "bake_font: %s\n", what);
    exit(1);
}

/* Cells of one size, in rows of 16; the last of all, which no character has, is full. */
static void bake(FT_Face face, unsigned size, const char *name)
{
    unsigned width, height, baseline;
    unsigned char *atlas;

    must(FT_Set_Pixel_Sizes(face, 0, size) == 0, "the font has no such size");
    must(FT_Load_Char(face, 'M', FT_LOAD_TARGET_LIGHT) == 0, "the font has no M");
    width = (unsigned)((face->glyph->advance.x + 32) >> 6);
    height = (unsigned)((face->size->metrics.ascender - face->size->metrics.descender + 63) >> 6);
    baseline = (unsigned)((face->size->metrics.ascender + 32) >> 6);
    atlas = calloc((size_t)COLUMNS * width, (size_t)ROWS * height);
    must(atlas != NULL, "no memory");
    for (unsigned c = 0; c < CHARACTERS; c++) {
        const unsigned left = c % COLUMNS * width, top = c / COLUMNS * height;

        must(FT_Load_Char(face, FIRST + c, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) == 0, "the font lacks a character");
        for (unsigned y = 0; y < face->glyph->bitmap.rows; y++)
            for (unsigned x = 0; x < face->glyph->bitmap.width; x++) {
                const int px = (int)x + face->glyph->bitmap_left, py = (int)(baseline + y) - face->glyph->bitmap_top;

                if (px >= 0 && px < (int)width && py >= 0 && py < (int)height)
                    atlas[((size_t)top + (unsigned)py) * COLUMNS * width + left + (unsigned)px] =
                        face->glyph->bitmap.buffer[y * (unsigned)face->glyph->bitmap.pitch + x];
            }
    }
    for (unsigned y = 0; y < height; y++)
        memset(atlas + ((size_t)(ROWS - 1) * height + y) * COLUMNS * width + (size_t)(COLUMNS - 1) * width, 255, width);
    printf("static const unsigned char %s_pixels[] = {", name);
    for (size_t i = 0; i < (size_t)COLUMNS * width * ROWS * height; i++)
        printf("%s%u,", i % 32 ? "" : "\n", atlas[i]);
    printf("};\nenum { %s_WIDTH = %u, %s_HEIGHT = %u };\n", name, width, name, height);
    free(atlas);
}

int main(int count, char **arguments)
{
    FT_Library library;
    FT_Face face;

    must(count == 2, "usage: bake_font FONT.ttf");
    must(FT_Init_FreeType(&library) == 0, "FreeType does not start");
    must(FT_New_Face(library, arguments[1], 0, &face) == 0, "the font cannot be read");
    bake(face, 13, "small");
    bake(face, 26, "large");
    FT_Done_Face(face);
    FT_Done_FreeType(library);
    return fflush(stdout) != 0 || ferror(stdout);
}
