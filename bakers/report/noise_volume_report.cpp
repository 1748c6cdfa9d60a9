#include "bakers/report/noise_volume_report.h"

#include <memory>
#include <variant>

#include "bakers/noise/noise_reference.h"
#include "bakers/noise/tile_axis.h"
#include "bakers/report/sweeps/noise_volume_sweep.h"
#include "bakers/report/volume_report.h"
#include "config/assets/noise_volume.h"
#include "config/sections/named_sections.h"

namespace skybake {

using config::Noise;
using config::NoiseVolumeBake;
using config::Outcome;

namespace {

// By texture coordinates of a volume of any size.
ReferenceOfSize reference_of(const Noise& noise) {
    const auto remembered =
        std::make_shared<RememberedReference>([&noise](const std::array<double, 3>& place) {
            return noise::noise_reference(noise, place);
        });
    return [&noise, remembered](const std::array<int, 3>& size) -> VolumeReference {
        const std::array<noise::TileAxis, 3> axes = noise::tile_axes(size, noise.sampling);
        return [remembered, axes](const std::array<double, 3>& uvw) {
            std::array<double, 3> place = uvw;
            for (std::size_t i = 0; i < 3; ++i) {
                // Voxel i, whose centre is at (i + 1/2) / size, may sample its lower corner.
                if (axes[i].offset == 0) place[i] -= 0.5 / axes[i].size;
            }
            return (*remembered)(place);
        };
    };
}

}  // namespace

Outcome<AssetReport> report_noise_volume(const config::Recipe& recipe, const config::Bake& bake,
                                         const ReportOptions& options) {
    const auto& asked = bake.as<NoiseVolumeBake>();
    const Noise& noise = noise_named(recipe.parameters, asked.noise);
    config::Bake subject = bake;
    auto& asset = subject.as<NoiseVolumeBake>();
    asset.size = report_size(noise, asked, options.quick);
    asset.mips = 1;
    const VolumeSweep sweep = noise_volume_sweep(noise, asked, asset.size, options.quick);
    return report_volume(recipe, {subject, asked.size, asked.mips, sweep, reference_of(noise)},
                         options);
}

}  // namespace skybake
