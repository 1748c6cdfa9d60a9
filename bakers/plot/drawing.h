// What a chart is drawn of, and the seam to the libraries that draw it.
//
// Cairo and Pango load 30 libraries, which no bake needs: they are behind the module
// skybake_charts, which is loaded when the first picture is drawn (load_module.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Pictures for eyes: what every part of a preview is made into.

// 8 bits per channel, R G B interleaved, sRGB; row 0 is at the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    Picture() = default;
    Picture(int width_, int height_)
        : width(width_),
          height(height_),
          rgb(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3) {}
};

// The bytes of a PNG, 8 bits per channel, sRGB, without date or software's name: the same picture
// gives the same bytes. E0300 where the module that makes them is not there; E0500 where it refuses
// the picture (its size contradicts its bytes, or it has no pixels: a mistake of the program).
config::Outcome<std::string> png_bytes(const Picture& picture);

// image  tones or greys that mean themselves
// scene  what an eye would see, to be looked at as large as the page has room for
// plot   lines or false colours on paper, which may be dark as the page is
enum class PictureKind { image, scene, plot };

// A picture with what a page says of it.
struct PreviewPicture {
    std::string name;   // the file's stem, unique in a preview: "transmittance_red"
    std::string title;  // "Transmittance, red"
    // What one sees, with units, exposure and tone curve, in a sentence or two.
    std::string caption;
    Picture picture;
    std::optional<double> exposure = {};  // what radiance was multiplied by, in pictures of light
    PictureKind kind = PictureKind::image;
};

inline PreviewPicture as_plot(PreviewPicture picture) {
    picture.kind = PictureKind::plot;
    return picture;
}

// R G B, sRGB.
using Colour = std::array<std::uint8_t, 3>;

inline constexpr Colour ink_colour = {0x1f, 0x23, 0x28};
inline constexpr Colour pale_ink_colour = {0x59, 0x63, 0x6e};
inline constexpr Colour grid_colour = {0xe6, 0xe8, 0xeb};
inline constexpr Colour paper_colour = {0xff, 0xff, 0xff};

// In pixels from the upper left corner of the drawing, y down: the centre of the first pixel is at
// (1/2, 1/2).
struct DrawingPoint {
    double x = 0;
    double y = 0;
};

// A line through the points, or the area that it encloses, or circles about the points.
struct Shape {
    std::vector<DrawingPoint> points;
    bool closed = false;
    double radius = 0;           // above 0: a circle about each point, and no line
    std::optional<Colour> fill;  // none: hollow
    Colour stroke = ink_colour;
    double stroke_width = 0;  // 0: no outline
};

enum class FontWeight { regular, bold };
enum class TextAlign { left, centre, right };

struct TextStyle {
    int em_pixels = 13;
    FontWeight weight = FontWeight::regular;
    Colour colour = ink_colour;
};

// One line of UTF-8 in DejaVu Sans whose left end, middle or right end is at `x`. Bytes that are
// not UTF-8 show as U+FFFD, control characters as spaces.
struct TextLine {
    std::string text;
    DrawingPoint baseline;
    TextAlign align = TextAlign::left;
    TextStyle style;
    bool upwards = false;  // turned a quarter to the left, to be read from below
};

// A picture whose upper left corner is at (x, y), one of its pixels on each pixel of the drawing.
struct PlacedPicture {
    Picture picture;
    int x = 0;
    int y = 0;
};

// What a viewer of an SVG file shows under the pointer.
struct Tooltip {
    DrawingPoint centre;
    std::string text;
};

using DrawingItem = std::variant<Shape, TextLine, PlacedPicture>;

struct Drawing {
    int width = 0;
    int height = 0;
    std::vector<DrawingItem> items;  // later ones cover earlier ones
    std::string title;               // of the SVG file
    std::vector<Tooltip> tooltips;

    void fill(int x, int y, int width, int height, Colour colour);
    void line(std::vector<DrawingPoint> points, double width, Colour colour);
    void write(std::string_view text, double x, double baseline, TextAlign align,
               const TextStyle& style);
    void write_upwards(std::string_view text, double baseline, double y, const TextStyle& style);
};

// How far a text goes, in pixels; 0 where text cannot be drawn.
double text_width(std::string_view text, const TextStyle& style);

// The drawing on white paper. What lies outside of it is cut off.
Picture painted(const Drawing& drawing);

// The same as an SVG file, well-formed whatever the texts hold. Letters are outlines, so that they
// look the same in every viewer. The same drawing gives the same bytes. `comment` stands in its
// second line.
std::string svg_of(const Drawing& drawing, std::string_view comment);

// Why charts cannot be drawn as they should be, or nothing: the error E0300 without the module, the
// warning W0302 without the font DejaVu Sans, where charts have no text. To be asked before charts
// are drawn; without the module they are blank.
[[nodiscard]] std::optional<config::Diagnostic> chart_problem();

// What the module exports. For any number of threads.
struct ChartModule {
    bool (*has_font)();
    double (*text_width)(std::string_view text, const TextStyle& style);
    Picture (*paint)(const Drawing& drawing);
    std::string (*svg)(const Drawing& drawing);  // empty: the library refuses the size
};
using ChartModuleFunction = const ChartModule* (*)();
inline constexpr const char* chart_module_symbol = "skybake_chart_module";

}  // namespace skybake
