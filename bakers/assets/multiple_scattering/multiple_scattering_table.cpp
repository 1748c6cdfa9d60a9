#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/field/finish_table.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/math/relative_error.h"

namespace skybake {

using config::MultipleScatteringBake;
using config::MultipleScatteringMapping;
using config::MultipleScatteringMethod;

namespace {

// Nodes of the reference: more than, and other ones than, any level of the baker has.
constexpr QuadratureLevel kReferenceLevel = {44, 1e-4, 5e-6};
constexpr TransmittanceField::Size kReferenceField = {512, 192};

// Sunlight for the baker's levels: the last two are limited by it in dense air.
constexpr TransmittanceField::Size kField = {256, 128};
constexpr TransmittanceField::Size kFineField = {384, 128};
constexpr int kFirstFineLevel = 9;

// Psi over rows of suns, with the sunlight that all rows share.
class Integrator {
  public:
    Integrator(const Medium& medium, TransmittanceField::Size field, int threads)
        : medium_(medium),
          altitudes_km_(quadrature_altitudes_km(medium)),
          sunlight_(medium, altitudes_km_, field, threads) {}

    // Channels interleaved in values.
    void row(const QuadratureLevel& level, double altitude_km,
             const std::vector<double>& sun_cos_zenith, double* values) const {
        const RowQuadrature quadrature =
            make_row_quadrature(medium_, altitudes_km_, altitude_km, level);
        const auto channels = static_cast<std::size_t>(medium_.channels);
        std::vector<double> psi(sun_cos_zenith.size() * channels);
        integrate_row(medium_, sunlight_, quadrature, sun_cos_zenith.data(),
                      static_cast<int>(sun_cos_zenith.size()), psi.data());
        for (std::size_t i = 0; i < sun_cos_zenith.size(); ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                values[i * channels + c] = psi[c * sun_cos_zenith.size() + i];
            }
        }
    }

  private:
    const Medium& medium_;
    std::vector<double> altitudes_km_;
    Sunlight sunlight_;
};

// Made when first asked for: not every bake needs every one.
class LazyIntegrator {
  public:
    LazyIntegrator(const Medium& medium, TransmittanceField::Size field, int threads)
        : medium_(medium), field_(field), threads_(threads) {}

    const Integrator& get() {
        std::call_once(made_, [this] { integrator_.emplace(medium_, field_, threads_); });
        return *integrator_;
    }

  private:
    const Medium& medium_;
    TransmittanceField::Size field_;
    int threads_;
    std::once_flag made_;
    std::optional<Integrator> integrator_;
};

std::vector<double> suns_at(MultipleScatteringMapping mapping, const std::vector<double>& x) {
    std::vector<double> suns;
    for (const double coordinate : x) suns.push_back(sun_cos_zenith_at(mapping, coordinate));
    return suns;
}

}  // namespace

TableModel multiple_scattering_model(const Medium& medium, const MultipleScatteringBake& bake,
                                     int threads) {
    TableModel model;
    model.channels = medium.channels;
    model.lowest = 0;
    model.highest = std::numeric_limits<double>::max();
    model.convention = TexelConvention::end_points_on_texel_centres;
    const MultipleScatteringMapping mapping = bake.mapping;
    const double thickness_km = medium.thickness_km;
    for (const QuadratureLevel& level : quadrature_levels()) {
        model.cost_per_texel.push_back(lookups_per_texel(level));
    }
    model.row = [mapping, thickness_km,
                 coarse = std::make_shared<LazyIntegrator>(medium, kField, threads),
                 fine = std::make_shared<LazyIntegrator>(medium, kFineField, threads)](
                    int level, double y, const std::vector<double>& x, double* values) {
        const Integrator& integrator = (level < kFirstFineLevel ? coarse : fine)->get();
        integrator.row(quadrature_levels()[static_cast<std::size_t>(level)], y * thickness_km,
                       suns_at(mapping, x), values);
    };
    model.reference = [mapping, thickness_km,
                       reference =
                           std::make_shared<LazyIntegrator>(medium, kReferenceField, threads)](
                          double y, const std::vector<double>& x, double* values) {
        reference->get().row(kReferenceLevel, y * thickness_km, suns_at(mapping, x), values);
    };
    model.error = relative_error;
    return model;
}

Outcome<Baked> bake_multiple_scattering(const Medium& medium, const MultipleScatteringBake& bake,
                                        const BakeOptions& options, Baked table) {
    const double thickness_km = medium.thickness_km;
    const MultipleScatteringMapping mapping = bake.mapping;
    const bool twilight = mapping == MultipleScatteringMapping::twilight;
    table.kind = "multiple_scattering";
    table.content =
        "Psi (1/sr): radiance of light scattered twice or more, per unit of solar irradiance and "
        "of scattering coefficient; multiply by sigma_s alone";
    describe_sun_table(mapping, "x = altitude / (R_top - R_ground)", shell_of(medium), table);
    table.conventions.radiance_unit = "1/sr";
    set_files(bake, table);
    table.certificate.reference =
        "the same integral with 44 zenith nodes a part and 512 columns of sunlight";
    table.details.emplace_back("method", "converged");

    AccuracyRequest request;
    request.size = bake.size;
    request.max_error = bake.max_error;
    request.max_texel_error = bake.max_texel_error;
    request.choice = {32, 16};
    request.quick = {8, 8};
    request.full = {1024, 16};
    request.quick_search = {16, 64, 4, 4, 64};
    request.full_search = {256, 256, 32, 16, 16384};
    const auto place_of = [mapping, thickness_km](double x, double y) {
        return Place{{"altitude_km", y * thickness_km},
                     {"sun_cos_zenith", sun_cos_zenith_at(mapping, x)}};
    };
    const TableModel model = multiple_scattering_model(medium, bake, options.threads);
    Outcome<Baked> outcome = finish_table(model, request, options, place_of, std::move(table));
    // Where the terminator falls between texels no count of nodes helps, another mapping does.
    if (outcome.value && !twilight && outcome.value->image().width >= 8 &&
        outcome.value->certificate.lookup.max > 0.1) {
        outcome.value->certificate.advice =
            "mapping = \"twilight\" puts more texels near sunrise and sunset";
    }
    return outcome;
}

}  // namespace skybake
