#include "bakers/plot/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace

Colour sequential_colour(double t) {
    Colour colour{};
    for (std::size_t i = 0; i < colour.size(); ++i) {
        // The polynomials leave [0, 1] by a few thousandths.
        const double value = std::clamp(at(viridis[i], t), 0.0, 1.0);
        colour[i] = static_cast<std::uint8_t>(std::lround(255 * value));
    }
    return colour;
}

Colour diverging_colour(double t) {
    const double place = t * (diverging_stops.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(place), diverging_stops.size() - 2);
    return mixed(diverging_stops[stop], diverging_stops[stop + 1],
                 place - static_cast<double>(stop));
}

}  // namespace skybake
