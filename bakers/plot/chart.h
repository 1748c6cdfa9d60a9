// Pictures with what makes them readable: axes with units, colour bars, titles, labels.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/plot/picture.h"

namespace skybake {

enum class AxisTicks {
    decimal,      // at 1, 2 and 5 times powers of ten
    angles,       // at 90, 30, 15, 5 degrees where there is no room for finer ones
    logarithmic,  // at powers of ten
};

// One axis of a picture: `value(t)` is the physical value at t in [0, 1] along it, monotonic, not
// necessarily linear (a table's mapping), from left to right or from the bottom up.
struct ChartAxis {
    std::string title;  // "sun zenith angle (deg)"
    std::function<double(double)> value;
    AxisTicks ticks = AxisTicks::decimal;
};

// What colours mean; none where the picture is tone-mapped.
struct ColourScale {
    double low = 0;
    double high = 1;
    bool logarithmic = false;
    bool diverging = false;  // 0 in the middle: low == -high
    std::string title;       // "transmittance"
};

// A scalar field in false colours (one channel; row 0 at the bottom; grey where it is NaN),
// enlarged to at least `smallest_edge` pixels along its longer edge by nearest texels, with axes
// and colour bar. Fields of more than 1024 texels along an edge, or 2 smallest_edge, are averaged.
// An empty field has an empty chart.
Picture false_colour_chart(const Image2<float>& field, const ColourScale& scale,
                           const std::string& title, const ChartAxis& across, const ChartAxis& up,
                           int smallest_edge = 512);

// A finished picture (row 0 at the top) in the same frame, without a colour bar; of an empty
// one, an empty chart.
Picture framed(const Picture& picture, const std::string& title, const ChartAxis& across,
               const ChartAxis& up);

struct ChartLine {
    std::string name;
    std::array<std::uint8_t, 3> colour{};
    std::vector<double> x;
    std::vector<double> y;
};

// Curves over a shared axis: profiles, histograms, spectra.
Picture line_chart(const std::vector<ChartLine>& lines, const std::string& title,
                   const std::string& x_title, const std::string& y_title, bool logarithmic_x,
                   bool logarithmic_y);

// Pictures in a grid of `columns`, each with its caption below; for contact sheets and comparisons.
Picture contact_sheet(const std::vector<Picture>& pictures,
                      const std::vector<std::string>& captions, int columns);

}  // namespace skybake
