#include "bakers/report/sweeps/pointwise_noise.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

#include "bakers/math/aligned_floats.h"
#include "bakers/noise/combine_kernel.h"
#include "bakers/noise/pointwise_kernel.h"

namespace skybake {

namespace {

using noise::ChannelPlan;
using noise::NoisePlan;

// Makes one row of voxels after the other.
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

    // Of the row made last.
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

}  // namespace skybake
