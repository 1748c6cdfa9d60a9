#include "bakers/report/sweeps/noise_volume_sweep.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bakers/noise/noise_field.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

std::vector<std::vector<float>> voxels_of(const VoxelSource& source, int channels,
                                          const VoxelBox& box) {
    std::vector<std::vector<float>> values(
        static_cast<std::size_t>(channels),
        std::vector<float>(static_cast<std::size_t>(box.count()), -1.0F));
    std::vector<float*> targets;
    for (auto& channel : values) targets.push_back(channel.data());
    source.fill(box, targets);
    return values;
}

// Both of all voxels and of a box within, for sizes that are no multiples of a vector.
TEST(PointwiseNoise, EqualsTheKernelsThatShareWork) {
    for (const std::string noise :
         {"preset = 'nubis_shape'", "preset = 'nubis_detail'", "preset = 'takram_shape'",
          "preset = 'takram_detail'", "preset = 'thesis'",
          "channels.R = {type = 'curl', component = 'y', frequency = 3, octaves = 2, gain = 0.5}\n"
          "channels.G = {type = 'constant', value = 0.25}\n"
          "channels.B = {type = 'perlin', fractal = 'ridged', frequency = 5, octaves = 2,"
          " gain = 0.5, invert = true}\n"
          "channels.A = {type = 'perlin', fractal = 'billow', frequency = [2, 3, 4], octaves = 3,"
          " gain = 0.5, bias = 0.7}"}) {
        const auto recipe = config::parse_recipe("[noise.n]\n" + noise + "\n", "recipe");
        ASSERT_TRUE(recipe.value) << noise;
        const std::array<int, 3> size = {37, 19, 11};
        const noise::NoisePlan plan =
            noise::make_noise_plan(recipe.value->parameters.noises.at(0), size);
        const noise::NoiseField field(plan);
        const PointwiseNoise pointwise(plan);
        for (const VoxelBox& box : {VoxelBox{{}, size}, VoxelBox{{5, 3, 2}, {20, 16, 9}}}) {
            EXPECT_EQ(voxels_of(pointwise, plan.output_channels(), box),
                      voxels_of(field, plan.output_channels(), box))
                << noise;
        }
    }
}

}  // namespace
}  // namespace skybake
