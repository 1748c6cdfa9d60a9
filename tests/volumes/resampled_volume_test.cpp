// Laws of resampling: what is linear stays so, means are kept, and nothing depends on the box.
#include "bakers/clouds/resampled_volume.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/comparisons.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using cloud::axis_taps;
using cloud::AxisTaps;
using cloud::CloudVolume;
using cloud::ResampledVolume;
using cloud::VolumeReference;
using config::VolumeWrap;
using testing::FunctionVoxels;
using testing::sample_voxel;

using Size = std::array<int, 3>;

// A volume of a function, which is 0 beyond its size, and empty where it lies beyond in whole.
CloudVolume volume_of(const Size& size, FunctionVoxels::Function function,
                      VolumeWrap wrap = VolumeWrap::empty) {
    CloudVolume volume;
    volume.source.size = size;
    volume.source.voxel_size_m = {1, 1, 1};
    volume.source.largest = 1;
    volume.wrap = wrap;
    volume.source.voxels = std::make_shared<FunctionVoxels>([=](int x, int y, int z, int channel) {
        const bool is_inside =
            x >= 0 && y >= 0 && z >= 0 && x < size[0] && y < size[1] && z < size[2];
        return is_inside ? function(x, y, z, channel) : 0.0F;
    });
    return volume;
}

std::vector<float> all_of(const VoxelSource& voxels, const Size& size) {
    return testing::planes_of(voxels, {{}, size}, 1)[0];
}

std::vector<float> resampled(const CloudVolume& volume, const Size& size) {
    return all_of(ResampledVolume(volume, size), size);
}

TEST(AxisTaps, SumToOneAndStayAtTheSource) {
    for (const int from : {1, 2, 3, 7, 64, 1000}) {
        for (const int to : {1, 2, 3, 5, 64, 65, 999}) {
            for (const AxisTaps& taps : axis_taps(from, to)) {
                const double sum = std::accumulate(taps.weights.begin(), taps.weights.end(), 0.0);
                EXPECT_NEAR(sum, 1, 1e-14) << from << " to " << to;
                for (const double weight : taps.weights) EXPECT_GT(weight, 0);
                const int beyond = to < from ? 0 : 1;
                EXPECT_GE(taps.first, -beyond);
                EXPECT_LE(taps.first + static_cast<int>(taps.weights.size()), from + beyond);
            }
        }
    }
}

// Counts by hand: two voxels become four, which lie at -1/4, 1/4, 3/4 and 5/4 of their centres.
TEST(AxisTaps, AreTheOnesOfAHandCount) {
    const std::vector<AxisTaps> finer = axis_taps(2, 4);
    EXPECT_EQ(finer[0].first, -1);
    EXPECT_EQ(finer[0].weights, (std::vector<double>{0.25, 0.75}));
    EXPECT_EQ(finer[1].first, 0);
    EXPECT_EQ(finer[1].weights, (std::vector<double>{0.75, 0.25}));
    // Three become two: 1, 1/2 and 1/2, 1, over 3/2.
    const std::vector<AxisTaps> coarser = axis_taps(3, 2);
    EXPECT_EQ(coarser[0].first, 0);
    EXPECT_EQ(coarser[0].weights, (std::vector<double>{2.0 / 3, 1.0 / 3}));
    EXPECT_EQ(coarser[1].first, 1);
    EXPECT_EQ(coarser[1].weights, (std::vector<double>{1.0 / 3, 2.0 / 3}));
}

TEST(ResampledVolume, OfTheSameSizeIsTheSource) {
    const Size size = {5, 4, 3};
    const CloudVolume volume = volume_of(size, sample_voxel);
    EXPECT_EQ(resampled(volume, size), all_of(*volume.source.voxels, size));
}

