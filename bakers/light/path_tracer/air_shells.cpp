#include "bakers/light/path_tracer/air_shells.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "bakers/air/optical_depth.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Four nodes leave share * (w / H)^4 * 1e-6 of a horizontal path through a shell of width w, and
// degree 5 share * (w / H)^6 * 7e-7 of a density with scale height H; share is the layer's of all
// extinction there. With kFinest both are below 8e-8.
constexpr double kFinest = 0.08;
// Below this share of the medium's largest extinction nothing is refined.
constexpr double kNegligible = 1e-9;
// A shell against its radius: r^2 and altitude are almost proportional.
constexpr double kThickest = 1.0 / 16;
constexpr int kSlices = 1024;
// Of a length found from its depth, as a share of it: leaves 1e-7.
constexpr double kLastChange = 3e-4;

// Tables of levels: 2^5 intervals each time that s + k doubles. Cubics between them are off by at
// most (1 / 32)^4 / 384 times A's fourth derivative, about 24 A / (s + k)^4: 6e-8 A.
constexpr int kIntervalBits = 5;
constexpr int kOffsetBits = 52 - kIntervalBits;

std::uint64_t interval_of(double shifted) {
    return std::bit_cast<std::uint64_t>(shifted) >> kOffsetBits;
}

double begin_of_interval(std::uint64_t interval) {
    return std::bit_cast<double>(interval << kOffsetBits);
}

// Where s lies in its interval, in [0, 1).
double share_of_interval(double shifted) {
    constexpr std::uint64_t kOne = std::uint64_t{0x3ff0000000000000};
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(shifted) << (64 - kOffsetBits);
    return std::bit_cast<double>(kOne | (bits >> 12)) - 1;
}

// Length of the interval: the power of two below it over 2^5.
double length_of_interval(double shifted) {
    constexpr std::uint64_t kExponent = std::uint64_t{0x7ff0000000000000};
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(shifted) & kExponent) *
           (1.0 / (1 << kIntervalBits));
}

template <class Real>
Real cubic(Real value, Real slope, Real next_value, Real next_slope, double length, double share) {
    const Real rise = next_value - value;
    const Real from = length * slope;
    const Real to = length * next_slope;
    return value + share * (from + share * ((3.0 * rise - 2.0 * from - to) +
                                            share * (from + to - 2.0 * rise)));
}

// Degree 5, without a loop, which the compiler would keep in memory.
HWY_INLINE Channels polynomial(const Channels* coefficients, const Channels& t) {
    const Channels high = (coefficients[5] * t + coefficients[4]) * t + coefficients[3];
    return ((high * t + coefficients[2]) * t + coefficients[1]) * t + coefficients[0];
}

// Gauss-Legendre on [0, 1].
constexpr int kGaussNodes = 4;
constexpr double kShellNodes[kGaussNodes] = {0.069431844202973712, 0.33000947820757187,
                                             0.66999052179242813, 0.93056815579702629};
constexpr double kWeights[kGaussNodes] = {0.17392742256872693, 0.32607257743127307,
                                          0.32607257743127307, 0.17392742256872693};

constexpr std::size_t kSamples = 6;
using Samples = std::array<double, kSamples>;

// Chebyshev's nodes in (-1, 1), ascending.
Samples chebyshev_nodes() {
    Samples nodes{};
    for (std::size_t i = 0; i < kSamples; ++i) {
        nodes[i] = -cosine_of_pi((2 * static_cast<double>(i) + 1) / (2.0 * kSamples));
    }
    return nodes;
}

// Coefficients of the polynomial through values at those nodes: Newton's divided differences,
// multiplied out.
Samples interpolating_polynomial(const Samples& nodes, Samples values) {
    for (std::size_t order = 1; order < kSamples; ++order) {
        for (std::size_t i = kSamples - 1; i >= order; --i) {
            values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - order]);
        }
    }
    Samples result{};
    for (std::size_t i = kSamples; i-- > 0;) {
        for (std::size_t k = kSamples - 1; k > 0; --k) {
            result[k] = result[k - 1] - nodes[i] * result[k];
        }
        result[0] = values[i] - nodes[i] * result[0];
    }
    return result;
}

// What each channel's extinction is at least, somewhere within; off the ends, where other layers
// may begin.
Spectrum least_extinction(const Medium& air, double bottom_km, double top_km) {
    Spectrum least = extinction_at(air, 0.5 * (bottom_km + top_km));
    for (const double share : {0.125, 0.875}) {
        least = minimum(least, extinction_at(air, bottom_km + share * (top_km - bottom_km)));
    }
    return least;
}

