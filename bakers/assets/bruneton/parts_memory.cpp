#include "bakers/assets/bruneton/parts_memory.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>

#include "bakers/assets/bruneton/scattering_row.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/math/tiles.h"

namespace skybake {

namespace {

struct Remembered {
    SkyMedium medium;
    std::vector<bool> is_mie;
    std::array<int, 3> size{};
    int nu_size = 0;
    double sun_cos_zenith_min = 0;
    std::shared_ptr<const SolvedLight> light;  // of the higher orders
    TableParts parts;

    bool is_of(const SkyMedium& other, const ScatteringContent& content,
               const ScatteringMapping& mapping) const {
        return size == mapping.size() && nu_size == mapping.nu_size() &&
               sun_cos_zenith_min == mapping.sun_cos_zenith_min() && is_mie == content.is_mie() &&
               medium == other;
    }
};

StoredSpectrum stored(const Spectrum& value) {
    return {static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)};
}

}  // namespace

TableParts make_parts(const SkyMedium& medium, const SolvedLight* light, bool wants_first,
                      const ScatteringContent& content, const ScatteringMapping& mapping,
                      const BakeOptions& options) {
    const std::array<int, 3>& size = mapping.size();
    const auto width = static_cast<std::size_t>(size[0]);
    const std::size_t texels =
        width * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
    auto first = std::make_shared<FirstOrderParts>();
    auto higher = std::make_shared<HigherOrderParts>();
    if (wants_first) {
        first->air.resize(texels);
        first->mie.resize(texels);
    }
    if (light != nullptr) higher->resize(texels);
    const ScatteringRows rows(medium, light, wants_first, options.threads);
    for_each_tile(size[1] * size[2], options, "scattering", [&](int tile) {
        const std::vector<ScatteringParts> parts = parts_of_row(
            rows, content, mapping, mapping.view_of_texel(tile % size[1], tile / size[1]));
        const std::size_t from = static_cast<std::size_t>(tile) * width;
        for (std::size_t u = 0; u < width; ++u) {
            if (wants_first) {
                first->air[from + u] = stored(parts[u].air);
                first->mie[from + u] = stored(parts[u].mie);
            }
            if (light != nullptr) (*higher)[from + u] = stored(parts[u].higher);
        }
    });
    TableParts result;
    if (wants_first) result.first = std::move(first);
    if (light != nullptr) result.higher = std::move(higher);
    return result;
}

TableParts remembered_parts(const SkyMedium& medium,
                            const std::shared_ptr<const SolvedLight>& light,
                            const ScatteringContent& content, const ScatteringMapping& mapping,
                            bool wants_first, bool wants_higher, const BakeOptions& options) {
    static std::mutex mutex;
    static Remembered last;
    TableParts known;
    {
        const std::lock_guard lock(mutex);
        if (last.is_of(medium, content, mapping)) {
            known.first = last.parts.first;
            if (last.light == light) known.higher = last.parts.higher;
        }
    }
    const bool makes_first = wants_first && !known.first;
    const bool makes_higher = wants_higher && light && !known.higher;
    if (makes_first || makes_higher) {
        // Not under the lock: threads of the loop may be given other tasks.
        TableParts made = make_parts(medium, makes_higher ? light.get() : nullptr, makes_first,
                                     content, mapping, options);
        if (makes_first) known.first = std::move(made.first);
        if (makes_higher) known.higher = std::move(made.higher);
        if (options.cancelled()) return known;
        const std::lock_guard lock(mutex);
        last = {medium,
                content.is_mie(),
                mapping.size(),
                mapping.nu_size(),
                mapping.sun_cos_zenith_min(),
                known.higher ? light : nullptr,
                known};
    }
    if (!wants_first) known.first = nullptr;
    if (!wants_higher) known.higher = nullptr;
    return known;
}

}  // namespace skybake