// Along one axis at a time, so that a flip or a swap of axes is seen; voxels at the faces mix with
// what lies beyond and are left out.
TEST(ResampledVolume, KeepsRamps) {
    const Size from = {8, 6, 5};
    for (const Size& to : {Size{16, 12, 10}, Size{8, 9, 20}, Size{13, 6, 7}, Size{4, 3, 5}}) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const CloudVolume volume = volume_of(from, [axis](int x, int y, int z, int) {
                const Size at = {x, y, z};
                return static_cast<float>(at[axis]) + 0.5F;
            });
            const std::vector<float> values = resampled(volume, to);
            std::size_t i = 0;
            testing::for_each_voxel(to, [&](int x, int y, int z) {
                const float found = values[i++];
                std::array<double, 3> place = {x + 0.5, y + 0.5, z + 0.5};
                for (std::size_t a = 0; a < 3; ++a) {
                    place[a] *= static_cast<double>(from[a]) / to[a];
                    if (place[a] < 0.5 || place[a] > from[a] - 0.5) return;
                }
                EXPECT_FLOAT_EQ(found, static_cast<float>(place[axis]));
            });
        }
    }
}

TEST(ResampledVolume, KeepsTheMeanWhereItIsCoarser) {
    const Size from = {24, 10, 9};
    const CloudVolume volume = volume_of(from, sample_voxel);
    const double mean = test::mean_of(all_of(*volume.source.voxels, from));
    for (const Size& to : {Size{12, 5, 3}, Size{7, 9, 4}, Size{1, 1, 1}, Size{23, 1, 2}}) {
        EXPECT_NEAR(test::mean_of(resampled(volume, to)), mean, 1e-7) << to[0] << " " << to[1];
    }
}

// Interpolation around a tile keeps the mean as well, since what leaves one side enters the other.
TEST(ResampledVolume, KeepsTheMeanOfAVolumeThatRepeats) {
    const Size from = {6, 5, 4};
    const CloudVolume volume = volume_of(from, sample_voxel, VolumeWrap::repeat);
    const double mean = test::mean_of(all_of(*volume.source.voxels, from));
    EXPECT_NEAR(test::mean_of(resampled(volume, {12, 15, 4})), mean, 1e-7);
}

// The finest pattern that a volume can hold is grey where voxels are twice as large.
TEST(ResampledVolume, DoesNotAlias) {
    const CloudVolume checks = volume_of(
        {16, 16, 16}, [](int x, int y, int z, int) { return (x + y + z) % 2 == 0 ? 1.0F : 0.0F; });
    for (const float value : resampled(checks, {8, 8, 8})) EXPECT_EQ(value, 0.5F);
    for (const float value : resampled(checks, {5, 5, 5})) EXPECT_NEAR(value, 0.5F, 0.01F);
}

TEST(ResampledVolume, MixesFacesWithWhatLiesBeyond) {
    const auto full = [](int, int, int, int) { return 1.0F; };
    const std::vector<float> empty = resampled(volume_of({2, 1, 1}, full), {4, 1, 1});
    EXPECT_EQ(empty, (std::vector<float>{0.75F, 1, 1, 0.75F}));
    const std::vector<float> repeated =
        resampled(volume_of({2, 1, 1}, full, VolumeWrap::repeat), {4, 1, 1});
    EXPECT_EQ(repeated, (std::vector<float>{1, 1, 1, 1}));
    // Above and below there is nothing in either case.
    EXPECT_EQ(resampled(volume_of({1, 1, 1}, full, VolumeWrap::repeat), {1, 1, 2}),
              (std::vector<float>{0.75F, 0.75F}));
    const auto left = [](int x, int, int, int) { return x == 0 ? 1.0F : 0.0F; };
    EXPECT_EQ(resampled(volume_of({2, 1, 1}, left, VolumeWrap::repeat), {4, 1, 1}),
              (std::vector<float>{0.75F, 0.75F, 0.25F, 0.25F}));
}

// Against the definition, which is written another way, at every centre.
TEST(ResampledVolume, EqualsItsDefinition) {
    for (const VolumeWrap wrap : {VolumeWrap::empty, VolumeWrap::repeat}) {
        for (const Size& to : {Size{7, 9, 4}, Size{13, 3, 8}, Size{5, 4, 3}, Size{1, 1, 1}}) {
            const CloudVolume volume = volume_of({5, 4, 6}, sample_voxel, wrap);
            const std::vector<float> values = resampled(volume, to);
            const VolumeReference definition(volume, to);
            std::size_t i = 0;
            testing::for_each_voxel(to, [&](int x, int y, int z) {
                const double wanted =
                    definition({(x + 0.5) / to[0], (y + 0.5) / to[1], (z + 0.5) / to[2]});
                EXPECT_NEAR(values[i++], wanted, 1e-6) << x << " " << y << " " << z;
            });
        }
    }
}

