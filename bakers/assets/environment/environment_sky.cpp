#include "bakers/assets/environment/environment_sky.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bakers/light/wide_row.h"
#include "bakers/math/parallel.h"

namespace skybake {

namespace {

constexpr int kAzimuths = 385;
constexpr int kRowsAbove = 385;
constexpr int kRowsBelow = 97;

// The four nodes around a place on an axis of `count` nodes, and their weights: Lagrange's cubic.
struct Cubic {
    int first = 0;
    std::array<double, 4> weights{};
};

Cubic cubic_at(double position, int count) {
    Cubic cubic;
    cubic.first = std::clamp(static_cast<int>(position) - 1, 0, count - 4);
    const double t = position - cubic.first;
    const double a = t, b = t - 1, c = t - 2, d = t - 3;
    cubic.weights = {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};
    return cubic;
}

// Row 0 is as near to the horizon as rounding allows, on its side of it.
Image2<double> half_sphere(const TableModel& sky, const SkyViewCamera& camera, bool above, int rows,
                           const BakeOptions& options) {
    Image2<double> half(kAzimuths, rows, sky.channels);
    std::vector<double> azimuths;
    for (int i = 0; i < kAzimuths; ++i) {
        azimuths.push_back(static_cast<double>(i) / (kAzimuths - 1));
    }
    for_each_tile(rows, options, "the sky around", [&](int row) {
        const double share = 0.5 * row / (rows - 1);
        const double y = above ? 0.5 + share : std::min(0.5 - share, std::nextafter(0.5, 0));
        sky.row(0, camera.off_the_edges(y), azimuths, half.texel(0, row));
    });
    return half;
}

}  // namespace

double turn_from_sun(double half_turns) {
    const double turn = std::fabs(half_turns);
    return turn > 1 ? 2 - turn : turn;
}

bool sees_air(const SkyViewCamera& camera, double above_horizon) {
    return !camera.in_space() || above_horizon <= camera.range_above();
}

SkyAround::SkyAround(const TableModel& sky, const SkyViewCamera& camera, const BakeOptions& options)
    : camera_(camera),
      lowest_(sky.lowest),
      above_(half_sphere(sky, camera, true, kRowsAbove, options)),
      below_(half_sphere(sky, camera, false, kRowsBelow, options)) {}

void SkyAround::at(double elevation, double half_turns, double* values) const {
    const double angle = elevation + camera_.dip();
    const Image2<double>& half = angle < 0 ? below_ : above_;
    const int channels = half.channels;
    std::fill_n(values, channels, 0.0);
    if (!sees_air(camera_, angle)) return;
    const double y = camera_.coordinate(angle);
    const double row = std::min(std::fabs(2 * y - 1), 1.0) * (half.height - 1);
    const Cubic rows = cubic_at(row, half.height);
    const Cubic columns = cubic_at(turn_from_sun(half_turns) * (kAzimuths - 1), kAzimuths);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            const double weight = rows.weights[static_cast<std::size_t>(j)] *
                                  columns.weights[static_cast<std::size_t>(i)];
            const double* texel = half.texel(columns.first + i, rows.first + j);
            for (int c = 0; c < channels; ++c) values[c] += weight * texel[c];
        }
    }
    // Cubics overshoot next to the planet's shadow.
    for (int c = 0; c < channels; ++c) values[c] = std::max(values[c], lowest_);
}

TableModel wide_sky_model(const SkyLight& light, const SkyViewCamera& camera, const SunZenith& sun,
                          SeenGround ground) {
    TableModel model = sky_view_model(light, camera, sun, ground);
    model.row = [&light, &camera, sun, ground](int, double y, const std::vector<double>& x,
                                               double* values) {
        const RowOfView view(camera, y, sun);
        const auto row_of = [&](const SkyLight& any) {
            const SkyRow row(any.integrator(), any.medium(), any.higher_orders(), view.ray(1),
                             &any.sunlight());
            return wide_radiance(row, any.medium(), view, x);
        };
        write_wanted(light, ground, with_once(light, row_of), values);
    };
    return model;
}

}  // namespace skybake
