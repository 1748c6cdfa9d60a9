// Drawing on pictures: areas, lines and text. What lies outside of the picture is cut off.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "bakers/io/formats/png/image_codec.h"
#include "bakers/plot/picture.h"

namespace skybake {

using Colour = std::array<std::uint8_t, 3>;

// Of plots, as reports have them.
inline constexpr Colour ink_colour = {0x1f, 0x23, 0x28};
inline constexpr Colour pale_ink_colour = {0x59, 0x63, 0x6e};
inline constexpr Colour grid_colour = {0xe6, 0xe8, 0xeb};
inline constexpr Colour paper_colour = {0xff, 0xff, 0xff};

// What is `share` of the way from one to the other, in sRGB.
Colour mixed(Colour from, Colour to, double share);

// In pixels; the centre of the picture's first pixel is at (1/2, 1/2), y down.
struct CanvasPoint {
    double x = 0;
    double y = 0;
};

enum class TextAlign { left, centre, right };

struct TextStyle {
    int em_pixels = 13;
    FontWeight weight = FontWeight::regular;
    Colour colour = ink_colour;
};

// How far a text goes, in pixels.
double text_width(std::string_view text, const TextStyle& style);

class Canvas {
  public:
    Canvas(int width, int height, Colour background);

    void fill(int x, int y, int width, int height, Colour colour);
    void place(const Picture& picture, int x, int y);

    // A line through the points, `width` pixels wide, its edges smoothed.
    void draw_line(const std::vector<CanvasPoint>& points, double width, Colour colour);

    // Text whose baseline is at `baseline` and whose left end, middle or right end is at `x`.
    void write(std::string_view text, int x, int baseline, TextAlign align, const TextStyle& style);

    // The same turned a quarter to the left, to be read from below: its baseline is the column
    // `baseline`, its middle is at `y`.
    void write_upwards(std::string_view text, int baseline, int y, const TextStyle& style);

    const Picture& picture() const { return picture_; }

  private:
    void blend(int x, int y, Colour colour, double share);

    Picture picture_;
};

}  // namespace skybake
