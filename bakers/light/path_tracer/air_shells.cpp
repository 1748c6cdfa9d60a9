#include "bakers/light/path_tracer/air_shells.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "bakers/air/optical_depth.h"
#include "bakers/light/path_tracer/air_shells-inl.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace kernel = HWY_NAMESPACE;

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
// Tables of levels: 2^5 intervals each time that s + k doubles. Cubics between them are off by at
// most (1 / 32)^4 / 384 times A's fourth derivative, about 24 A / (s + k)^4: 6e-8 A.
std::uint64_t interval_of(double shifted) {
    return std::bit_cast<std::uint64_t>(shifted) >> AirTables::kOffsetBits;
}

double begin_of_interval(std::uint64_t interval) {
    return std::bit_cast<double>(interval << AirTables::kOffsetBits);
}

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

// Returns the least extinction of each channel at three altitudes within; off the ends, where other layers
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
    std::ranges::sort(cuts);
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

double density_of_layer(const SkyLayer& layer, double altitude_km) {
    const Spectrum unit = full_coefficients(layer).extinction_per_km;
    const double* first = data(unit);
    const auto channel =
        static_cast<std::size_t>(std::max_element(first, first + kMaxChannels) - first);
    return extinction_at(layer.alone, altitude_km)[channel] / unit[channel];
}

}  // namespace

AirShells::AirShells(const SkyMedium& medium) {
    tables_.planet = shell_of(medium.air);
    tables_.layers = medium.layers.size();
    const std::vector<double> levels = levels_km(medium.air);
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        add_shell(medium, levels[i], levels[i + 1]);
        // Nothing lies above the last level: any scale serves.
        const double above =
            i + 2 < levels.size() ? levels[i + 2] - levels[i + 1] : levels[i + 1] - levels[i];
        add_level(medium.air, above);
    }
    std::size_t shell = 0;
    for (int i = 0; i < kSlices; ++i) {
        const double altitude = planet().thickness_km * i / kSlices;
        while (shell + 1 < count() && tables_.shells[shell].top_km <= altitude) ++shell;
        tables_.guide.push_back(static_cast<int>(shell));
    }
    for (std::size_t c = 0; c < kMaxChannels; ++c) add_shares(c);
}

void AirShells::add_shell(const SkyMedium& medium, double bottom_km, double top_km) {
    const double ground_radius = planet().ground_radius_km;
    AirTables::AirShell shell;
    shell.bottom_km = bottom_km;
    shell.top_km = top_km;
    shell.top_radius_km = ground_radius + top_km;
    const double half_width = 0.5 * (top_km - bottom_km) * (2 * ground_radius + top_km + bottom_km);
    shell.inverse_half_width = 1 / half_width;
    const Samples nodes = chebyshev_nodes();
    std::array<Spectrum, kSamples> extinction{};
    std::vector<Samples> densities(tables_.layers);
    for (std::size_t i = 0; i < kSamples; ++i) {
        const double q = (nodes[i] - 1) * half_width;
        const double altitude = top_km + gain_of_square_km(shell.top_radius_km, q);
        extinction[i] = extinction_at(medium.air, altitude);
        for (std::size_t k = 0; k < tables_.layers; ++k) {
            densities[k][i] = density_of_layer(medium.layers[k], altitude);
        }
    }
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        Samples values{};
        for (std::size_t i = 0; i < kSamples; ++i) values[i] = extinction[i][c];
        const Samples coefficients = interpolating_polynomial(nodes, values);
        for (std::size_t n = 0; n < kSamples; ++n) shell.extinction[n][c] = coefficients[n];
    }
    for (const Samples& values : densities) {
        AirTables::Polynomial polynomial;
        const Samples coefficients = interpolating_polynomial(nodes, values);
        std::ranges::copy(coefficients, polynomial.coefficients);
        tables_.densities.push_back(polynomial);
    }
    tables_.shells.push_back(shell);
}

void AirShells::add_level(const Medium& air, double thickness_above_km) {
    AirTables::AirShell& shell = tables_.shells.back();
    const double r = shell.top_radius_km;
    const double scale = std::sqrt(2 * r * thickness_above_km);
    shell.scale_km =
        begin_of_interval(interval_of(scale) & ~std::uint64_t{(1 << AirTables::kIntervalBits) - 1});
    shell.first_number = static_cast<double>(tables_.nodes.size() << AirTables::kNodeBits);
    const std::uint64_t first_interval = interval_of(shell.scale_km);
    const std::uint64_t intervals = interval_of(r + shell.scale_km) + 1 - first_interval;
    // Slopes by five points, forwards: their error is (s + k) / 2^9's fourth power.
    constexpr double kForward[5] = {-25, 48, -36, 16, -3};
    std::vector<double> s;
    std::vector<double> steps;
    for (std::uint64_t i = 0; i <= intervals; ++i) {
        const double shifted = begin_of_interval(first_interval + i);
        steps.push_back(shifted * 0x1p-9);
        for (int k = 0; k < 5; ++k) s.push_back(shifted - shell.scale_km + k * steps.back());
    }
    std::vector<double> depths(s.size() * kMaxChannels);
    optical_depth_to_top(air, shell.top_km, s.data(), static_cast<int>(s.size()), depths.data());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        AirTables::Node node;
        for (std::size_t c = 0; c < static_cast<std::size_t>(air.channels); ++c) {
            const double* values = depths.data() + c * s.size() + 5 * i;
            node.value[c] = values[0];
            double sum = 0;
            for (std::size_t k = 0; k < 5; ++k) sum += kForward[k] * values[k];
            node.slope[c] = sum / (12 * steps[i]);
        }
        tables_.nodes.push_back(node);
    }
}

// Vertical depths are shares of the ground's, or without air 0.
void AirShells::add_shares(std::size_t channel) {
    const double radius = planet().ground_radius_km;
    const double whole = depth_to_top({0, radius, 0})[channel];
    std::vector<double> shares = {whole > 0 ? 1.0 : 0.0};
    for (std::size_t i = 0; i < count(); ++i) {
        const double top = tables_.shells[i].top_km;
        const double depth = depth_to_top({top, radius + top, i})[channel];
        shares.push_back(whole > 0 ? depth / whole : 0);
    }
    tables_.vertical_shares.resize(shares.size() * kChannelSlots);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        tables_.vertical_shares[i * kChannelSlots + channel] = shares[i];
    }
    // From thin air to dense air: the lowest shell with no more above it than the step's upper end.
    std::size_t shell = count() - 1;
    for (std::size_t i = 1; i <= AirTables::kShares; ++i) {
        constexpr std::size_t kSteps = std::size_t{1} << AirTables::kShareBits;
        const double power = static_cast<double>(std::uint64_t{1} << (i / kSteps));
        const double share =
            AirTables::kLeastShare * power * (1 + static_cast<double>(i % kSteps) / kSteps);
        while (shell > 0 && shares[shell] <= share) --shell;
        tables_.shell_at_share.push_back(static_cast<double>(shell));
    }
}

std::size_t AirShells::shell_at(double altitude_km) const {
    return kernel::shell_at(tables_, altitude_km);
}

Spectrum AirShells::depth_to_top(const Point& point) const {
    return kernel::depth_to_top(tables_, point.altitude_km, point.s_km, point.shell).spectrum();
}

Spectrum AirShells::sunlight(double altitude_km, double s_km, std::size_t shell) const {
    return kernel::sunlight(tables_, altitude_km, s_km, shell).spectrum();
}

}  // namespace skybake
