#include "bakers/field/baked.h"
#include "bakers/report/sweeps/table_sweeps.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "bakers/assets/phase/phase_fit.h"
#include "bakers/assets/phase/phase_table.h"
#include "config/assets/phase.h"

namespace skybake {

using config::PhaseBake;
using config::PhaseContent;
using config::PhaseSpacing;
using config::PixelType;
using Model = std::shared_ptr<const TableModel>;

namespace {

struct NamedSpacing {
    PhaseSpacing spacing;
    const char* mapping;
    const char* name;
};

constexpr std::array kSpacings = {
    NamedSpacing{PhaseSpacing::angle, "angle", "uniform in angle"},
    NamedSpacing{PhaseSpacing::cosine, "cosine", "uniform in cosine"},
    NamedSpacing{PhaseSpacing::peaks, "peaks", "clustered at the peaks"}};

constexpr std::int64_t kMostPhaseTexels = 16384;

class PhaseSweep {
  public:
    PhaseSweep(const PhaseSource& source, const PhaseBake& bake, const Baked& baked, bool quick)
        : source_(source), bake_(bake), mapping_(baked.mapping), size_({baked.image().width, 1}) {
        std::vector<std::array<double, 2>> factors = {{0.0625, 1}, {0.25, 1}, {1, 1}, {4, 1}};
        if (!quick) factors.insert(factors.end(), {{0.125, 1}, {0.5, 1}, {2, 1}});
        sizes_ = sizes_around(size_, factors, kMostPhaseTexels);
    }

    std::vector<Variant> variants() {
        if (bake_.content == PhaseContent::inverse_cumulative) {
            const auto model = std::make_shared<const TableModel>(inverse_phase_model(source_));
            add_sizes("inverse cumulative", true, model, PixelType::float32);
            add_sizes("inverse cumulative, half", true, model, PixelType::half);
            return std::move(variants_);
        }
        for (const NamedSpacing& of : kSpacings) {
            const auto model = std::make_shared<const TableModel>(phase_model(source_, of.spacing));
            const bool own = mapping_ == of.mapping;
            add_sizes(of.name, own, model, PixelType::float32);
            add_sizes(std::string(of.name) + ", half", own, model, PixelType::half);
        }
        add_formulas();
        return std::move(variants_);
    }

  private:
    void add_sizes(const std::string& family, bool own, const Model& model, PixelType type) {
        for (const std::array<int, 2> size : sizes_) {
            Variant variant;
            variant.family = family;
            variant.name = size_text(size);
            variant.of_recipe = own && size == size_ && type == bake_.pixel_type;
            variant.size = size;
            variant.pixel_type = type;
            variant.model = model;
            variant.truth = model;
            variants_.push_back(std::move(variant));
        }
    }

    // Adds closed forms, fitted in each channel, as if they were in a table of many texels.
    void add_formulas() {
        std::vector<std::vector<PhaseFit>> fits;  // of each channel
        for (const PhaseFunction& function : source_.functions) fits.push_back(fit_phase(function));
        const auto truth =
            std::make_shared<const TableModel>(phase_model(source_, PhaseSpacing::peaks));
        for (std::size_t form = 0; form < fits.front().size(); ++form) {
            TableModel model = *truth;
            model.row = [fits, form](int, double, const std::vector<double>& x, double* to) {
                for (const double coordinate : x) {
                    const ScatteringAngle angle = scattering_angle(PhaseSpacing::peaks, coordinate);
                    for (const std::vector<PhaseFit>& of : fits) {
                        *to++ = fitted_value(of[form].form, of[form].parameters, angle.one_minus,
                                             angle.one_plus);
                    }
                }
            };
            Variant variant;
            variant.family = "formula";
            variant.name = fits.front()[form].form;
            variant.baseline = "closed form, fitted";
            variant.size = {4096, 1};
            variant.model = std::make_shared<const TableModel>(std::move(model));
            variant.truth = truth;
            variants_.push_back(std::move(variant));
        }
    }

    const PhaseSource& source_;
    const PhaseBake& bake_;
    std::string mapping_;
    std::array<int, 2> size_;
    std::vector<std::array<int, 2>> sizes_;
    std::vector<Variant> variants_;
};

}  // namespace

Sweep phase_sweep(const PhaseSource& source, const PhaseBake& bake, const Baked& baked,
                  bool quick) {
    Sweep sweep;
    sweep.timing = "processor time of the texels, one thread, from the phase function's own table";
    sweep.texels = quick ? PointCounts{1024, 1} : PointCounts{16384, 1};
    sweep.lookups = sweep.texels;
    sweep.variants = PhaseSweep(source, bake, baked, quick).variants();
    return sweep;
}

}  // namespace skybake