bool is_too_thick(const Medium& air, const Spectrum& largest_extinction, double bottom_km,
                  double top_km) {
    const double width = top_km - bottom_km;
    if (width > kThickest * (air.ground_radius_km + bottom_km)) return true;
    const Spectrum all = least_extinction(air, bottom_km, top_km);
    for (const ExponentialLayer& layer : air.exponential_layers) {
        const double square = width / layer.scale_height_km * (width / layer.scale_height_km);
        const double error = square * square * std::max(1.0, square);
        const double density = exponential(-bottom_km / layer.scale_height_km);
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            const double extinction = layer.extinction_per_km[c] * density;
            const double scale = all[c] + kNegligible * largest_extinction[c];
            if (extinction * error > kFinest * scale) return true;
        }
    }
    return false;
}

// Levels at which the air is cut, ascending from the ground to the top: the edges of layers, and
// halves between them as often as it takes.
std::vector<double> levels_km(const Medium& air) {
    std::vector<double> cuts = kink_altitudes_km(air);
    cuts.push_back(0);
    cuts.push_back(air.thickness_km);
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    Spectrum largest{};
    for (const double altitude : cuts) {
        largest = maximum(largest, extinction_at(air, altitude));
    }
    std::vector<double> levels = {0};
    std::vector<double> ends(cuts.rbegin(), cuts.rend() - 1);  // the next one last
    while (!ends.empty()) {
        const double bottom = levels.back();
        const double middle = 0.5 * (bottom + ends.back());
        const bool divisible = bottom < middle && middle < ends.back();
        if (divisible && is_too_thick(air, largest, bottom, ends.back())) {
            ends.push_back(middle);
        } else {
            levels.push_back(ends.back());
            ends.pop_back();
        }
    }
    return levels;
}

const Spectrum& extinction_at_density_one(const Medium& alone) {
    return alone.exponential_layers.empty() ? alone.piecewise_layers[0].extinction_per_km
                                            : alone.exponential_layers[0].extinction_per_km;
}

double density_of_layer(const Medium& alone, double altitude_km) {
    const Spectrum& unit = extinction_at_density_one(alone);
    const double* first = data(unit);
    const auto channel =
        static_cast<std::size_t>(std::max_element(first, first + kMaxChannels) - first);
    return extinction_at(alone, altitude_km)[channel] / unit[channel];
}

}  // namespace

AirShells::AirShells(const SkyMedium& medium)
    : planet_(shell_of(medium.air)),
      channels_(static_cast<std::size_t>(medium.air.channels)),
      layers_(medium.layers.size()) {
    const std::vector<double> levels = levels_km(medium.air);
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        add_shell(medium, levels[i], levels[i + 1]);
        // Nothing lies above the last level: any scale serves.
        const double above =
            i + 2 < levels.size() ? levels[i + 2] - levels[i + 1] : levels[i + 1] - levels[i];
        add_level(medium.air, shells_.back(), above);
    }
    int shell = 0;
    for (int i = 0; i < kSlices; ++i) {
        const double altitude = planet_.thickness_km * i / kSlices;
        while (shell + 1 < count() && shells_[static_cast<std::size_t>(shell)].top_km <= altitude) {
            ++shell;
        }
        guide_.push_back(shell);
    }
}

void AirShells::add_shell(const SkyMedium& medium, double bottom_km, double top_km) {
    AirShell shell;
    for (Channels& coefficient : shell.extinction) coefficient = Channels(0.0);
    shell.top_km = top_km;
    shell.top_radius_km = planet_.ground_radius_km + top_km;
    const double half_width =
        0.5 * (top_km - bottom_km) * (2 * planet_.ground_radius_km + top_km + bottom_km);
    shell.inverse_half_width = 1 / half_width;
    const Samples nodes = chebyshev_nodes();
    std::array<Spectrum, kSamples> extinction{};
    std::vector<Samples> densities(layers_);
    for (std::size_t i = 0; i < kSamples; ++i) {
        const double q = (nodes[i] - 1) * half_width;
        const double r = shell.top_radius_km;
        const double altitude = top_km + gain_of_square_km(r, q);
        extinction[i] = extinction_at(medium.air, altitude);
        for (std::size_t k = 0; k < layers_; ++k) {
            densities[k][i] = density_of_layer(medium.layers[k].alone, altitude);
        }
    }
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        Samples values{};
        for (std::size_t i = 0; i < kSamples; ++i) values[i] = extinction[i][c];
        const Samples coefficients = interpolating_polynomial(nodes, values);
        for (std::size_t n = 0; n <= kDegree; ++n) shell.extinction[n].set(c, coefficients[n]);
    }
    shell.first_density = densities_.size();
    for (const Samples& values : densities) {
        Polynomial polynomial{};
        const Samples coefficients = interpolating_polynomial(nodes, values);
        std::copy(coefficients.begin(), coefficients.end(), polynomial.coefficients);
        densities_.push_back(polynomial);
    }
    shells_.push_back(shell);
}

