#include "bakers/plot/false_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace skybake {
namespace {

// Coefficients of t^0 to t^6, for red, green and blue from 0 to 1.
using Polynomial = std::array<double, 7>;
constexpr std::array<Polynomial, 3> viridis = {{
    {0.2777273272234177, 0.1050930431085774, -0.3308618287255563, -4.634230498983486,
     6.228269936347081, 4.776384997670288, -5.435455855934631},
    {0.005407344544966578, 1.404613529898575, 0.214847559468213, -5.799100973351585,
     14.17993336680509, -13.74514537774601, 4.645852612178535},
    {0.3340998053353061, 1.384590162594685, 0.09509516302823659, -19.33244095627987,
     56.69055260068105, -65.35303263337234, 26.3124352495832},
}};

double at(const Polynomial& polynomial, double t) {
    double sum = 0;
    for (std::size_t i = polynomial.size(); i-- > 0;) sum = sum * t + polynomial[i];
    return sum;
}

constexpr std::array<Colour, 7> diverging_stops = {{{23, 45, 110},
                                                    {58, 113, 181},
                                                    {156, 198, 225},
                                                    {245, 245, 243},
                                                    {246, 190, 140},
                                                    {214, 96, 57},
                                                    {120, 22, 33}}};

// The sky, thin cloud that it shines through, grey cloud and white cloud.
constexpr std::array<Colour, 5> cloud_stops = {
    {{24, 50, 92}, {70, 99, 138}, {128, 145, 164}, {190, 195, 200}, {252, 252, 250}}};

// Returns the colour at the fraction `share` of the way from one to the other, in sRGB.
Colour mixed(Colour from, Colour to, double share) {
    Colour colour{};
    for (std::size_t i = 0; i < colour.size(); ++i) {
        colour[i] = static_cast<std::uint8_t>(std::lround(from[i] + share * (to[i] - from[i])));
    }
    return colour;
}

// The colour of places without a value.
constexpr Colour missing_colour = {0xd0, 0xd4, 0xd9};

// Returns the place of a value on a scale: 0 at low, 1 at high. Values beyond them, and values
// without a logarithm, are at the nearer end.
double place_on(const ColourScale& scale, double value) {
    const double t = scale.logarithmic ? std::log(std::max(value, scale.low) / scale.low) /
                                             std::log(scale.high / scale.low)
                                       : (value - scale.low) / (scale.high - scale.low);
    return std::isnan(t) ? 0.5 : std::clamp(t, 0.0, 1.0);  // low == high
}

Image2<float> averaged(const Image2<float>& field, int block) {
    Image2<float> small((field.width + block - 1) / block, (field.height + block - 1) / block,
                        field.channels);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            const int x_end = std::min((x + 1) * block, field.width);
            const int y_end = std::min((y + 1) * block, field.height);
            const int count = (x_end - x * block) * (y_end - y * block);
            for (int channel = 0; channel < field.channels; ++channel) {
                double sum = 0;
                for (int row = y * block; row < y_end; ++row) {
                    for (int column = x * block; column < x_end; ++column) {
                        sum += double{field.texel(column, row)[channel]};
                    }
                }
                small.texel(x, y)[channel] = static_cast<float>(sum / count);
            }
        }
    }
    return small;
}

Image2<float> repeated(const Image2<float>& field, int times) {
    Image2<float> large(field.width * times, field.height * times, field.channels);
    for (int y = 0; y < large.height; ++y) {
        for (int x = 0; x < large.width; ++x) {
            std::copy_n(field.texel(x / times, y / times), field.channels, large.texel(x, y));
        }
    }
    return large;
}

template <std::size_t kStops>
Colour between(const std::array<Colour, kStops>& stops, double t) {
    const double place = t * static_cast<double>(kStops - 1);
    const auto stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    return mixed(stops[stop], stops[stop + 1], place - static_cast<double>(stop));
}

}  // namespace

Colour sequential_colour(double t) {
    Colour colour{};
    for (std::size_t i = 0; i < colour.size(); ++i) {
        // The polynomials exceed [0, 1] by a few thousandths.
        const double value = std::clamp(at(viridis[i], t), 0.0, 1.0);
        colour[i] = static_cast<std::uint8_t>(std::lround(255 * value));
    }
    return colour;
}

Colour diverging_colour(double t) { return between(diverging_stops, t); }

Colour cloud_colour(double t) { return between(cloud_stops, t); }

ChartAxis ColourScale::axis() const {
    return logarithmic ? logarithmic_axis(title, low, high) : linear_axis(title, low, high);
}

Picture in_false_colours(const Image2<float>& field, const ColourScale& scale) {
    Picture picture(field.width, field.height);
    auto pixel = picture.rgb.begin();
    for (int y = field.height - 1; y >= 0; --y) {
        for (int x = 0; x < field.width; ++x) {
            const double value = double{*field.texel(x, y)};
            const Colour colour =
                std::isnan(value) ? missing_colour : scale.colour_at(place_on(scale, value));
            pixel = std::copy(colour.begin(), colour.end(), pixel);
        }
    }
    return picture;
}

Image2<float> fitted(const Image2<float>& field, int smallest_edge, int longest_edge) {
    const int longer = std::max(field.width, field.height);
    if (longer == 0) return field;
    if (longer > longest_edge) return averaged(field, (longer + longest_edge - 1) / longest_edge);
    if (longer < smallest_edge) return repeated(field, (smallest_edge + longer - 1) / longer);
    return field;
}

}  // namespace skybake
