#include "bakers/preview/draft.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <variant>

namespace skybake {
namespace {

// The longest edge becomes at most `most_voxels`, the others keep their proportion to it, rounded.
std::array<int, 3> reduced(const std::array<int, 3>& size, int most_voxels) {
    const std::int64_t longest = *std::max_element(size.begin(), size.end());
    if (longest <= most_voxels) return size;
    std::array<int, 3> fewer{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t edge =
            (2 * most_voxels * std::int64_t{size[i]} + longest) / (2 * longest);
        fewer[i] = static_cast<int>(std::max<std::int64_t>(edge, 1));
    }
    return fewer;
}

// Without an own size (max_error is given) a table gets the largest one.
template <class Table>
void reduce_table(Table& table, const std::array<int, 2>& most) {
    table.max_error.reset();
    for (std::size_t i = 0; i < 2; ++i) {
        table.size[i] = table.size[i] > 0 ? std::min(table.size[i], most[i]) : most[i];
    }
}

struct Reduce {
    int most_voxels;

    void operator()(config::TransmittanceBake& table) const { reduce_table(table, {256, 64}); }
    void operator()(config::MultipleScatteringBake& table) const {
        reduce_table(table, {32, 32});
        table.max_texel_error = std::max(table.max_texel_error, 0.02);
    }
    void operator()(config::SkyViewBake& table) const {
        table.size = {std::min(table.size[0], 96), std::min(table.size[1], 54)};
    }
    void operator()(config::IrradianceBake& table) const {
        table.size = {std::min(table.size[0], 32), std::min(table.size[1], 16)};
        table.max_texel_error = std::max(table.max_texel_error, 0.02);
    }
    void operator()(config::PhaseBake&) const {}
    void operator()(config::BrunetonBake& volume) const {
        // The sub-images along u stay whole.
        if (volume.table == config::BrunetonTable::transmittance ||
            volume.table == config::BrunetonTable::irradiance) {
            return;
        }
        const int suns = volume.size[0] / volume.nu_size;
        volume.size = {volume.nu_size * std::min(suns, 16), std::min(volume.size[1], 64),
                       std::min(volume.size[2], 16)};
        volume.mips = 1;
    }
    void operator()(config::OpticalDepthBake& volume) const {
        for (int& edge : volume.size) edge = std::min(edge, volume.size[2] > 1 ? 32 : 256);
        volume.mips = 1;
    }
    void operator()(config::AerialPerspectiveBake& volume) const {
        for (int& edge : volume.size) edge = std::min(edge, 16);
        volume.mips = 1;
    }
    void operator()(config::NoiseVolumeBake& volume) const {
        volume.size = reduced(volume.size, most_voxels);
        volume.mips = 1;
    }
    void operator()(config::CloudVolumeBake& volume) const {
        volume.size = reduced(volume.size, most_voxels);
        volume.mips = 1;
    }
    void operator()(config::OccupancyBake& grid) const { grid.mips = 1; }
};

}  // namespace

config::Recipe draft_of(config::Recipe recipe, int most_voxels) {
    for (config::Bake& bake : recipe.parameters.bakes) {
        std::visit(Reduce{most_voxels}, bake.asset);
    }
    return recipe;
}

}  // namespace skybake