void AirShells::add_level(const Medium& air, AirShell& shell, double thickness_above_km) {
    const double r = shell.top_radius_km;
    const double scale = std::sqrt(2 * r * thickness_above_km);
    shell.scale_km =
        begin_of_interval(interval_of(scale) & ~std::uint64_t{(1 << kIntervalBits) - 1});
    shell.first_interval = interval_of(shell.scale_km);
    shell.first_node = nodes_.size();
    const std::uint64_t intervals = interval_of(r + shell.scale_km) + 1 - shell.first_interval;
    // Slopes by five points, forwards: their error is (s + k) / 2^9's fourth power.
    constexpr double kForward[5] = {-25, 48, -36, 16, -3};
    std::vector<double> s;
    std::vector<double> steps;
    for (std::uint64_t i = 0; i <= intervals; ++i) {
        const double shifted = begin_of_interval(shell.first_interval + i);
        steps.push_back(shifted * 0x1p-9);
        for (int k = 0; k < 5; ++k) s.push_back(shifted - shell.scale_km + k * steps.back());
    }
    std::vector<double> depths(s.size() * kMaxChannels);
    optical_depth_to_top(air, shell.top_km, s.data(), static_cast<int>(s.size()), depths.data());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        Node node = {Channels(0.0), Channels(0.0)};
        for (std::size_t c = 0; c < channels_; ++c) {
            const double* values = depths.data() + c * s.size() + 5 * i;
            node.value.set(c, values[0]);
            double sum = 0;
            for (std::size_t k = 0; k < 5; ++k) sum += kForward[k] * values[k];
            node.slope.set(c, sum / (12 * steps[i]));
        }
        nodes_.push_back(node);
    }
}

int AirShells::shell_at(double altitude_km) const {
    const double slice = altitude_km / planet_.thickness_km * kSlices;
    int shell =
        guide_[static_cast<std::size_t>(std::clamp(static_cast<int>(slice), 0, kSlices - 1))];
    // The slice was found with rounding: a level at its beginning may be on either side.
    while (shell > 0 && altitude_km < shells_[static_cast<std::size_t>(shell - 1)].top_km) --shell;
    while (shell + 1 < count() && altitude_km >= shells_[static_cast<std::size_t>(shell)].top_km) {
        ++shell;
    }
    return shell;
}

// t of a shell at an altitude.
double AirShells::position(const AirShell& shell, double altitude_km) const {
    const double drop = altitude_km - shell.top_km;
    return 1 + drop * (2 * shell.top_radius_km + drop) * shell.inverse_half_width;
}

Channels AirShells::extinction(int shell, double altitude_km) const {
    const AirShell& air = shells_[static_cast<std::size_t>(shell)];
    const Channels t(position(air, altitude_km));
    return polynomial(air.extinction, t);
}

double AirShells::density(int shell, int layer, double altitude_km) const {
    const AirShell& air = shells_[static_cast<std::size_t>(shell)];
    const double t = position(air, altitude_km);
    const Polynomial& polynomial = densities_[air.first_density + static_cast<std::size_t>(layer)];
    double value = 0;
    for (std::size_t n = kDegree + 1; n-- > 0;) value = value * t + polynomial.coefficients[n];
    return value;
}

double AirShells::level_depth(const AirShell& shell, double s_km, std::size_t channel) const {
    const double shifted = s_km + shell.scale_km;
    const Node* node = nodes_.data() + shell.first_node +
                       static_cast<std::size_t>(interval_of(shifted) - shell.first_interval);
    return cubic(node[0].value[channel], node[0].slope[channel], node[1].value[channel],
                 node[1].slope[channel], length_of_interval(shifted), share_of_interval(shifted));
}

// Depth of `length_km` of a line below a shell's top, where it is at s_top_km.
double AirShells::shell_depth(const AirShell& shell, double s_top_km, double length_km,
                              std::size_t channel) const {
    double sum = 0;
    for (int i = 0; i < kGaussNodes; ++i) {
        const double y = length_km * kShellNodes[i];
        const double t = 1 + y * (y - 2 * s_top_km) * shell.inverse_half_width;
        double value = shell.extinction[kDegree][channel];
        for (std::size_t n = kDegree; n-- > 0;) value = value * t + shell.extinction[n][channel];
        sum += kWeights[i] * value;
    }
    return length_km * sum;
}

