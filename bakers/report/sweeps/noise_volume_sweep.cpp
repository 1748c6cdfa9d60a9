#include "bakers/report/sweeps/noise_volume_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>

#include "bakers/math/memory.h"
#include "bakers/noise/combine_kernel.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/noise_plan.h"
#include "bakers/noise/pointwise_kernel.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/noise_volume.h"
#include "config/sections/noise.h"

namespace skybake {

// --- Noise point by point ------------------------------------------------------------------------

namespace {

using noise::ChannelPlan;
using noise::NoisePlan;

// Makes rows of voxels, one after the other.
class RowMaker {
  public:
    RowMaker(const NoisePlan& plan, int width)
        : plan_(plan),
          stride_((static_cast<std::size_t>(width) + noise::kLanePadding - 1) /
                  noise::kLanePadding * noise::kLanePadding),
          octave_(stride_),
          fields_(plan.fields.size(), AlignedFloats(stride_)),
          channels_(plan.channels.size(), AlignedFloats(stride_)),
          gradient_(stride_) {
        for (const AlignedFloats& field : fields_) field_rows_.push_back(field.data());
    }

    void make(const VoxelBox& row) {
        for (std::size_t i = 0; i < fields_.size(); ++i) {
            noise::fill_cell_field_pointwise(plan_.fields[i], row, stride_, fields_[i].data());
        }
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            const ChannelPlan& channel = plan_.channels[c];
            add_gradients(channel, row, gradient_.data());
            const bool none = channel.gradient.octaves.empty();
            noise::combine_channel(channel, none ? nullptr : gradient_.data(), field_rows_, stride_,
                                   channels_[c].data());
        }
        if (plan_.pack == config::NoisePacking::none) return;
        std::array<const float*, 4> rows{};
        for (std::size_t c = 0; c < channels_.size(); ++c) rows[c] = channels_[c].data();
        noise::pack_channels(plan_.pack, rows, stride_, channels_[0].data());
    }

    // Returns the values of the row made last.
    const float* values(std::size_t channel) const { return channels_[channel].data(); }

  private:
    void add_gradients(const ChannelPlan& channel, const VoxelBox& row, float* sums) {
        const noise::GradientStack& stack = channel.gradient;
        for (std::size_t i = 0; i < stack.octaves.size(); ++i) {
            noise::fill_gradient_octave_pointwise(stack.octaves[i], row, stride_, octave_.data());
            const float weight = stack.weights.empty() ? 1 : stack.weights[i];
            noise::add_octave(stack.shape, octave_.data(), weight, i == 0, stride_, sums);
        }
        const noise::SumShift shift = noise::sum_shift(channel);
        if (!stack.octaves.empty() && (shift.scale != 1 || shift.offset != 0)) {
            noise::scale_and_shift(shift.scale, shift.offset, stride_, sums);
        }
    }

    const NoisePlan& plan_;
    const std::size_t stride_;
    AlignedFloats octave_;
    std::vector<AlignedFloats> fields_;
    std::vector<AlignedFloats> channels_;
    AlignedFloats gradient_;
    std::vector<const float*> field_rows_;
};

}  // namespace

PointwiseNoise::PointwiseNoise(NoisePlan plan) : plan_(std::move(plan)) {}

void PointwiseNoise::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    RowMaker maker(plan_, box.size[0]);
    const auto width = static_cast<std::size_t>(box.size[0]);
    std::size_t offset = 0;
    for (int z = 0; z < box.size[2]; ++z) {
        for (int y = 0; y < box.size[1]; ++y) {
            maker.make(
                {{box.origin[0], box.origin[1] + y, box.origin[2] + z}, {box.size[0], 1, 1}});
            for (std::size_t c = 0; c < channels.size(); ++c) {
                std::memcpy(channels[c] + offset, maker.values(c), width * sizeof(float));
            }
            offset += width;
        }
    }
}

// --- The sweep -----------------------------------------------------------------------------------

