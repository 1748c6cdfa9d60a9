#include "bakers/report/sweeps/table_sweeps.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "config/assets/multiple_scattering.h"

namespace skybake {

using config::MultipleScatteringBake;
using config::MultipleScatteringMapping;
using config::MultipleScatteringMethod;
using config::PixelType;
using Model = std::shared_ptr<const TableModel>;

namespace {

// The paper's quadrature takes about 0.1 ms per texel, the finest level 0.3 ms per texel.
constexpr long kMaxTexels = 1 << 13;
constexpr long kMaxTexelsOfLevels = 1 << 10;

std::string mapping_name(MultipleScatteringMapping mapping) {
    return mapping == MultipleScatteringMapping::twilight ? "twilight" : "hillaire";
}

class MultipleScatteringSweep {
  public:
    MultipleScatteringSweep(const Medium& medium, const MultipleScatteringBake& bake,
                            std::array<int, 2> size, std::optional<int> level, bool quick,
                            int threads)
        : medium_(medium), bake_(bake), size_(size), level_(level), threads_(threads) {
        std::vector<std::array<double, 2>> factors = {{0.5, 0.5}, {1, 1}, {2, 2}};
        if (!quick) factors.push_back({4, 2});
        sizes_ = sizes_around(size, factors, kMaxTexels);
        sizes_with_own_ = sizes_;
        if (std::find(sizes_.begin(), sizes_.end(), size) == sizes_.end()) {
            sizes_with_own_.push_back(size);
        }
    }

    std::vector<Variant> variants() {
        const Model converged = model_of(MultipleScatteringMethod::converged, bake_.mapping);
        const Model paper = model_of(MultipleScatteringMethod::as_in_paper, bake_.mapping);
        const MultipleScatteringMapping other = bake_.mapping == MultipleScatteringMapping::hillaire
                                                    ? MultipleScatteringMapping::twilight
                                                    : MultipleScatteringMapping::hillaire;
        add_levels(converged);
        const std::string family = "sizes, " + mapping_name(bake_.mapping);
        add_sizes(family, converged, converged, sizes_with_own_, PixelType::float32);
        add_sizes(family + ", half", converged, converged, sizes_with_own_, PixelType::half);
        const Model of_other = model_of(MultipleScatteringMethod::converged, other);
        add_sizes("sizes, " + mapping_name(other), of_other, of_other, sizes_, PixelType::float32);
        add_paper(paper, converged);
        mark_recipe(bake_.method == MultipleScatteringMethod::as_in_paper ? paper : converged);
        return std::move(variants_);
    }

  private:
    Model model_of(MultipleScatteringMethod method, MultipleScatteringMapping mapping) const {
        MultipleScatteringBake bake = bake_;
        bake.method = method;
        bake.mapping = mapping;
        return std::make_shared<const TableModel>(
            multiple_scattering_model(medium_, bake, threads_));
    }

    std::array<int, 2> levels_size() const { return size_within(size_, kMaxTexelsOfLevels); }

    void add_levels(const Model& model) {
        const std::size_t count = model->cost_per_texel.size();
        for (std::size_t level = 0; level < count; ++level) {
            Variant variant;
            variant.family = "quadrature levels, " + mapping_name(bake_.mapping);
            variant.name = "level " + std::to_string(level + 1);
            variant.in_quadrature_sweep = true;
            variant.size = levels_size();
            variant.model = model;
            variant.level = static_cast<int>(level);
            variant.truth = model;
            variants_.push_back(std::move(variant));
        }
    }

    // Returns the quadrature level for the sweep over sizes.
    int level_of(const TableModel& model) const {
        const auto count = static_cast<int>(model.cost_per_texel.size());
        return count == 1 ? 0 : level_.value_or(count - 1);
    }

    // Adds variants of several sizes, except those that are already among the levels.
    void add_sizes(const std::string& family, const Model& model, const Model& truth,
                   const std::vector<std::array<int, 2>>& sizes, PixelType pixel_type) {
        const int level = level_of(*model);
        for (const std::array<int, 2> size : sizes) {
            const bool there =
                std::any_of(variants_.begin(), variants_.end(), [&](const Variant& variant) {
                    return variant.model == model && variant.level == level &&
                           variant.size == size && variant.pixel_type == pixel_type;
                });
            if (there) continue;
            Variant variant;
            variant.family = family;
            variant.name = size_text(size);
            variant.size = size;
            variant.pixel_type = pixel_type;
            variant.model = model;
            variant.level = level;
            variant.truth = truth;
            variants_.push_back(std::move(variant));
        }
    }

    // Adds the paper's quadrature. At the size of the levels it can be compared with them.
    void add_paper(const Model& paper, const Model& truth) {
        const bool own = bake_.method == MultipleScatteringMethod::as_in_paper;
        add_sizes("as in the paper", paper, truth, own ? sizes_with_own_ : sizes_,
                  PixelType::float32);
        add_sizes("as in the paper", paper, truth, {levels_size()}, PixelType::float32);
        if (own) add_sizes("as in the paper", paper, truth, {size_}, bake_.pixel_type);
        for (Variant& variant : variants_) {
            if (variant.model != paper || variant.size != levels_size()) continue;
            variant.baseline = "Hillaire 2020 (64 directions, 20 steps)";
            variant.in_quadrature_sweep = true;
        }
    }

    void mark_recipe(const Model& own) {
        if (bake_.method == MultipleScatteringMethod::solved) return;
        if (!level_ && own->cost_per_texel.size() > 1) return;
        const int level = level_of(*own);
        for (Variant& variant : variants_) {
            variant.of_recipe = variant.model == own && variant.level == level &&
                                variant.size == size_ && variant.pixel_type == bake_.pixel_type;
        }
    }

    const Medium& medium_;
    const MultipleScatteringBake& bake_;
    std::array<int, 2> size_;
    std::optional<int> level_;
    int threads_;
    std::vector<std::array<int, 2>> sizes_;
    std::vector<std::array<int, 2>> sizes_with_own_;
    std::vector<Variant> variants_;
};

}  // namespace

Sweep multiple_scattering_sweep(const Medium& medium, const MultipleScatteringBake& bake,
                                std::array<int, 2> size, std::optional<int> level, bool quick,
                                int threads) {
    Sweep sweep;
    sweep.timing =
        "processor time of the texels, one thread; all share tables of sunlight that were computed "
        "before";
    // The points are those of --certify=quick, or the first rows of --certify=full.
    sweep.texels = quick ? PointCounts{8, 8} : PointCounts{64, 16};
    sweep.lookups = sweep.texels;
    sweep.variants = MultipleScatteringSweep(medium, bake, size, level, quick, threads).variants();
    return sweep;
}

}  // namespace skybake
