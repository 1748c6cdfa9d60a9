#include "bakers/report/column_volume_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "bakers/assets/optical_depth/column_volume.h"
#include "bakers/report/sweeps/volume_sweep.h"
#include "bakers/report/volume_report.h"
#include "config/assets/optical_depth.h"

namespace skybake {

using config::DepthSampling;
using config::OpticalDepthBake;

namespace {

// Texels of a table between points: hundreds of shells along each path are slow to sum.
constexpr int kMostColumnTexels = 32;

// Up to where shells go if the recipe has none: Ai et al. 2014.
constexpr config::Length kPaperAltitude = {35e3};

void add(const config::Atmosphere& atmosphere, const OpticalDepthBake& bake,
         const OpticalDepthBake& asked, const std::string& family, const std::string& name,
         const std::string& baseline, VolumeSweep& sweep) {
    VolumeVariant& variant = add_variant(
        sweep, family, name, column_voxels(atmosphere, bake).voxels, bake.size, bake.pixel_type);
    variant.baseline = baseline;
    variant.in_quadrature_sweep = true;
    variant.of_recipe = bake.size == asked.size && bake.sampling == asked.sampling &&
                        (bake.sampling == DepthSampling::exact || bake.shells == asked.shells);
}

VolumeSweep column_sweep(const config::Atmosphere& atmosphere, const OpticalDepthBake& bake,
                         const OpticalDepthBake& asked, bool quick) {
    VolumeSweep sweep;
    OpticalDepthBake variant = bake;
    variant.sampling = DepthSampling::exact;
    add(atmosphere, variant, asked, "exact", "quadrature", "", sweep);
    std::vector<int> counts = {8, 16, 32, 64};
    if (!quick) counts.insert(counts.end(), {128, 256});
    for (const auto& [sampling, family, baseline] :
         {std::tuple{DepthSampling::equal_attenuation, "equal attenuation", "after Ai et al. 2014"},
          std::tuple{DepthSampling::uniform, "uniform shells", ""}}) {
        variant.sampling = sampling;
        for (const int count : counts) {
            variant.shells = count;
            add(atmosphere, variant, asked, family, fmt::format("{} shells", count), baseline,
                sweep);
        }
    }
    return sweep;
}

}  // namespace

config::Outcome<AssetReport> report_column_volume(const config::Recipe& recipe,
                                                  const config::Bake& bake,
                                                  const ReportOptions& options) {
    const auto& asked = bake.as<OpticalDepthBake>();
    const bool sums = asked.table == config::OpticalDepthTable::to_top ||
                      asked.table == config::OpticalDepthTable::between;
    if (!sums) return nothing_to_compare(bake);
    const config::Atmosphere& atmosphere = recipe.parameters.atmosphere;
    config::Bake subject = bake;
    auto& asset = subject.as<OpticalDepthBake>();
    asset.mips = 1;
    if (asset.table == config::OpticalDepthTable::between) {
        for (int& texels : asset.size) texels = std::min(texels, kMostColumnTexels);
    }
    if (asset.sampling == DepthSampling::exact) asset.max_altitude = kPaperAltitude;
    const VolumeSweep sweep = column_sweep(atmosphere, asset, asked, options.quick);
    const auto of_size = [&](const std::array<int, 3>& size) {
        OpticalDepthBake sized = asset;
        sized.size = size;
        return column_voxels(atmosphere, sized);
    };
    const ReferenceOfSize reference = [&](const std::array<int, 3>& size) {
        const auto remembered = std::make_shared<RememberedReference>(of_size(size).reference);
        return [remembered](const std::array<double, 3>& uvw) { return (*remembered)(uvw); };
    };
    return report_volume(recipe,
                         {subject, asked.size, asked.mips, sweep, reference,
                          [&](const std::array<int, 3>& size) { return of_size(size).comparison; }},
                         options);
}

}  // namespace skybake