Channels AirShells::depth_to_top(const Point& point) const {
    const AirShell& shell = shells_[static_cast<std::size_t>(point.shell)];
    const double gain = shell.top_km - point.altitude_km;
    const double q = gain * (2 * (planet_.ground_radius_km + point.altitude_km) + gain);
    const double s_top = std::sqrt(std::max(point.s_km * point.s_km + q, 0.0));
    const double sum_of_s = s_top + point.s_km;
    const double length = sum_of_s > 0 ? std::max(q, 0.0) / sum_of_s : 0;
    Channels within(0.0);
    for (int i = 0; i < kGaussNodes; ++i) {
        const double y = length * kShellNodes[i];
        const Channels t(1 + y * (y - 2 * s_top) * shell.inverse_half_width);
        within = within + kWeights[i] * polynomial(shell.extinction, t);
    }
    const double shifted = s_top + shell.scale_km;
    const Node* node = nodes_.data() + shell.first_node +
                       static_cast<std::size_t>(interval_of(shifted) - shell.first_interval);
    return length * within + cubic(node[0].value, node[0].slope, node[1].value, node[1].slope,
                                   length_of_interval(shifted), share_of_interval(shifted));
}

// The length below a shell's top, where the line is at s_top_km, that has a depth: Newton's method
// within a bracket. The depth is a rising function with the extinction for its slope.
double AirShells::length_at_depth(const AirShell& shell, double s_top_km, double longest_km,
                                  std::size_t channel, double depth) const {
    double low = 0;
    double high = longest_km;
    double length = std::min(longest_km, depth / shell.extinction[0][channel]);
    if (!(length >= 0)) length = 0;  // no extinction in this shell
    for (int i = 0; i < 64; ++i) {
        const double error = shell_depth(shell, s_top_km, length, channel) - depth;
        (error > 0 ? high : low) = length;
        const double t = 1 + length * (length - 2 * s_top_km) * shell.inverse_half_width;
        double slope = shell.extinction[kDegree][channel];
        for (std::size_t n = kDegree; n-- > 0;) slope = slope * t + shell.extinction[n][channel];
        double next = length - error / slope;
        // Newton's steps end within rounding of either bracket where that is the answer.
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const double change = std::fabs(next - length);
        length = next;
        // Convergence is quadratic: what is left is about the square of the last change.
        if (change <= kLastChange * length) break;
    }
    return length;
}

AirShells::Point AirShells::point_at_depth(const Point& on_line, std::size_t channel, double depth,
                                           int lowest, int highest) const {
    const auto square_of_s = [&](double altitude_km) {
        const double gain = altitude_km - on_line.altitude_km;
        return on_line.s_km * on_line.s_km + square_gain_km2(planet_, on_line.altitude_km, gain);
    };
    // The lowest shell whose upper level has no more depth above it than asked for.
    while (lowest < highest) {
        const int middle = (lowest + highest) / 2;
        const AirShell& shell = shells_[static_cast<std::size_t>(middle)];
        const double square = square_of_s(shell.top_km);
        if (square >= 0 && level_depth(shell, std::sqrt(square), channel) <= depth) {
            highest = middle;
        } else {
            lowest = middle + 1;
        }
    }
    const AirShell& shell = shells_[static_cast<std::size_t>(lowest)];
    const double s_top = std::sqrt(std::max(square_of_s(shell.top_km), 0.0));
    const double bottom = lowest > 0 ? shells_[static_cast<std::size_t>(lowest - 1)].top_km : 0.0;
    const double longest = s_top - std::sqrt(std::max(square_of_s(bottom), 0.0));
    const double within = std::max(depth - level_depth(shell, s_top, channel), 0.0);
    const double length = length_at_depth(shell, s_top, longest, channel, within);
    const double q = length * (length - 2 * s_top);
    const double r = shell.top_radius_km;
    Point point;
    point.altitude_km = std::clamp(shell.top_km + gain_of_square_km(r, q), bottom, shell.top_km);
    point.s_km = s_top - length;
    point.shell = lowest;
    return point;
}

Channels AirShells::sunlight(double altitude_km, double s_km, int shell) const {
    if (s_km >= 0) return exponential(-depth_to_top({altitude_km, s_km, shell}));
    if (s_km < -horizon_distance_km(planet_, altitude_km)) return Channels(0.0);
    const double drop = drop_to_nearest_km(planet_, altitude_km, s_km);
    const double nearest = std::max(altitude_km - drop, 0.0);  // rounding
    const Channels below = depth_to_top({nearest, 0, shell_at(nearest)});
    return exponential(depth_to_top({altitude_km, -s_km, shell}) - 2.0 * below);
}

}  // namespace skybake
