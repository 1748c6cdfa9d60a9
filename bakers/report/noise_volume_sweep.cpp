#include "bakers/report/noise_volume_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "bakers/io/spelling.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/noise_plan.h"
#include "bakers/report/pointwise_noise.h"
#include "bakers/report/sweep.h"
#include "config/octave_sampling.h"

namespace skybake {

using config::Compression;
using config::Noise;
using config::NoiseChannel;
using config::NoiseOctaves;
using config::NoiseType;
using config::NoiseVolumeBake;
using config::PixelType;
using config::VdbCompression;
using config::VolumeFormat;
using Voxels = std::shared_ptr<const VoxelSource>;

namespace {

// Voxels times channels. A volume of so many is held as floats, and once more as the file that is
// made of it. 128 x 128 x 128 RGBA is 2^23, 256 x 256 x 256 is 2^26.
constexpr std::int64_t kMaxValues = std::int64_t{1} << 26;
constexpr std::int64_t kMaxValuesQuick = std::int64_t{1} << 23;

std::int64_t max_voxels(const Noise& noise, bool quick) {
    const std::int64_t channels =
        noise.pack == config::NoisePacking::none ? std::ssize(noise.channels) : 1;
    return (quick ? kMaxValuesQuick : kMaxValues) / channels;
}

std::size_t octave_count(const Noise& noise) {
    std::size_t count = 0;
    for (const NoiseChannel& channel : noise.channels) {
        count =
            std::max({count, channel.octaves.gains.size(), channel.worley_octaves.gains.size()});
    }
    return count;
}

// False where nothing would be left: what there is has no weight.
bool cut(NoiseOctaves& octaves, std::size_t count) {
    if (octaves.gains.size() <= count) return true;
    octaves.gains.resize(count);
    octaves.frequencies.resize(count);
    return std::accumulate(octaves.gains.begin(), octaves.gains.end(), 0.0) > 0;
}

// The noise with no more than `count` octaves of a kind in each channel; their weights have the sum
// 1 again. None where a channel has no weight in these octaves.
std::optional<Noise> cut_short(Noise noise, std::size_t count) {
    for (NoiseChannel& channel : noise.channels) {
        if (!cut(channel.octaves, count) || !cut(channel.worley_octaves, count))
            return std::nullopt;
    }
    return noise;
}

// Whether `bake` refuses the size: an octave of gradient noise would be 0 at every voxel (E0127).
bool loses_an_octave(const Noise& noise, const std::array<int, 3>& size) {
    const auto is_lost = [&](const NoiseChannel& channel) {
        if (channel.type != NoiseType::perlin && channel.type != NoiseType::perlin_worley) {
            return false;
        }
        for (std::size_t i = 0; i < channel.octaves.gains.size(); ++i) {
            if (channel.octaves.gains[i] > 0 &&
                config::is_zero_everywhere(channel.octaves.frequencies[i], size, noise.sampling)) {
                return true;
            }
        }
        return false;
    };
    return std::any_of(noise.channels.begin(), noise.channels.end(), is_lost);
}

Voxels make_voxels(const Noise& noise, const std::array<int, 3>& size) {
    return std::make_shared<noise::NoiseField>(noise::make_noise_plan(noise, size));
}

class NoiseVolumeSweep {
  public:
    NoiseVolumeSweep(const Noise& noise, const NoiseVolumeBake& bake, std::array<int, 3> size,
                     bool quick)
        : noise_(noise), bake_(bake), size_(size), own_(make_voxels(noise, size)), quick_(quick) {}

    VolumeSweep make() {
        add_compressions();
        add_sizes();
        add_octaves();
        add_baseline();
        return std::move(sweep_);
    }

  private:
    VolumeVariant& add(std::string family, std::string name, Voxels voxels,
                       const std::array<int, 3>& size, PixelType pixel_type) {
        VolumeVariant variant;
        variant.family = std::move(family);
        variant.name = std::move(name);
        variant.voxels = std::move(voxels);
        variant.size = size;
        variant.pixel_type = pixel_type;
        sweep_.variants.push_back(std::move(variant));
        return sweep_.variants.back();
    }

    bool is_asked_for(VolumeFormat format) const {
        return bake_.size == size_ &&
               std::find(bake_.formats.begin(), bake_.formats.end(), format) != bake_.formats.end();
    }

