#include "bakers/clouds/dome_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "bakers/clouds/tower_life.h"
#include "bakers/clouds/unit_numbers.h"
#include "bakers/math/transcendental.h"

namespace skybake::cloud {

namespace {

using config::DomeShape;
using std::numbers::pi;

// How far a dome reaches from its axis, at most.
double reach_of(const Dome& dome) { return std::max(dome.radii[0], dome.radii[1]); }

std::array<double, 2> direction_of(double turns) {
    return {cosine_of_turns(turns), cosine_of_turns(turns - 0.25)};
}

// Middles of lobes lie this share of the way from the middle of the dome's widest place to a point of
// its upper surface: within what noise leaves of the dome, so that lobes do not come off.
constexpr double kLobeReach = 0.65;

// `swelling` is the radius of lobes over that of lobes of a grown dome of this width.
Dome lobe_of(const Dome& dome, const DomeShape& shape, double swelling, UnitNumbers& numbers) {
    // Points (s, u, v) of a half ball have uniform heights.
    const double s = numbers.next();
    const std::array<double, 2> around = direction_of(numbers.next());
    const double across = kLobeReach * std::sqrt(1 - s * s);
    const double u = across * dome.radii[0] * around[0];
    const double v = across * dome.radii[1] * around[1];
    const double t = dome.widest + kLobeReach * s * (1 - dome.widest);
    const auto [c, n] = dome.direction;
    const double radius = between(shape.lobe_size, numbers.next()) *
                          std::min(dome.radii[0], dome.radii[1]) * swelling;
    const double rise = t * dome.height;
    Dome lobe;
    lobe.foot = {dome.foot[0] + dome.lean[0] * rise + c * u - n * v,
                 dome.foot[1] + dome.lean[1] * rise + n * u + c * v, dome.foot[2] + rise - radius};
    lobe.radii = {radius, radius};
    lobe.direction = {1, 0};
    lobe.height = 2 * radius;
    lobe.widest = 0.5;
    lobe.amplitude = dome.amplitude;
    return lobe;
}

// Adds the dome as it is in `state`, followed by its lobes, or nothing if it does not live.
void add_with_lobes(Dome dome, const DomeShape& shape, const TowerState& state,
                    const std::array<double, 3>& extent_m, UnitNumbers& numbers,
                    std::vector<Dome>& domes) {
    dome.amplitude *= state.amplitude;
    if (dome.amplitude == 0) return;
    dome.height *= state.height;
    for (std::size_t i = 0; i < 2; ++i) {
        dome.radii[i] *= state.width;
        dome.foot[i] += state.moved[i] * extent_m[i];
        dome.lean[i] += state.leaned[i];
    }
    domes.push_back(dome);
    // Lobes of a dome that is still flat would reach out of it.
    const double swelling = std::min(1.0, state.height / state.width);
    for (int i = 0; i < shape.lobes; ++i) domes.push_back(lobe_of(dome, shape, swelling, numbers));
}

std::array<double, 3> extent_m_of(const config::Cloud& cloud) {
    return {cloud.extent[0].meters, cloud.extent[1].meters, cloud.extent[2].meters};
}

Dome shaped(const DomeShape& shape) {
    Dome dome;
    dome.widest = shape.widest;
    dome.lean = shape.lean;
    return dome;
}

Dome listed_dome(const config::Tower& tower) {
    Dome dome = shaped(tower);
    for (std::size_t i = 0; i < 3; ++i) dome.foot[i] = tower.foot[i].meters;
    dome.radii = {tower.size[0].meters / 2, tower.size[1].meters / 2};
    dome.height = tower.size[2].meters;
    dome.direction = direction_of(tower.rotation.radians / (2 * pi));
    dome.amplitude = tower.amplitude;
    return dome;
}

Dome scattered_dome(const config::TowerScatter& scatter, const config::Cloud& cloud,
                    UnitNumbers& numbers) {
    Dome dome = shaped(scatter);
    for (std::size_t i = 0; i < 2; ++i) dome.foot[i] = cloud.extent[i].meters * numbers.next();
    const double width =
        between_logarithms({scatter.width[0].meters, scatter.width[1].meters}, numbers.next());
    dome.radii = {width / 2, width / 2 * between(scatter.aspect, numbers.next())};
    dome.height = width * between(scatter.slenderness, numbers.next());
    dome.direction = direction_of(numbers.next() / 2);
    dome.amplitude = between(scatter.amplitude, numbers.next());
    return dome;
}

}  // namespace

std::vector<Dome> domes_of(const config::Cloud& cloud) {
    const std::array<double, 3> extent_m = extent_m_of(cloud);
    std::vector<Dome> domes;
    for (const config::Tower& tower : cloud.towers) {
        if (tower.shape != config::TowerShape::dome) continue;
        UnitNumbers numbers(tower.seed, 0);
        const TowerState state = tower_state(tower, tower.born, cloud);
        add_with_lobes(listed_dome(tower), tower, state, extent_m, numbers, domes);
    }
    const config::TowerScatter& scatter = cloud.scatter;
    if (scatter.shape != config::TowerShape::dome) return domes;
    for (int i = 0; i < scatter.count; ++i) {
        UnitNumbers numbers(scatter.seed, static_cast<std::uint64_t>(i));
        const Dome dome = scattered_dome(scatter, cloud, numbers);
        const TowerState state = tower_state(scatter, scattered_birth(scatter, i), cloud);
        add_with_lobes(dome, scatter, state, extent_m, numbers, domes);
    }
    return domes;
}

DomeField::DomeField(std::span<const Dome> domes, const std::array<double, 3>& extent_m)
    : extent_m_(extent_m) {
    for (const Dome& dome : domes) {
        if (dome.amplitude == 0) continue;
        // Image n of an axis reaches from low + n extent to high + n extent.
        std::array<double, 2> first{};
        std::array<double, 2> last{};
        for (std::size_t i = 0; i < 2; ++i) {
            const double shift = dome.lean[i] * dome.height;
            const double low = dome.foot[i] + std::min(shift, 0.0) - reach_of(dome);
            const double high = dome.foot[i] + std::max(shift, 0.0) + reach_of(dome);
            first[i] = std::floor(-high / extent_m[i]);
            last[i] = std::ceil((extent_m[i] - low) / extent_m[i]);
        }
        for (double j = first[1]; j <= last[1]; ++j) {
            for (double i = first[0]; i <= last[0]; ++i) {
                Dome image = dome;
                image.foot[0] += i * extent_m[0];
                image.foot[1] += j * extent_m[1];
                images_.push_back(image);
            }
        }
    }
}

std::vector<Dome> DomeField::near(const DomeRange& range) const {
    std::vector<Dome> domes;
    for (const Dome& dome : images_) {
        const double shift = dome.lean[1] * dome.height;
        const double low = dome.foot[1] + std::min(shift, 0.0) - reach_of(dome);
        const double high = dome.foot[1] + std::max(shift, 0.0) + reach_of(dome);
        const bool reaches = low <= range.y[1] && high >= range.y[0] &&
                             dome.foot[2] <= range.z[1] && dome.foot[2] + dome.height >= range.z[0];
        if (reaches) domes.push_back(dome);
    }
    return domes;
}

void raise_row(std::span<const Dome> domes, double y, double z, std::span<const double> x,
               double* values) {
    assert(std::is_sorted(x.begin(), x.end()));
    for (const Dome& dome : domes) {
        const double rise = z - dome.foot[2];
        const double t = rise / dome.height;
        if (!(t >= 0 && t <= 1)) continue;
        const double from = t < dome.widest ? dome.widest : 1 - dome.widest;
        const double s = t == dome.widest ? 0 : (t - dome.widest) / from;
        const double left = 1 - s * s;
        const double dy = y - (dome.foot[1] + dome.lean[1] * rise);
        // Beyond the greater radius the dome adds nothing; twice 1e-9 of it is room for rounding.
        const double reach = reach_of(dome) * (1 + 2e-9);
        if (!(std::fabs(dy) <= reach)) continue;
        const double axis = dome.foot[0] + dome.lean[0] * rise;
        const auto [c, n] = dome.direction;
        const auto first = std::lower_bound(x.begin(), x.end(), axis - reach);
        for (auto at = first; at != x.end() && *at <= axis + reach; ++at) {
            const double dx = *at - axis;
            const double u = (c * dx + n * dy) / dome.radii[0];
            const double v = (c * dy - n * dx) / dome.radii[1];
            double& value = values[at - x.begin()];
            value = std::max(value, dome.amplitude * (left - u * u - v * v));
        }
    }
}

}  // namespace skybake::cloud
