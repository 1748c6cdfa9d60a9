#include "bakers/noise/stack_filler.h"

#include <algorithm>

#include "bakers/noise/combine_kernel.h"
#include "bakers/noise/scattered_kernel.h"

namespace skybake::noise {

StackFiller::StackFiller(const GradientStack& stack, const std::array<TileAxis, 3>& axes,
                         const VoxelBox& box, const ChunkLayout& layout, bool displaced)
    : stack_(stack), row_stride_(layout.row_stride), displaced_(displaced) {
    const auto fine = std::ranges::find_if_not(
        stack.octaves, [&](const auto& octave) { return is_resolved(axes, octave.frequency); });
    const auto shared = static_cast<std::size_t>(fine - stack.octaves.begin());
    if (!layout.pointwise && !displaced) {
        lattices_ = make_gradient_lattices(stack, shared, box, layout.depth);
    }
    if (!is_separable()) octave_.reserve(layout.floats);
}

void StackFiller::fill(const VoxelBox& chunk, const DisplacedRows& displaced,
                       const SumTarget& target) {
    if (is_separable()) return fill_gradient_stack(stack_, chunk, lattices_, target);
    const SumTarget unfinished{target.out, target.row_stride, target.slice_stride};
    if (!lattices_.empty()) fill_gradient_stack(stack_, chunk, lattices_, unfinished);
    const std::size_t count = row_stride_ * static_cast<std::size_t>(chunk.size[1]) *
                              static_cast<std::size_t>(chunk.size[2]);
    for (std::size_t i = lattices_.size(); i < stack_.octaves.size(); ++i) {
        const GradientOctave& octave = stack_.octaves[i];
        if (displaced_) {
            fill_scattered_gradient_octave(octave, chunk, row_stride_, displaced, octave_.data());
        } else {
            fill_gradient_octave_pointwise(octave, chunk, row_stride_, octave_.data());
        }
        const float weight = stack_.weights.empty() ? 1 : stack_.weights[i];
        add_octave(stack_.shape, octave_.data(), weight, i == 0, count, target.out);
    }
    if (target.finishes()) scale_and_shift(target.scale, target.offset, count, target.out);
}

WarpFiller::WarpFiller(const WarpPlan& warp, const std::array<TileAxis, 3>& axes,
                       const VoxelBox& box, const ChunkLayout& layout)
    : row_stride_(layout.row_stride) {
    for (const GradientStack& stack : warp) {
        stacks_.emplace_back(stack, axes, box, layout, false);
    }
    for (ScratchFloats& along : along_) along.reserve(layout.floats);
}

void WarpFiller::fill(const VoxelBox& chunk) {
    const std::size_t slice = row_stride_ * static_cast<std::size_t>(chunk.size[1]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        stacks_[axis].fill(chunk, {}, {along_[axis].data(), row_stride_, slice});
    }
}

DisplacedRows WarpFiller::rows() { return {along_[0].data(), along_[1].data(), along_[2].data()}; }

}  // namespace skybake::noise