    // EXR and VDB have no unorm: where the recipe does, they are shown as half.
    void add_compressions() {
        const bool has_unorm =
            bake_.pixel_type == PixelType::unorm8 || bake_.pixel_type == PixelType::unorm16;
        const PixelType type = has_unorm ? PixelType::half : bake_.pixel_type;
        for (const Compression compression :
             {Compression::none, Compression::zip, Compression::zips, Compression::piz}) {
            VolumeVariant& variant =
                add(fmt::format("exr, {}", spell(type)), fmt::format("exr {}", spell(compression)),
                    own_, size_, type);
            variant.format = VolumeFormat::exr;
            variant.compression = compression;
            variant.of_recipe = is_asked_for(VolumeFormat::exr) && compression == bake_.compression;
        }
        for (const VdbCompression compression :
             {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
            VolumeVariant& variant =
                add(fmt::format("vdb, {}", spell(type)), fmt::format("vdb {}", spell(compression)),
                    own_, size_, type);
            variant.format = VolumeFormat::vdb;
            variant.vdb_compression = compression;
            variant.of_recipe =
                is_asked_for(VolumeFormat::vdb) && compression == bake_.vdb_compression;
        }
    }

    std::vector<std::array<int, 3>> sizes() {
        std::vector<std::array<double, 3>> factors;
        for (const double factor : {0.5, 0.75, 1.0, 1.5, 2.0}) {
            factors.push_back({factor, factor, factor});
        }
        std::vector<std::array<int, 3>> all =
            sizes_around(size_, factors, max_voxels(noise_, quick_));
        std::erase_if(all, [&](const std::array<int, 3>& size) {
            const bool lost = loses_an_octave(noise_, size);
            if (lost) {
                sweep_.notes.push_back(fmt::format(
                    "{}: left out, an octave would be 0 at every voxel", size_text(size)));
            }
            return lost;
        });
        return all;
    }

    // In all pixel types, uncompressed, so that bytes compare.
    void add_sizes() {
        std::vector<std::pair<std::array<int, 3>, Voxels>> volumes;
        for (const std::array<int, 3>& size : sizes()) {
            volumes.emplace_back(size, size == size_ ? own_ : make_voxels(noise_, size));
        }
        for (const PixelType type :
             {PixelType::float32, PixelType::half, PixelType::unorm16, PixelType::unorm8}) {
            for (const auto& [size, voxels] : volumes) {
                VolumeVariant& variant =
                    add(fmt::format("bin, {}", spell(type)), size_text(size), voxels, size, type);
                const bool own_size = size == size_;
                variant.in_quadrature_sweep = own_size && type == PixelType::float32;
                variant.of_recipe =
                    own_size && is_asked_for(VolumeFormat::bin) && type == bake_.pixel_type;
            }
        }
    }

    void add_octaves() {
        const std::size_t all = octave_count(noise_);
        for (std::size_t count = 1; count < all; ++count) {
            std::string name = fmt::format("{} of {} octaves", count, all);
            const std::optional<Noise> noise = cut_short(noise_, count);
            if (!noise) {
                sweep_.notes.push_back(
                    fmt::format("{}: left out, their gains are 0 in a channel", name));
                continue;
            }
            add("octaves cut short, bin, float", std::move(name), make_voxels(*noise, size_), size_,
                PixelType::float32)
                .in_quadrature_sweep = true;
        }
    }

    void add_baseline() {
        VolumeVariant& variant =
            add("point by point, bin, float", size_text(size_),
                std::make_shared<PointwiseNoise>(noise::make_noise_plan(noise_, size_)), size_,
                PixelType::float32);
        variant.baseline = "every sample hashed on its own";
        variant.in_quadrature_sweep = true;
    }

    const Noise& noise_;
    const NoiseVolumeBake& bake_;
    std::array<int, 3> size_;
    Voxels own_;
    bool quick_;
    VolumeSweep sweep_;
};

}  // namespace

std::array<int, 3> report_size(const Noise& noise, const NoiseVolumeBake& bake, bool quick) {
    return size_within(bake.size, max_voxels(noise, quick));
}

VolumeSweep noise_volume_sweep(const Noise& noise, const NoiseVolumeBake& bake,
                               std::array<int, 3> size, bool quick) {
    return NoiseVolumeSweep(noise, bake, size, quick).make();
}

}  // namespace skybake