TEST(ResampledVolume, DoesNotDependOnTheBox) {
    const CloudVolume volume = volume_of({40, 30, 20}, sample_voxel, VolumeWrap::repeat);
    for (const Size& to : {Size{16, 12, 24}, Size{80, 31, 7}}) {
        const ResampledVolume voxels(volume, to);
        const std::vector<float> whole = all_of(voxels, to);
        for (const VoxelBox& box :
             {VoxelBox{{3, 5, 2}, {9, 4, 5}}, VoxelBox{{to[0] - 1, 0, 0}, {1, to[1], to[2]}}}) {
            EXPECT_TRUE(testing::is_part_of({whole}, voxels, to, box));
        }
    }
}

// A single voxel, which alone is not empty.
class OneVoxel : public VoxelSource {
  public:
    OneVoxel(const Size& at, bool says_what_is_empty) : at_(at), says_(says_what_is_empty) {}
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        std::fill_n(channels[0], box.count(), 0.0F);
        if (!holds(box)) return;
        const std::int64_t row =
            std::int64_t{at_[2] - box.origin[2]} * box.size[1] + at_[1] - box.origin[1];
        channels[0][row * box.size[0] + at_[0] - box.origin[0]] = 1;
    }
    bool is_empty(const VoxelBox& box) const override { return says_ && !holds(box); }

  private:
    bool holds(const VoxelBox& box) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (at_[i] < box.origin[i] || at_[i] >= box.origin[i] + box.size[i]) return false;
        }
        return true;
    }
    const Size at_;
    const bool says_;
};

TEST(ResampledVolume, KnowsWhatIsEmpty) {
    CloudVolume volume = volume_of({16, 4, 4}, nullptr);
    volume.source.voxels = std::make_shared<OneVoxel>(Size{8, 2, 2}, true);
    const ResampledVolume voxels(volume, {32, 4, 4});
    EXPECT_TRUE(voxels.is_empty({{0, 0, 0}, {15, 4, 4}}));
    EXPECT_FALSE(voxels.is_empty({{0, 0, 0}, {16, 4, 4}})) << "voxel 15 mixes with voxel 8";
    volume.source.voxels = std::make_shared<OneVoxel>(Size{15, 2, 2}, true);
    EXPECT_TRUE(ResampledVolume(volume, {32, 4, 4}).is_empty({{0, 0, 0}, {15, 4, 4}}));
    volume.wrap = VolumeWrap::repeat;
    EXPECT_FALSE(ResampledVolume(volume, {32, 4, 4}).is_empty({{0, 0, 0}, {15, 4, 4}}))
        << "voxel 0 mixes with the other side";
}

// A voxel at a face shows on the other side of the seam, whatever is known to be empty.
TEST(ResampledVolume, LosesNothingAcrossItsSeams) {
    const Size source = {8, 6, 4};
    for (const Size& at : {Size{0, 3, 1}, Size{7, 3, 1}, Size{3, 0, 1}, Size{3, 5, 1},
                           Size{0, 0, 2}, Size{7, 5, 0}}) {
        CloudVolume volume = volume_of(source, nullptr, VolumeWrap::repeat);
        volume.source.voxels = std::make_shared<OneVoxel>(at, false);
        CloudVolume knowing = volume;
        knowing.source.voxels = std::make_shared<OneVoxel>(at, true);
        for (const Size& size : {Size{16, 12, 4}, Size{12, 9, 4}, Size{5, 4, 3}}) {
            const ResampledVolume voxels(knowing, size);
            const ResampledVolume looking(volume, size);
            testing::for_each_texel(size[0], size[1], [&](int x, int y) {
                const VoxelBox column{{x, y, 0}, {1, 1, size[2]}};
                const auto wanted = testing::planes_of(looking, column, 1)[0];
                EXPECT_EQ(testing::planes_of(voxels, column, 1)[0], wanted) << x << " " << y;
                const std::vector<float> nothing(wanted.size(), 0.0F);
                EXPECT_TRUE(!voxels.is_empty(column) || wanted == nothing) << x << " " << y;
            });
        }
    }
}

}  // namespace
}  // namespace skybake
