#include "bakers/io/formats/png/text_renderer.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <optional>

namespace skybake {
namespace {

// --- UTF-8 --------------------------------------------------------------------------------------

constexpr char32_t replacement = 0xFFFD;

struct Decoded {
    char32_t character = replacement;
    std::size_t bytes = 1;
};

// The character that `text` begins with; the replacement of one byte where that is none.
Decoded first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return {static_cast<char32_t>(lead < 0x20 || lead == 0x7F ? ' ' : lead), 1};
    const std::size_t bytes = lead < 0xC2   ? 0  // a continuation, or a longer form of ASCII
                              : lead < 0xE0 ? 2
                              : lead < 0xF0 ? 3
                              : lead < 0xF5 ? 4
                                            : 0;
    if (bytes == 0 || bytes > text.size()) return {};
    char32_t character = lead & (0x7FU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) return {};
        character = (character << 6) | (byte(i) & 0x3FU);
    }
    constexpr std::array<char32_t, 5> smallest = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
    if (character < smallest[bytes] || character > 0x10FFFF || surrogate) return {};
    return {character, bytes};
}

std::vector<char32_t> characters_of(std::string_view text) {
    std::vector<char32_t> characters;
    while (!text.empty()) {
        const Decoded first = first_character(text);
        characters.push_back(first.character);
        text.remove_prefix(first.bytes);
    }
    return characters;
}

// --- The font -----------------------------------------------------------------------------------

// Where Debian, Fedora and Arch keep it.
constexpr std::array<const char*, 3> font_folders = {"/usr/share/fonts/truetype/dejavu",
                                                     "/usr/share/fonts/dejavu-sans-fonts",
                                                     "/usr/share/fonts/TTF"};

FT_Face open_font(FT_Library library, const char* file_name) {
    for (const char* const folder : font_folders) {
        FT_Face face = nullptr;
        const std::string path = std::string(folder) + "/" + file_name;
        if (FT_New_Face(library, path.c_str(), 0, &face) == 0) return face;
    }
    return nullptr;
}

// Both weights, opened once; they stay until the program ends.
struct Fonts {
    FT_Library library = nullptr;
    FT_Face regular = nullptr;
    FT_Face bold = nullptr;

    Fonts() {
        if (FT_Init_FreeType(&library) != 0) return;
        regular = open_font(library, "DejaVuSans.ttf");
        bold = open_font(library, "DejaVuSans-Bold.ttf");
    }
};

// --- Lines of text ------------------------------------------------------------------------------

// FreeType's 26.6 fixed point.
constexpr double units_per_pixel = 64;

// One character's coverage and where it lies relative to the line's origin, y down.
struct Glyph {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> coverage;
};

Glyph glyph_of(const FT_GlyphSlot slot, int whole_pixels) {
    const FT_Bitmap& bitmap = slot->bitmap;
    Glyph glyph{slot->bitmap_left + whole_pixels, -slot->bitmap_top, static_cast<int>(bitmap.width),
                static_cast<int>(bitmap.rows),
                std::vector<std::uint8_t>(std::size_t{bitmap.width} * bitmap.rows)};
    auto to = glyph.coverage.begin();
    for (unsigned row = 0; row < bitmap.rows; ++row) {
        const unsigned char* const from =
            bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch;
        to = std::copy_n(from, bitmap.width, to);
    }
    return glyph;
}

// Letters hinted along y alone stand on the baseline, and at fractions of a pixel along x are
// spaced as the font means it. A letter that cannot be drawn is left out.
std::vector<Glyph> lay_out(FT_Face face, const std::vector<char32_t>& characters, double& advance) {
    std::vector<Glyph> glyphs;
    FT_UInt previous = 0;
    for (const char32_t character : characters) {
        const FT_UInt index = FT_Get_Char_Index(face, character);
        FT_Vector kerning{};
        FT_Get_Kerning(face, previous, index, FT_KERNING_UNFITTED, &kerning);
        previous = index;
        advance += static_cast<double>(kerning.x) / units_per_pixel;
        if (FT_Load_Glyph(face, index, FT_LOAD_TARGET_LIGHT | FT_LOAD_NO_BITMAP) != 0) continue;
        const double whole = std::floor(advance);
        FT_Outline_Translate(&face->glyph->outline,
                             static_cast<FT_Pos>((advance - whole) * units_per_pixel), 0);
        advance += static_cast<double>(face->glyph->linearHoriAdvance) / 65536;  // 16.16
        if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) != 0) continue;
        glyphs.push_back(glyph_of(face->glyph, static_cast<int>(whole)));
    }
    std::erase_if(glyphs, [](const Glyph& glyph) { return glyph.coverage.empty(); });
    return glyphs;
}

TextBitmap line_of(const std::vector<Glyph>& glyphs) {
    TextBitmap line;
    if (glyphs.empty()) return line;
    int left = glyphs[0].x, top = glyphs[0].y, right = left, bottom = top;
    for (const Glyph& glyph : glyphs) {
        left = std::min(left, glyph.x);
        top = std::min(top, glyph.y);
        right = std::max(right, glyph.x + glyph.width);
        bottom = std::max(bottom, glyph.y + glyph.height);
    }
    line.width = right - left;
    line.height = bottom - top;
    line.baseline = -top;
    line.left = -left;
    line.coverage.resize(static_cast<std::size_t>(line.width) *
                         static_cast<std::size_t>(line.height));
    for (const Glyph& glyph : glyphs) {
        for (int y = 0; y < glyph.height; ++y) {
            for (int x = 0; x < glyph.width; ++x) {
                std::uint8_t& pixel = line.coverage[static_cast<std::size_t>(
                    (glyph.y - top + y) * line.width + glyph.x - left + x)];
                // Neighbouring letters that share a pixel do not darken it twice.
                pixel =
                    std::max(pixel, glyph.coverage[static_cast<std::size_t>(y * glyph.width + x)]);
            }
        }
    }
    return line;
}

TextBitmap problem(std::string words) {
    TextBitmap none;
    none.problem = std::move(words);
    return none;
}

}  // namespace

TextBitmap draw_text(std::string_view text, int em_pixels, FontWeight weight) {
    constexpr int largest_em = 256;
    constexpr std::size_t longest_text = 4096;  // keeps a line below 2^20 pixels
    if (em_pixels < 1 || em_pixels > largest_em) return problem("letters of no plausible height");
    if (text.size() > longest_text) return problem("a line of more than 4096 bytes");
    static std::mutex one_at_a_time;  // a face has one size and one slot for letters
    const std::lock_guard lock(one_at_a_time);
    static const Fonts fonts;
    const FT_Face face = weight == FontWeight::bold ? fonts.bold : fonts.regular;
    if (face == nullptr) return problem("the font DejaVu Sans is not installed");
    if (FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(em_pixels)) != 0) {
        return problem("the font DejaVu Sans has no letters of that height");
    }
    double advance = 0;
    TextBitmap line = line_of(lay_out(face, characters_of(text), advance));
    line.advance = advance;
    return line;
}

}  // namespace skybake
