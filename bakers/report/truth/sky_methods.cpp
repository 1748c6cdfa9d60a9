#include "bakers/report/truth/sky_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "bakers/field/image.h"
#include "bakers/field/interpolation.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/light/strip_orders.h"
#include "bakers/report/truth/bruneton_sky.h"
#include "config/assets/multiple_scattering.h"

namespace skybake {

namespace {

using config::MultipleScatteringMapping;
using config::MultipleScatteringMethod;

// The quadrature level, from 0, that the default `max_texel_error` chooses on Earth
// (tests/benchmarks/README.md): level 9 of those counted from 1.
constexpr int kLevel = 8;
constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;

struct TableShape {
    MultipleScatteringMapping mapping;
    std::array<int, 2> size;
};
constexpr TableShape kClassic = {MultipleScatteringMapping::hillaire, {32, 32}};
constexpr TableShape kTwilight = {MultipleScatteringMapping::twilight, {64, 32}};

bool is_twilight(const TableShape& shape) {
    return shape.mapping == MultipleScatteringMapping::twilight;
}

std::string key_of(const char* stem, const TableShape& shape) {
    return fmt::format("{}_{}x{}{}", stem, shape.size[0], shape.size[1],
                       is_twilight(shape) ? "_twilight" : "");
}

std::string name_of(const TableShape& shape) {
    return fmt::format("{}x{} {}", shape.size[0], shape.size[1],
                       is_twilight(shape) ? "twilight" : "hillaire");
}

// Returns the higher orders of a runtime that has this table.
std::unique_ptr<HigherOrders> orders_of_table(const Medium& medium, const TableShape& shape,
                                              const Image2<double>& texels) {
    RangeCounts range;
    auto table = std::make_shared<const Image2<float>>(
        store_texels(texels, config::PixelType::float32, range));
    const double thickness_km = medium.thickness_km;
    return std::make_unique<IsotropicOrders>(medium, [table, thickness_km, mapping = shape.mapping](
                                                         double altitude_km,
                                                         double sun_cos_zenith) {
        Spectrum psi{};
        bilinear(
            *table,
            texture_coordinate(kConvention, sun_coordinate(mapping, sun_cos_zenith), table->width),
            texture_coordinate(kConvention, altitude_km / thickness_km, table->height), data(psi));
        return psi;
    });
}

std::unique_ptr<HigherOrders> closure(const Medium& medium, const TableShape& shape,
                                      MultipleScatteringMethod method) {
    config::MultipleScatteringBake bake;
    bake.method = method;
    bake.mapping = shape.mapping;
    const TableModel model = multiple_scattering_model(medium, bake, 1);
    const int level = method == MultipleScatteringMethod::converged ? kLevel : 0;
    return orders_of_table(medium, shape,
                           bake_texels(model, level, shape.size, BakeOptions{.threads = 1}));
}

SolvedLight solved(const SkyMedium& medium, int degree) {
    SolverSettings settings;
    settings.degree = degree;
    return solve_light(medium, settings, 1);
}

std::unique_ptr<HigherOrders> mean_radiance(const SkyMedium& medium, const TableShape& shape) {
    const SolvedLight light = solved(medium, SolverSettings().degree);
    const auto [columns, rows] = shape.size;
    Image2<double> texels(columns, rows, medium.air.channels);
    double* texel = texels.texels.data();
    for (int y = 0; y < rows; ++y) {
        const double altitude_km = texel_coordinate(kConvention, y, rows) * medium.air.thickness_km;
        for (int x = 0; x < columns; ++x) {
            const double cosine =
                sun_cos_zenith_at(shape.mapping, texel_coordinate(kConvention, x, columns));
            const Spectrum mean = light.mean_radiance_at(altitude_km, cosine);
            texel = std::copy_n(data(mean), texels.channels, texel);
        }
    }
    return orders_of_table(medium.air, shape, texels);
}

// Higher orders that are looked up in the solution itself, which this class owns.
class SolutionItself : public HigherOrders {
  public:
    SolutionItself(const SkyMedium& medium, int degree)
        : light_(solved(medium, degree)), orders_(medium, light_, degree) {}

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override {
        return orders_.scattered(point, scattering_per_km);
    }
    Spectrum sky_irradiance(double sun_cos_zenith) const override {
        return orders_.sky_irradiance(sun_cos_zenith);
    }

  private:
    SolvedLight light_;
    SolvedOrders orders_;
};

}  // namespace

std::vector<SkyMethod> sky_methods(const SkyMedium& medium, bool quick) {
    std::vector<TableShape> shapes = {kClassic};
    if (!quick) shapes.push_back(kTwilight);
    std::vector<SkyMethod> methods;
    methods.push_back({"single", "single scattering", "alone", "", nullptr, {}});
    methods.push_back({"strips", "eight strips", "second order", "after Ai et al. 2014", [&medium] {
                           return std::make_unique<StripOrders>(medium, BakeOptions{.threads = 1});
                       }});
    methods.push_back({key_of("as_in_paper", kClassic), "as in the paper", name_of(kClassic),
                       "Hillaire 2020 (64 directions, 20 steps)", [&medium] {
                           return closure(medium.air, kClassic,
                                          MultipleScatteringMethod::as_in_paper);
                       }});
    for (const TableShape& shape : shapes) {
        methods.push_back({key_of("converged", shape), "Hillaire, converged", name_of(shape), "",
                           [&medium, shape] {
                               return closure(medium.air, shape,
                                              MultipleScatteringMethod::converged);
                           }});
    }
    for (const TableShape& shape : shapes) {
        methods.push_back({key_of("mean_radiance", shape), "mean radiance, solved", name_of(shape),
                           "", [&medium, shape] { return mean_radiance(medium, shape); }});
    }
    // Quick reports leave out Bruneton's tables, which take longer than all other methods together,
    // and which hold one or three wavelengths.
    const bool has_bruneton = !quick && (medium.air.channels == 1 || medium.air.channels == 3);
    const std::vector<bool> bruneton =
        has_bruneton ? std::vector{false, true} : std::vector<bool>();
    for (const bool combined : bruneton) {
        const char* kind = combined ? "combined" : "separate";
        methods.push_back({fmt::format("bruneton_{}", kind), "Bruneton's tables", kind, "", nullptr,
                           [&medium, combined] { return bruneton_sky(medium, {}, combined); }});
    }
    std::vector<int> degrees = {2, 4, 8};
    // In haze and fog, assets of the sky have moments of a higher degree.
    if (const int most = sky_degree(medium); most > degrees.back()) degrees.push_back(most);
    for (const int degree : degrees) {
        methods.push_back(
            {fmt::format("moments_{}", degree), "moments, solved", fmt::format("degree {}", degree),
             "", [&medium, degree] { return std::make_unique<SolutionItself>(medium, degree); }});
    }
    return methods;
}

}  // namespace skybake
