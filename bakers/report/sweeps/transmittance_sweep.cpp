#include "bakers/report/sweeps/table_sweeps.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/math/transcendental.h"
#include "config/assets/transmittance.h"

namespace skybake {

using config::PixelType;
using config::TransmittanceBake;
using config::TransmittanceContent;
using config::TransmittanceMapping;
using Model = std::shared_ptr<const TableModel>;

namespace {

// The baselines take about 10 us per texel, and larger tables would show nothing new.
constexpr long kMostTransmittanceTexels = 1 << 18;
constexpr long kMaxTexelsOfSteps = 1 << 14;

struct NamedRule {
    StepRule rule;
    std::string family;
    std::vector<int> steps;
    int baseline_steps;
    std::string baseline;
};

const std::vector<NamedRule>& rules() {
    static const std::vector<NamedRule> all = {
        {StepRule::end_point, "end-point rule", {10, 20, 40, 80, 160}, 40, "Hillaire 2020"},
        {StepRule::midpoint, "midpoint rule", {10, 20, 40, 80, 160}, 40, "midpoints"},
        {StepRule::trapezoid, "trapezoid rule", {50, 160, 500}, 500, "Bruneton 2008"}};
    return all;
}

std::string family_of(const TransmittanceBake& bake) {
    std::string family = "exact";
    if (bake.content == TransmittanceContent::optical_depth) family += ", optical depth";
    if (bake.mapping == TransmittanceMapping::ue) family += ", ue mapping";
    if (bake.pixel_type == PixelType::half) family += ", half";
    return family;
}

// Returns the table's model with another quadrature, ray by ray as in the papers.
TableModel by_steps(const Medium& medium, const TableModel& exact, bool as_depth, StepRule rule,
                    int steps) {
    TableModel model = exact;
    const Shell shell = shell_of(medium);
    model.row = [&medium, shell, as_depth, rule, steps](int, double y, const std::vector<double>& x,
                                                        double* values) {
        for (const double x_mu : x) {
            const TransmittanceRay ray = transmittance_ray(shell, {x_mu, y});
            const Spectrum depth =
                optical_depth_by_steps(medium, ray.altitude_km, ray.s_km, steps, rule);
            for (int c = 0; c < medium.channels; ++c) {
                const double tau = depth[static_cast<std::size_t>(c)];
                *values++ = as_depth ? tau : exponential(-tau);
            }
        }
    };
    return model;
}

TransmittanceBake with(TransmittanceBake bake, PixelType pixel_type) {
    bake.pixel_type = pixel_type;
    return bake;
}

class TransmittanceSweep {
  public:
    TransmittanceSweep(const Medium& medium, const TransmittanceBake& bake, std::array<int, 2> size,
                       bool quick)
        : medium_(medium),
          bake_(bake),
          size_(size),
          steps_size_(size_within(size, kMaxTexelsOfSteps)) {
        std::vector<std::array<double, 2>> factors = {{0.25, 0.25}, {0.5, 0.5}, {1, 1}, {2, 2}};
        if (!quick) factors.push_back({4, 4});
        const long own = static_cast<long>(size[0]) * size[1];
        sizes_ = sizes_around(size, factors, std::max(kMostTransmittanceTexels, own));
        if (std::find(sizes_.begin(), sizes_.end(), steps_size_) == sizes_.end()) {
            sizes_.insert(sizes_.begin(), steps_size_);
        }
    }

    std::vector<Variant> variants() {
        const Model exact = add_sizes(with(bake_, PixelType::float32));
        for (Variant& variant : variants_) {
            variant.in_quadrature_sweep = variant.size == steps_size_;
        }
        add_sizes(with(bake_, PixelType::half), exact);
        TransmittanceBake other = bake_;
        other.content = bake_.content == TransmittanceContent::transmittance
                            ? TransmittanceContent::optical_depth
                            : TransmittanceContent::transmittance;
        const Model of_other_content = add_sizes(with(other, PixelType::float32));
        add_sizes(with(other, PixelType::half), of_other_content);
        other = bake_;
        other.mapping = bake_.mapping == TransmittanceMapping::bruneton
                            ? TransmittanceMapping::ue
                            : TransmittanceMapping::bruneton;
        const Model of_other_mapping = add_sizes(with(other, PixelType::float32));
        for (const NamedRule& rule : rules()) {
            add_rule(rule, exact);
            if (rule.rule == StepRule::end_point && other.mapping == TransmittanceMapping::ue) {
                add_sample_as_shipped(rule, of_other_mapping);
            }
        }
        return std::move(variants_);
    }

  private:
    // Adds the exact kernel in all sizes. `model` is its model if that already exists.
    Model add_sizes(const TransmittanceBake& bake, Model model = nullptr) {
        if (model == nullptr) {
            model = std::make_shared<const TableModel>(transmittance_model(medium_, bake));
        }
        const bool as_recipe = bake.content == bake_.content && bake.mapping == bake_.mapping &&
                               bake.pixel_type == bake_.pixel_type;
        for (const std::array<int, 2> size : sizes_) {
            Variant variant;
            variant.family = family_of(bake);
            variant.name = size_text(size);
            variant.of_recipe = as_recipe && size == size_;
            variant.size = size;
            variant.pixel_type = bake.pixel_type;
            variant.model = model;
            variant.truth = model;
            variants_.push_back(std::move(variant));
        }
        return model;
    }

    Variant steps_variant(const NamedRule& rule, int steps, const Model& truth) const {
        const bool as_depth = bake_.content == TransmittanceContent::optical_depth;
        Variant variant;
        variant.family = rule.family;
        variant.name = std::to_string(steps) + " steps";
        variant.size = steps_size_;
        variant.model = std::make_shared<const TableModel>(
            by_steps(medium_, *truth, as_depth, rule.rule, steps));
        variant.truth = truth;
        return variant;
    }

    void add_rule(const NamedRule& rule, const Model& truth) {
        for (const int steps : rule.steps) {
            Variant variant = steps_variant(rule, steps, truth);
            if (steps == rule.baseline_steps) variant.baseline = rule.baseline;
            variant.in_quadrature_sweep = true;
            variants_.push_back(std::move(variant));
        }
    }

    // Adds the sample's rule with the mapping that the sample uses.
    void add_sample_as_shipped(const NamedRule& rule, const Model& truth) {
        Variant variant = steps_variant(rule, rule.baseline_steps, truth);
        variant.name += ", ue mapping";
        variant.baseline = "sample as shipped";
        variants_.push_back(std::move(variant));
    }

    const Medium& medium_;
    const TransmittanceBake& bake_;
    std::array<int, 2> size_;
    std::array<int, 2> steps_size_;
    std::vector<std::array<int, 2>> sizes_;
    std::vector<Variant> variants_;
};

}  // namespace

Sweep transmittance_sweep(const Medium& medium, const TransmittanceBake& bake,
                          std::array<int, 2> size, bool quick) {
    Sweep sweep;
    sweep.timing = "processor time of the texels, one thread";
    // The numbers of points are those of --certify=quick and --certify=full.
    sweep.texels = quick ? PointCounts{1024, 1} : PointCounts{16384, 1};
    sweep.lookups = sweep.texels;
    sweep.variants = TransmittanceSweep(medium, bake, size, quick).variants();
    return sweep;
}

}  // namespace skybake