using config::Noise;
using config::NoiseChannel;
using config::NoiseOctaves;
using config::NoiseType;
using config::NoiseVolumeBake;
using config::PixelType;
using Voxels = std::shared_ptr<const VoxelSource>;

namespace {

std::int64_t channels_of(const Noise& noise) {
    return noise.pack == config::NoisePacking::none ? std::ssize(noise.channels) : 1;
}

std::size_t octave_count(const Noise& noise) {
    std::size_t count = 0;
    for (const NoiseChannel& channel : noise.channels) {
        count =
            std::max({count, channel.octaves.gains.size(), channel.worley_octaves.gains.size()});
    }
    return count;
}

// Cuts the octaves to `count`. Returns false if those left have no weight.
bool cut(NoiseOctaves& octaves, std::size_t count) {
    if (octaves.gains.size() <= count) return true;
    octaves.gains.resize(count);
    octaves.frequencies.resize(count);
    return std::accumulate(octaves.gains.begin(), octaves.gains.end(), 0.0) > 0;
}

// Returns the noise with at most `count` octaves of each kind in each channel, with weights that
// sum to 1 again. Returns nothing if a channel has no weight in these octaves.
std::optional<Noise> cut_short(Noise noise, std::size_t count) {
    for (NoiseChannel& channel : noise.channels) {
        if (!cut(channel.octaves, count) || !cut(channel.worley_octaves, count))
            return std::nullopt;
    }
    return noise;
}

// Whether an octave of gradient noise is 0 at every voxel of the size (W0208).
bool loses_an_octave(const Noise& noise, const std::array<int, 3>& size) {
    const auto is_lost = [&](const NoiseChannel& channel) {
        if (channel.type != NoiseType::perlin && channel.type != NoiseType::perlin_worley) {
            return false;
        }
        if (channel.warp_strength != 0 || noise.period > 1) return false;
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

void add_octaves(const Noise& noise, const std::array<int, 3>& size, VolumeSweep& sweep) {
    const std::size_t all = octave_count(noise);
    for (std::size_t count = 1; count < all; ++count) {
        std::string name = fmt::format("{} of {} octaves", count, all);
        const std::optional<Noise> shorter = cut_short(noise, count);
        if (!shorter) {
            sweep.notes.push_back(
                fmt::format("{}: left out, their gains are 0 in a channel", name));
            continue;
        }
        add_variant(sweep, "octaves cut short, bin, float", std::move(name),
                    make_voxels(*shorter, size), size, PixelType::float32)
            .in_quadrature_sweep = true;
    }
}

void add_baseline(const Noise& noise, const std::array<int, 3>& size, VolumeSweep& sweep) {
    VolumeVariant& variant =
        add_variant(sweep, "point by point, bin, float", size_text(size),
                    std::make_shared<PointwiseNoise>(noise::make_noise_plan(noise, size)), size,
                    PixelType::float32);
    variant.baseline = "every sample hashed on its own";
    variant.in_quadrature_sweep = true;
}

}  // namespace

std::array<int, 3> report_size(const Noise& noise, const NoiseVolumeBake& bake, bool quick) {
    return size_within(bake.size, max_report_values(quick) / channels_of(noise));
}

VolumeSweep noise_volume_sweep(const Noise& noise, const NoiseVolumeBake& bake,
                               std::array<int, 3> size, bool quick) {
    const auto make = [&](const std::array<int, 3>& voxels) { return make_voxels(noise, voxels); };
    const auto refusal = [&](const std::array<int, 3>& voxels) -> std::string {
        return loses_an_octave(noise, voxels) ? "an octave would be 0 at every voxel" : "";
    };
    VolumeSweep sweep = storage_sweep(
        {bake, bake.size == size, size, static_cast<int>(channels_of(noise)), make, refusal},
        make_voxels(noise, size), quick);
    add_octaves(noise, size, sweep);
    add_baseline(noise, size, sweep);
    return sweep;
}

}  // namespace skybake
