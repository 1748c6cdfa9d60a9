#include "bakers/plot/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/plot/label.h"

namespace skybake {
namespace {

double distance_to_segment(CanvasPoint p, CanvasPoint a, CanvasPoint b) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double length_squared = dx * dx + dy * dy;
    const double along = (p.x - a.x) * dx + (p.y - a.y) * dy;
    const double t = length_squared > 0 ? std::clamp(along / length_squared, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

// Pixels of one axis, end not included, that lie within `reach` of both coordinates.
struct PixelSpan {
    int begin = 0;
    int end = 0;
};
PixelSpan pixels_about(double a, double b, double reach, int count) {
    const auto pixel = [&](double x) {
        return static_cast<int>(std::clamp(std::floor(x), 0.0, static_cast<double>(count)));
    };
    return {pixel(std::min(a, b) - reach), pixel(std::max(a, b) + reach + 1)};
}

// Where text of a width begins.
int text_begin(int x, double width, TextAlign align) {
    switch (align) {
        case TextAlign::left:
            return x;
        case TextAlign::centre:
            return x - static_cast<int>(std::lround(width / 2));
        case TextAlign::right:
            return x - static_cast<int>(std::lround(width));
    }
    return x;
}

}  // namespace

Colour mixed(Colour from, Colour to, double share) {
    Colour colour{};
    for (std::size_t i = 0; i < colour.size(); ++i) {
        colour[i] = static_cast<std::uint8_t>(std::lround(from[i] + share * (to[i] - from[i])));
    }
    return colour;
}

double text_width(std::string_view text, const TextStyle& style) {
    return label(text, style.em_pixels, style.weight).advance;
}

Canvas::Canvas(int width, int height, Colour background) : picture_(width, height) {
    fill(0, 0, width, height, background);
}

void Canvas::fill(int x, int y, int width, int height, Colour colour) {
    const int x_begin = std::max(x, 0), x_end = std::min(x + width, picture_.width);
    for (int row = std::max(y, 0); row < std::min(y + height, picture_.height); ++row) {
        auto pixel = picture_.rgb.begin() +
                     3 * (static_cast<std::ptrdiff_t>(row) * picture_.width + x_begin);
        for (int column = x_begin; column < x_end; ++column) {
            pixel = std::copy(colour.begin(), colour.end(), pixel);
        }
    }
}

void Canvas::place(const Picture& picture, int x, int y) {
    const int first = std::max(0, -x);
    const int last = std::min(picture.width, picture_.width - x);
    if (first >= last) return;
    for (int row = std::max(0, -y); row < std::min(picture.height, picture_.height - y); ++row) {
        const auto index = [](int width, int column, int line) {
            return 3 * (static_cast<std::ptrdiff_t>(line) * width + column);
        };
        std::copy(picture.rgb.begin() + index(picture.width, first, row),
                  picture.rgb.begin() + index(picture.width, last, row),
                  picture_.rgb.begin() + index(picture_.width, x + first, y + row));
    }
}

void Canvas::draw_line(const std::vector<CanvasPoint>& points, double width, Colour colour) {
    // Coverage of the whole line first, so that its segments do not darken their joints.
    std::vector<float> coverage(static_cast<std::size_t>(picture_.width) *
                                static_cast<std::size_t>(picture_.height));
    const double reach = width / 2 + 0.5;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const CanvasPoint a = points[i - 1], b = points[i];
        const PixelSpan columns = pixels_about(a.x, b.x, reach, picture_.width);
        const PixelSpan rows = pixels_about(a.y, b.y, reach, picture_.height);
        for (int y = rows.begin; y < rows.end; ++y) {
            for (int x = columns.begin; x < columns.end; ++x) {
                const double away = distance_to_segment({x + 0.5, y + 0.5}, a, b);
                float& pixel = coverage[static_cast<std::size_t>(y) *
                                            static_cast<std::size_t>(picture_.width) +
                                        static_cast<std::size_t>(x)];
                pixel = std::max(pixel, static_cast<float>(std::clamp(reach - away, 0.0, 1.0)));
            }
        }
    }
    for (int y = 0; y < picture_.height; ++y) {
        for (int x = 0; x < picture_.width; ++x) {
            const float share =
                coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                         static_cast<std::size_t>(x)];
            if (share > 0) blend(x, y, colour, double{share});
        }
    }
}

void Canvas::write(std::string_view text, int x, int baseline, TextAlign align,
                   const TextStyle& style) {
    const TextBitmap& line = label(text, style.em_pixels, style.weight);
    const int begin = text_begin(x, line.advance, align);
    for (int row = 0; row < line.height; ++row) {
        for (int column = 0; column < line.width; ++column) {
            const auto index = static_cast<std::size_t>(row * line.width + column);
            blend(begin - line.left + column, baseline - line.baseline + row, style.colour,
                  line.coverage[index] / 255.0);
        }
    }
}

void Canvas::write_upwards(std::string_view text, int baseline, int y, const TextStyle& style) {
    const TextBitmap& line = label(text, style.em_pixels, style.weight);
    const int begin = y + static_cast<int>(std::lround(line.advance / 2));
    for (int row = 0; row < line.height; ++row) {
        for (int column = 0; column < line.width; ++column) {
            const auto index = static_cast<std::size_t>(row * line.width + column);
            blend(baseline - line.baseline + row, begin + line.left - column, style.colour,
                  line.coverage[index] / 255.0);
        }
    }
}

void Canvas::blend(int x, int y, Colour colour, double share) {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return;
    std::uint8_t* const pixel =
        picture_.rgb.data() +
        3 * (static_cast<std::ptrdiff_t>(y) * picture_.width + static_cast<std::ptrdiff_t>(x));
    const Colour result = mixed({pixel[0], pixel[1], pixel[2]}, colour, share);
    std::copy(result.begin(), result.end(), pixel);
}

}  // namespace skybake
