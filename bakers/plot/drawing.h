// Pictures, drawings of shapes and text, and the interface of the module that draws them.
//
// Cairo and Pango load 30 libraries, which no bake needs. Only the module skybake_charts uses them,
// and it is loaded when the first picture is drawn (load_module.h).
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

// A picture for people to look at: 8 bits per channel, R G B interleaved, sRGB; row 0 is at the
// top.
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

// Returns the bytes of a PNG with 8 bits per channel, sRGB, without date or software's name, so the
// same picture gives the same bytes. E0300 if the module that makes them is missing; E0500 if it
// refuses the picture, because its size contradicts its bytes or it has no pixels (a bug in the
// program).
Outcome<std::string> png_bytes(const Picture& picture);

// image  colours or greys that are values, not light
// scene  what an eye would see; shown as large as the page has room for
// plot   lines or false colours on paper, which may be dark like the page
enum class PictureKind { image, scene, plot };

// A picture and what a page says about it.
struct PreviewPicture {
    std::string name;   // the file's stem, unique in a preview: "transmittance_red"
    std::string title;  // "Transmittance, red"
    // Says in a sentence or two what the picture shows, with units, exposure and tone curve.
    std::string caption;
    Picture picture;
    std::optional<double> exposure = {};  // the factor of radiance, in pictures of light
    PictureKind kind = PictureKind::image;
    std::string sequence = {};  // a page shows pictures of the same sequence as one that turns
    // A page shows pictures of the same group in one place. `tab` names one of them there.
    std::string group = {};
    std::string tab = {};
    bool titled = false;           // the title stands in the picture
    double frames_per_second = 0;  // of a sequence that plays by itself; 0: it does not
};

inline PreviewPicture as_plot(PreviewPicture picture) {
    picture.kind = PictureKind::plot;
    picture.titled = true;
    return picture;
}

// A colour: R G B in sRGB.
using Colour = std::array<std::uint8_t, 3>;

inline constexpr Colour ink_colour = {0x1f, 0x23, 0x28};
inline constexpr Colour pale_ink_colour = {0x59, 0x63, 0x6e};
inline constexpr Colour grid_colour = {0xe6, 0xe8, 0xeb};
inline constexpr Colour paper_colour = {0xff, 0xff, 0xff};

// The same for drawings on dark paper.
inline constexpr Colour dark_ink_colour = {0xe5, 0xea, 0xf0};
inline constexpr Colour dark_pale_ink_colour = {0xa3, 0xaf, 0xbd};
inline constexpr Colour dark_grid_colour = {0x2a, 0x34, 0x41};
inline constexpr Colour dark_paper_colour = {0x17, 0x1d, 0x26};

// A point, in pixels from the upper left corner of the drawing, with y downwards. The centre of the
// first pixel is at (1/2, 1/2).
struct DrawingPoint {
    double x = 0;
    double y = 0;
};

// A line through the points, the area that it encloses, or circles around the points.
struct Shape {
    std::vector<DrawingPoint> points;
    bool closed = false;
    double radius = 0;           // above 0: a circle around each point, and no line
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
    bool upwards = false;  // turned left by 90 degrees, to be read from below
};

// A picture whose upper left corner is at (x, y). Each of its pixels covers one pixel of the
// drawing.
struct PlacedPicture {
    Picture picture;
    int x = 0;
    int y = 0;
};

// A text that a viewer of an SVG file shows under the pointer.
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

// Returns the width of a text in pixels; 0 if text cannot be drawn.
double text_width(std::string_view text, const TextStyle& style);

// Paints the drawing on white paper. Parts outside of it are cut off.
Picture painted(const Drawing& drawing);

// Returns the drawing on dark paper: the four colours above become those of dark paper, and all others
// stay.
Drawing on_dark_paper(Drawing drawing);

// Returns the drawing as an SVG file, which is well-formed whatever the texts contain. Letters are
// outlines, so that they look the same in every viewer. The same drawing gives the same bytes. The
// file's second line is `comment`.
std::string svg_of(const Drawing& drawing, std::string_view comment);

// Returns why charts cannot be drawn properly, or nothing. Call it before drawing charts. Without
// the module it returns the error E0300, and charts would be blank; without the font DejaVu Sans it
// returns the warning W0302, and charts have no text.
[[nodiscard]] std::optional<Diagnostic> chart_problem();

// The functions of the module. Any number of threads may call them.
struct ChartModule {
    bool (*has_font)();
    double (*text_width)(std::string_view text, const TextStyle& style);
    Picture (*paint)(const Drawing& drawing);
    std::string (*svg)(const Drawing& drawing);  // empty: the library refuses the size
};
inline constexpr const char* chart_module_symbol = "skybake_chart_module";

}  // namespace skybake
