#include "bakers/assets/forward_scattering/forward_table.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/phase/phase_fit.h"
#include "bakers/field/finish_table.h"
#include "bakers/math/transcendental.h"
#include "config/sections/cloud.h"

namespace skybake::forward_scattering {

using config::ForwardScatteringBake;

namespace {

double degrees_of(const ScatteringAngle& angle) { return radians(angle) * 180 / std::numbers::pi; }

void describe(const ForwardScatteringBake& bake, const SmallAngles& light, Baked& table) {
    const std::string convention = "end points on texel centres";
    table.kind = "forward_scattering";
    const bool ice = bake.particles == config::CloudParticles::ice;
    table.content = std::string("factor of the sunlight that ") +
                    (ice ? "ice crystals" : "droplets") +
                    " scatter once, phase function times exp(-s optical depth) / s "
                    "with s = extinction_share, which makes it all light that goes on by small "
                    "angles (dimensionless)";
    table.mapping = "small_angles";
    table.axes.resize(2);
    table.axes[0] = {"scattering_angle_deg", "x = sqrt(sin(angle / 2))", convention, 0, 180};
    table.axes[1] = {"optical_depth",
                     "y = depth / (depth + middle_depth) (1 + middle_depth / deepest)", convention,
                     0, kDeepest};
    table.axes[1].constants = {{"middle_depth", kMiddleDepth}, {"deepest", kDeepest}};
    table.conventions.angle_unit = "deg";
    table.certificate.reference =
        "the series of Legendre polynomials, summed by Clenshaw's recurrence";
    table.certificate.scale = "the sunlight that is scattered once";
    table.details.emplace_back("extinction_share", light.extinction_share());
    set_files(bake, table);
}

}  // namespace

ScatteringAngle angle_at(double x) {
    const double one_minus = 2 * (x * x) * (x * x);
    return {one_minus, 2 - one_minus};
}

double angle_coordinate(double degrees) {
    return std::sqrt(std::fmax(0.0, cosine_of_pi(0.5 - degrees / 360)));
}

SmallAngles small_angles_of(const ForwardScatteringBake& bake) {
    const CloudPhase phase = cloud_phase(bake.particles, bake.droplet_diameter.meters * 1e6);
    return {cloud_light::scattering_of(phase, bake.single_scattering_albedo), bake.degree};
}

TableModel forward_model(const SmallAngles& light) {
    TableModel model;
    model.channels = 1;
    model.convention = TexelConvention::end_points_on_texel_centres;
    model.cost_per_texel = {static_cast<double>(light.terms())};
    model.lowest = std::numeric_limits<double>::lowest();
    model.highest = std::numeric_limits<double>::max();
    model.row = [&light](int, double y, const std::vector<double>& x, double* values) {
        std::vector<ScatteringAngle> angles;
        for (const double coordinate : x) angles.push_back(angle_at(coordinate));
        light.factors(depth_at(y), angles, values);
    };
    model.reference = [&light](double y, const std::vector<double>& x, double* values) {
        for (const double coordinate : x) {
            *values++ = light.reference(depth_at(y), angle_at(coordinate));
        }
    };
    model.error = [](double value, double reference, double) { return value - reference; };
    return model;
}

Outcome<Baked> bake_forward_scattering(const ForwardScatteringBake& bake,
                                       const BakeOptions& options, Baked table) {
    const SmallAngles light = small_angles_of(bake);
    describe(bake, light, table);
    AccuracyRequest request;
    request.size = bake.size;
    request.max_error = bake.max_error;
    request.choice = {32, 32};
    request.quick = {32, 32};
    request.full = {128, 128};
    // Rows, points in each, peak rows, climbs, and points of the reference.
    request.quick_search = {32, 48, 8, 8, 256};
    request.full_search = {128, 128, 32, 32, 2048};
    const auto place_of = [](double x, double y) {
        return Place{{"scattering_angle_deg", degrees_of(angle_at(x))},
                     {"optical_depth", depth_at(y)}};
    };
    return finish_table(forward_model(light), request, options, place_of, std::move(table));
}

}  // namespace skybake::forward_scattering
